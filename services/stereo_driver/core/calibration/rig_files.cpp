#include "services/stereo_driver/core/calibration/rig_files.h"

#include <cmath>
#include <opencv2/core/eigen.hpp>

#include "common/geometry/lens_limits.h"
#include "common/text/number_text.h"
#include "common/text/size_text.h"

namespace deixis::stereo_driver {
namespace {

using capture::LensFile;
using capture::OpenCvFile;

/// The translation of the first camera's origin into the second camera's frame, judged.
Eigen::Vector3d ReadTranslation(const OpenCvFile& file, double unit_m,
                                const BaselineLimits& limits) {
  const Eigen::Vector3d translation_m = ReadMatrix(file, "T", 3, 1) * unit_m;
  const double baseline_mm = std::round(translation_m.norm() * 1000.0);
  if (!(baseline_mm >= limits.least_mm && baseline_mm <= limits.largest_mm)) {
    file.Fail("T makes a baseline of " + text::NumberText(baseline_mm) +
              " mm, which is not between " + text::NumberText(limits.least_mm) + " and " +
              text::NumberText(limits.largest_mm) + "; set " + limits.unit_key +
              " to the metres per unit of T (0.001 when it is in millimetres, 0.025 when it counts "
              "board squares of 25 mm)");
  }
  return translation_m;
}

}  // namespace

Eigen::MatrixXd ReadMatrix(const OpenCvFile& file, const std::string& key, int rows, int cols) {
  cv::Mat matrix = file.Matrix(key);
  if (matrix.total() == static_cast<std::size_t>(rows) * cols && cols == 1) {
    matrix = matrix.reshape(1, rows);
  }
  if (matrix.rows != rows || matrix.cols != cols) {
    file.Fail(key + " must be " + text::SizeText(rows, cols) + " but is " +
              text::SizeText(matrix.rows, matrix.cols) + "; calibrate again or correct it");
  }
  Eigen::MatrixXd values;
  cv::cv2eigen(matrix, values);
  return values;
}

Eigen::Matrix3d ReadRotation(const OpenCvFile& file, const std::string& key) {
  const Eigen::Matrix3d rotation = ReadMatrix(file, key, 3, 3);
  if (!geometry::IsRotation(rotation)) {
    file.Fail(key + " is not a rotation; calibrate again or correct it");
  }
  return rotation;
}

geometry::RigidTransform ReadSecondFromFirst(const OpenCvFile& file, double unit_m,
                                             const BaselineLimits& limits) {
  geometry::RigidTransform second_from_first;
  second_from_first.rotation = Eigen::Quaterniond(ReadRotation(file, "R")).normalized();
  second_from_first.translation_m = ReadTranslation(file, unit_m, limits);
  return second_from_first;
}

LensFile ReadLensOf(const OpenCvFile& file, const std::string& number) {
  return {file.path(), capture::ReadLens(file, {"M" + number, "", "D" + number, ""})};
}

void SetSize(geometry::CameraCalibration& calibration, cv::Size size) {
  calibration.width_px = size.width;
  calibration.height_px = size.height;
}

}  // namespace deixis::stereo_driver
