#include "services/stereo_driver/core/matching/rectifier.h"

#include <opencv2/calib3d.hpp>
#include <opencv2/core/eigen.hpp>
#include <opencv2/imgproc.hpp>
#include <stdexcept>

#include "common/text/size_text.h"
#include "services/stereo_driver/core/calibration/camera_matrix.h"

namespace deixis::stereo_driver {
namespace {

cv::Size SizeOf(const geometry::CameraCalibration& camera) {
  return {camera.width_px, camera.height_px};
}

void RequirePicture(const cv::Mat& picture, cv::Size size) {
  if (picture.size() != size || picture.type() != CV_8UC3) {
    throw std::logic_error("Rectifier: a picture of " + text::SizeText(picture.cols, picture.rows) +
                           ", type " + std::to_string(picture.type()) + ", where maps are for " +
                           text::SizeText(size.width, size.height) + ", BGR");
  }
}

}  // namespace

Rectifier::Maps Rectifier::MakeMaps(const geometry::CameraCalibration& camera,
                                    const geometry::CameraCalibration& rectified) {
  cv::Mat rotation;
  cv::eigen2cv(camera.rectification, rotation);
  Maps maps;
  cv::initUndistortRectifyMap(CameraMatrix(camera), camera.distortion, rotation,
                              CameraMatrix(rectified), SizeOf(rectified), CV_16SC2, maps.whole,
                              maps.fraction);
  return maps;
}

Rectifier::Rectifier(const geometry::StereoCalibration& calibration)
    : size_(SizeOf(calibration.left)),
      left_(MakeMaps(calibration.left, calibration.rectified)),
      right_(MakeMaps(calibration.right, calibration.rectified)) {
  if (SizeOf(calibration.right) != size_ || SizeOf(calibration.rectified) != size_) {
    throw std::logic_error("Rectifier: left, right and rectified camera differ in size");
  }
}

void Rectifier::Rectify(const images::StereoPair& pair, RectifiedPair& rectified) {
  RequirePicture(pair.left.bgr, size_);
  RequirePicture(pair.right.bgr, size_);
  // Colour first, grey then: one interpolation serves the published picture and the matching, and
  // both cameras are rounded alike.
  cv::remap(pair.left.bgr, rectified.left_bgr, left_.whole, left_.fraction, cv::INTER_LINEAR);
  cv::remap(pair.right.bgr, right_bgr_, right_.whole, right_.fraction, cv::INTER_LINEAR);
  cv::cvtColor(rectified.left_bgr, rectified.left_grey, cv::COLOR_BGR2GRAY);
  cv::cvtColor(right_bgr_, rectified.right_grey, cv::COLOR_BGR2GRAY);
}

}  // namespace deixis::stereo_driver
