#include "services/stereo_driver/evaluation/plain_opencv.h"

#include <opencv2/core/eigen.hpp>
#include <opencv2/imgproc.hpp>

#include "services/stereo_driver/core/calibration/camera_matrix.h"

namespace deixis::stereo_driver {

cv::Ptr<cv::StereoMatcher> PlainMatcher(Method method, int num_disparities) {
  if (method == Method::kBm) {
    const cv::Ptr<cv::StereoBM> matcher = cv::StereoBM::create(num_disparities, 9);
    matcher->setPreFilterCap(31);
    matcher->setTextureThreshold(10);
    matcher->setUniquenessRatio(15);
    matcher->setSpeckleWindowSize(100);
    matcher->setSpeckleRange(32);
    matcher->setDisp12MaxDiff(1);
    return matcher;
  }
  constexpr int kBlock_px = 3;
  constexpr int kChannels = 3;
  return cv::StereoSGBM::create(
      0, num_disparities, kBlock_px, 8 * kChannels * kBlock_px * kBlock_px,
      32 * kChannels * kBlock_px * kBlock_px, 1, 63, 10, 100, 32, cv::StereoSGBM::MODE_SGBM_3WAY);
}

PlainOpenCv::PlainOpenCv(const geometry::StereoCalibration& calibration, Method method,
                         int num_disparities)
    : calibration_(calibration), matcher_(PlainMatcher(method, num_disparities)) {
  const cv::Mat m1 = CameraMatrix(calibration.left);
  const cv::Mat m2 = CameraMatrix(calibration.right);
  const cv::Size size(calibration.left.width_px, calibration.left.height_px);
  cv::Mat rotation, translation, r1, r2, p1, p2;
  cv::eigen2cv(Eigen::Matrix3d(calibration.right_from_left.rotation.toRotationMatrix()), rotation);
  cv::eigen2cv(calibration.right_from_left.translation_m, translation);
  cv::stereoRectify(m1, calibration.left.distortion, m2, calibration.right.distortion, size,
                    rotation, translation, r1, r2, p1, p2, reprojection_, cv::CALIB_ZERO_DISPARITY,
                    -1, size);
  cv::initUndistortRectifyMap(m1, calibration.left.distortion, r1, p1, size, CV_16SC2,
                              left_maps_[0], left_maps_[1]);
  cv::initUndistortRectifyMap(m2, calibration.right.distortion, r2, p2, size, CV_16SC2,
                              right_maps_[0], right_maps_[1]);
  cv::cv2eigen(r1, calibration_.left.rectification);
  calibration_.rectified.focal_px = {p1.at<double>(0, 0), p1.at<double>(1, 1)};
  calibration_.rectified.principal_point_px = {p1.at<double>(0, 2), p1.at<double>(1, 2)};
}

const cv::Mat& PlainOpenCv::Measure(const images::StereoPair& pair) {
  cv::Mat left, right, disparity, points;
  cv::remap(pair.left.bgr, left, left_maps_[0], left_maps_[1], cv::INTER_LINEAR);
  cv::remap(pair.right.bgr, right, right_maps_[0], right_maps_[1], cv::INTER_LINEAR);
  if (matcher_.dynamicCast<cv::StereoBM>()) {
    cv::cvtColor(left, left, cv::COLOR_BGR2GRAY);
    cv::cvtColor(right, right, cv::COLOR_BGR2GRAY);
  }
  matcher_->compute(left, right, disparity);
  cv::Mat disparity_px;
  disparity.convertTo(disparity_px, CV_32F, 1.0 / kDisparityScale);
  cv::reprojectImageTo3D(disparity_px, points, reprojection_);
  cv::extractChannel(points, depth_m_, 2);
  depth_m_.setTo(0.0F, disparity <= 0);
  return depth_m_;
}

}  // namespace deixis::stereo_driver
