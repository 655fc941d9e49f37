#pragma once
#include <Eigen/Core>
#include <random>
#include <vector>

#include "services/pose_fitter/core/shape/shape_calibration.h"

namespace deixis::pose_fitter {

/// Parameters of the clothed body of an average person of that stature, sex not known.
/// `stature_sigma_m`: how sure that stature is.
ShapeParameters ClothedPerson(double stature_m, double stature_sigma_m);

/// A moving person before a depth camera.
struct Scene {
  std::vector<ShapeFrame> frames;                 ///< With the true poses.
  std::vector<body_model::BodyPose> rough_poses;  ///< As a fitter may have them.
};

/// `frame_count` varied poses of `truth` some 2.3 m before the camera; of each about `point_count`
/// points that face it and lie on no other limb, with noise along their rays.
Scene Watch(const body_model::BodyModel& truth, int frame_count, int point_count, double noise_m,
            unsigned seed);

}  // namespace deixis::pose_fitter
