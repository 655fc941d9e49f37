#pragma once
#include <Eigen/Core>
#include <opencv2/core/types.hpp>
#include <string>

#include "common/capture/calibration.h"
#include "common/capture/opencv_file.h"

namespace deixis::stereo_driver {

// What the files of OpenCV's stereo_calib hold: intrinsics.yml with M1 D1 M2 D2, extrinsics.yml
// with R T, which turn points in the first camera's frame into the second's. All readers throw
// ConfigError naming file, key and cure.

Eigen::MatrixXd ReadMatrix(const capture::OpenCvFile& file, const std::string& key, int rows,
                           int cols);

Eigen::Matrix3d ReadRotation(const capture::OpenCvFile& file, const std::string& key);

/// How far apart two cameras can be, and which key of the configuration says in what T counts.
struct BaselineLimits {
  double least_mm = 0.0;
  double largest_mm = 0.0;
  std::string unit_key;
};

/// R and T as second_from_first; `unit_m` metres per unit of T.
geometry::RigidTransform ReadSecondFromFirst(const capture::OpenCvFile& file, double unit_m,
                                             const BaselineLimits& limits);

/// The first lens ("1": M1 D1) or the second ("2"), without its size.
capture::LensFile ReadLensOf(const capture::OpenCvFile& file, const std::string& number);

void SetSize(geometry::CameraCalibration& calibration, cv::Size size);

}  // namespace deixis::stereo_driver
