#pragma once
#include <opencv2/core/matx.hpp>
#include <opencv2/core/types.hpp>
#include <optional>
#include <string>
#include <vector>

#include "services/calibrator/core/board.h"

namespace deixis::calibrator {

enum class LensModel {
  kPlumbBob,  ///< k1 k2 p1 p2 k3
  kRational,  ///< k1 k2 p1 p2 k3 k4 k5 k6
  kFisheye    ///< k1 k2 k3 k4 of OpenCV's fisheye model
};

std::string NameOf(LensModel model);

/// A camera as OpenCV describes it. Pixels with the origin at the centre of the top-left pixel.
struct Lens {
  LensModel model = LensModel::kPlumbBob;
  cv::Size size;
  cv::Matx33d matrix = cv::Matx33d::eye();
  std::vector<double> distortion;  ///< 5, 8 or 4 values.
};

/// Where the board is: camera_from_board.
struct BoardPose {
  cv::Vec3d rotation;  ///< Rodrigues' vector.
  cv::Vec3d translation_m;
};

/// Where points of the board (metres, board frame) appear in the picture of a camera that sees the
/// board at `pose`: distorted pixels, one per point. All must lie in front of the camera.
std::vector<cv::Point2f> Project(const Lens& lens, const std::vector<cv::Point3f>& points_m,
                                 const BoardPose& pose);

/// Distorted pixels to pixels of the pinhole camera `projection` (its left 3x3 counts), turned by
/// `rotation`.
std::vector<cv::Point2f> Undistort(const Lens& lens, const std::vector<cv::Point2f>& points_px,
                                   const cv::Matx33d& rotation, const cv::Matx34d& projection);

/// The pose that shows the corners best; nothing when there is none.
std::optional<BoardPose> FindPose(const Lens& lens, const BoardLayout& layout,
                                  const Corners& corners);

/// Root mean square distance between corners and their projections, pixels; nothing without a pose.
std::optional<double> ReprojectionError_px(const Lens& lens, const BoardLayout& layout,
                                           const Corners& corners);

/// A lens without distortion whose focal length is the picture's width: good enough for tilts.
Lens RoughLens(cv::Size size);

/// Horizontal field of view of the pinhole part, degrees.
double HorizontalFov_deg(const Lens& lens);

/// Whether radii that the picture shows still grow with the angle from the axis; where they do not,
/// two directions fall on one pixel and the lens makes no sense.
bool IsMonotonic(const Lens& lens);

}  // namespace deixis::calibrator
