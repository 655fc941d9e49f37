#pragma once
#include <Eigen/Core>
#include <filesystem>
#include <map>
#include <opencv2/core/matx.hpp>
#include <string>
#include <vector>

#include "common/anthropometry/body_measures.h"

namespace deixis::pose_fitter {

/// Places by name (r_elbow, nose ...): camera frame, metres.
using Markers = std::map<std::string, Eigen::Vector3d>;

/// One point of a person's visible surface: camera frame, metres.
struct SurfacePoint {
  Eigen::Vector3d point_m = Eigen::Vector3d::Zero();
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();  ///< Of unit length, towards the camera.
  int part = 0;                                      ///< As the mask labels it.
};

/// A rendered sequence with its truth: joints.csv, person.csv, intrinsics.yml, camera_world.yml,
/// depth/NNNNNN.png and mask/NNNNNN.png.
struct RenderedPerson {
  std::filesystem::path folder;
  std::string id;  ///< Of the person.
  anthropometry::Sex sex = anthropometry::Sex::kFemale;
  double stature_m = 0.0;
  std::map<std::string, double> lengths_m;         ///< What person.csv says: l_thigh, r_hand ...
  Eigen::Vector3d up = -Eigen::Vector3d::UnitY();  ///< Camera frame.
  cv::Matx33d camera = cv::Matx33d::eye();
  std::vector<double> distortion;
  std::vector<Markers> frames;
  std::vector<int> depth_frames;  ///< Those that have a true depth.
};

/// Throws ConfigError naming what cannot be read.
RenderedPerson ReadRenderedPerson(const std::filesystem::path& folder);

/// Points of the person on a grid of pixels, `step` apart; loose objects and other people left out.
/// Throws ConfigError naming the picture that cannot be read.
std::vector<SurfacePoint> ReadSurface(const RenderedPerson& person, int frame, int step);

}  // namespace deixis::pose_fitter
