#include "services/stereo_driver/core/calibration/rig_calibration.h"

#include <cmath>
#include <opencv2/calib3d.hpp>
#include <opencv2/core/eigen.hpp>

#include "common/geometry/lens_limits.h"
#include "common/images/picture_size.h"
#include "services/stereo_driver/core/calibration/camera_matrix.h"
#include "services/stereo_driver/core/calibration/rig_files.h"

namespace deixis::stereo_driver {
namespace {

using capture::LensFile;
using capture::OpenCvFile;
using geometry::CameraCalibration;
using geometry::StereoCalibration;

// Two cameras on one robot stand further apart than their sensors are wide, and not a metre.
const BaselineLimits kBaselineLimits = {5, 1000, "calibration.unit_m"};
constexpr double kBaselineTolerance = 0.01;
constexpr double kPrincipalPointTolerance_px = 0.01;

/// Along the line that halves the rotation between the cameras, as OpenCV rectifies.
void RequireLeftToRight(const OpenCvFile& file, const geometry::RigidTransform& right_from_left) {
  const Eigen::AngleAxisd rotation(right_from_left.rotation);
  const Eigen::Vector3d along =
      Eigen::AngleAxisd(-0.5 * rotation.angle(), rotation.axis()) * right_from_left.translation_m;
  if (std::abs(along.y()) > std::abs(along.x()) || std::abs(along.z()) > std::abs(along.x())) {
    file.Fail(
        "T does not lie along the pictures' rows: the cameras stand one above or behind the other; "
        "mount them side by side, turn the pictures, and calibrate again");
  }
  if (along.x() > 0.0) {
    file.Fail(
        "T says that the first camera is the right one; swap left and right in the sources and "
        "calibrate again with the left camera first");
  }
}

FiledRectification ReadRectification(const OpenCvFile& file, double unit_m, double baseline_m) {
  FiledRectification filed;
  filed.rectified_from_left = ReadRotation(file, "R1");
  filed.rectified_from_right = ReadRotation(file, "R2");
  const Eigen::MatrixXd p1 = ReadMatrix(file, "P1", 3, 4);
  const Eigen::MatrixXd p2 = ReadMatrix(file, "P2", 3, 4);
  const double p2_baseline_m = -p2(0, 3) / p2(0, 0) * unit_m;
  if (!(std::abs(p2_baseline_m / baseline_m - 1.0) < kBaselineTolerance)) {
    file.Fail(
        "P2 and T disagree about the baseline; calibrate again, or set "
        "calibration.rectification to computed");
  }
  if (!((p1 - p2).leftCols<3>().cwiseAbs().maxCoeff() < kPrincipalPointTolerance_px)) {
    file.Fail(
        "P1 and P2 have different principal points; rectify with CALIB_ZERO_DISPARITY, or "
        "set calibration.rectification to computed");
  }
  filed.projection.path = file.path();
  filed.projection.calibration.focal_px = {p1(0, 0), p1(1, 1)};
  filed.projection.calibration.principal_point_px = {p1(0, 2), p1(1, 2)};
  capture::RequirePinhole(file, "P1", filed.projection.calibration);
  return filed;
}

/// The size that a file states, else that of the configuration; 0 when neither says.
cv::Size StatedSize(const OpenCvFile& file, const RigCalibrationConfig& config) {
  const cv::Size filed = file.ImageSize();
  return file.HasImageSize() ? filed : cv::Size(config.width_px, config.height_px);
}

void Rectify(StereoCalibration& calibration, double alpha) {
  cv::Mat rotation, translation, r1, r2, p1, p2, q;
  cv::eigen2cv(Eigen::Matrix3d(calibration.right_from_left.rotation.toRotationMatrix()), rotation);
  cv::eigen2cv(calibration.right_from_left.translation_m, translation);
  const cv::Size size(calibration.left.width_px, calibration.left.height_px);
  cv::stereoRectify(CameraMatrix(calibration.left), calibration.left.distortion,
                    CameraMatrix(calibration.right), calibration.right.distortion, size, rotation,
                    translation, r1, r2, p1, p2, q, cv::CALIB_ZERO_DISPARITY, alpha, size);
  cv::cv2eigen(r1, calibration.left.rectification);
  cv::cv2eigen(r2, calibration.right.rectification);
  calibration.rectified.focal_px = {p1.at<double>(0, 0), p1.at<double>(1, 1)};
  calibration.rectified.principal_point_px = {p1.at<double>(0, 2), p1.at<double>(1, 2)};
  SetSize(calibration.rectified, size);
}

void RequireUsableView(const StereoCalibration& calibration, const std::string& path) {
  const Eigen::Vector2d& focal_px = calibration.rectified.focal_px;
  const double widest = 20.0 * calibration.left.focal_px.maxCoeff();
  if (!geometry::IsLens(calibration.rectified) || !(focal_px.maxCoeff() < widest)) {
    throw config::ConfigError(path +
                              ": R and T leave no view that both cameras share; calibrate again");
  }
}

OpenCvFile Open(const std::string& name, const std::string& key) {
  const std::string cure = "set calibration." + key;
  return {config::FindConfig(name, cure).string(), cure};
}

}  // namespace

void RigCalibrationConfig::Validate() const {
  config::Faults faults;
  faults.Require(!intrinsics.empty(), "intrinsics", "must name a file");
  faults.Require(!extrinsics.empty(), "extrinsics", "must name a file");
  faults.Require(unit_m > 0.0, "unit_m", "must be positive");
  faults.Require(width_px >= 0 && height_px >= 0, "width_px",
                 "must not be negative, nor height_px");
  faults.Require(width_px <= images::kLongestSide_px && height_px <= images::kLongestSide_px,
                 "width_px", "must be 32766 at most, and height_px");
  faults.Require((width_px == 0) == (height_px == 0), "height_px",
                 "must be given when width_px is, and only then");
  faults.Require(alpha >= 0.0 && alpha <= 1.0, "alpha", "must lie between 0 and 1");
  faults.Require(disparity_sigma_px > 0.0 && disparity_sigma_px < 100.0, "disparity_sigma_px",
                 "must lie between 0 and 100");
  faults.ThrowIfAny();
}

RigCalibration::RigCalibration(RigCalibrationConfig config) : config_(std::move(config)) {
  const OpenCvFile intrinsics = Open(config_.intrinsics, "intrinsics");
  const OpenCvFile extrinsics = Open(config_.extrinsics, "extrinsics");
  if (intrinsics.IsFisheye()) {
    intrinsics.Fail("has fisheye lenses; calibrate with OpenCV's stereo_calib (pinhole lenses)");
  }
  left_ = ReadLensOf(intrinsics, "1");
  right_ = ReadLensOf(intrinsics, "2");
  const cv::Size size = StatedSize(intrinsics.HasImageSize() ? intrinsics : extrinsics, config_);
  SetSize(left_.calibration, size);
  SetSize(right_.calibration, size);
  right_from_left_ = ReadSecondFromFirst(extrinsics, config_.unit_m, kBaselineLimits);
  RequireLeftToRight(extrinsics, right_from_left_);
  if (config_.rectification == Rectification::kFromFile) {
    filed_ = ReadRectification(extrinsics, config_.unit_m, right_from_left_.translation_m.norm());
    SetSize(filed_.projection.calibration, size);
  }
}

RigCalibrationAnswer RigCalibration::For(cv::Size size) const {
  RigCalibrationAnswer answer;
  StereoCalibration& calibration = answer.calibration;
  const capture::CalibrationAnswer left = capture::AtSize(left_, size);
  answer.remark = left.remark;
  calibration.left = left.calibration;
  calibration.right = capture::AtSize(right_, size).calibration;
  calibration.right_from_left = right_from_left_;
  calibration.disparity_sigma_px = config_.disparity_sigma_px;
  if (config_.rectification == Rectification::kFromFile) {
    calibration.left.rectification = filed_.rectified_from_left;
    calibration.right.rectification = filed_.rectified_from_right;
    calibration.rectified = capture::AtSize(filed_.projection, size).calibration;
  } else {
    Rectify(calibration, config_.alpha);
  }
  calibration.rectified.is_calibrated = true;
  RequireUsableView(calibration, left_.path);
  return answer;
}

}  // namespace deixis::stereo_driver
