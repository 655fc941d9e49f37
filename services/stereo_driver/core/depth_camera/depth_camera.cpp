#include "services/stereo_driver/core/depth_camera/depth_camera.h"

#include <algorithm>
#include <array>
#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>
#include <stdexcept>

#include "services/stereo_driver/core/calibration/camera_matrix.h"
#include "services/stereo_driver/core/matching/halving.h"

namespace deixis::stereo_driver {
namespace {

using geometry::CameraCalibration;

// Distances of one surface within 2x2 pixels differ by less, as a share of the distance.
constexpr double kAgreeShare = 0.03;

void MakeMaps(const CameraCalibration& lens, const CameraCalibration& rectified, int map_type,
              cv::Mat& map_x, cv::Mat& map_y) {
  const cv::Size size(rectified.width_px, rectified.height_px);
  if (lens.distortion_model == geometry::DistortionModel::kFisheye) {
    cv::fisheye::initUndistortRectifyMap(CameraMatrix(lens), lens.distortion, cv::Mat(),
                                         CameraMatrix(rectified), size, map_type, map_x, map_y);
  } else {
    cv::initUndistortRectifyMap(CameraMatrix(lens), lens.distortion, cv::Mat(),
                                CameraMatrix(rectified), size, map_type, map_x, map_y);
  }
}

bool HasDistortion(const CameraCalibration& lens) {
  return lens.distortion_model == geometry::DistortionModel::kFisheye ||
         std::any_of(lens.distortion.begin(), lens.distortion.end(),
                     [](double value) { return value != 0.0; });
}

/// The published picture's view, in the size that depth is brought into: at full size where there
/// is more to it than half, so that halving takes means of what was measured.
CameraCalibration RegisteredView(const CameraCalibration& rectified, Size depth_size,
                                 const CameraCalibration& depth_lens) {
  const int half_width = rectified.width_px / 2;
  const bool has_half = half_width > 0 && rectified.height_px > 1;
  if (depth_size == Size::kFull || !has_half || depth_lens.width_px > half_width) return rectified;
  return geometry::Scaled(rectified, half_width, rectified.height_px / 2);
}

std::uint16_t MeanOfNearest(const std::array<std::uint16_t, 4>& distances) {
  int nearest = 0;
  for (const int value : distances) {
    if (value > 0 && (nearest == 0 || value < nearest)) nearest = value;
  }
  if (nearest == 0) return 0;
  int sum = 0;
  int count = 0;
  for (const int value : distances) {
    if (value == 0 || value > nearest * (1.0 + kAgreeShare)) continue;
    sum += value;
    ++count;
  }
  return static_cast<std::uint16_t>((2 * sum + count) / (2 * count));
}

}  // namespace

void HalveDepth(const cv::Mat& depth_mm, cv::Mat& halved_mm) {
  const Halving rows(depth_mm.rows);
  const Halving columns(depth_mm.cols);
  halved_mm.create(rows.half(), columns.half(), CV_16UC1);
  for (int y = 0; y < halved_mm.rows; ++y) {
    const auto* upper = depth_mm.ptr<std::uint16_t>(rows.First(y));
    const auto* lower = depth_mm.ptr<std::uint16_t>(rows.First(y) + 1);
    auto* to = halved_mm.ptr<std::uint16_t>(y);
    for (int x = 0; x < halved_mm.cols; ++x) {
      const int i = columns.First(x);
      to[x] = MeanOfNearest({upper[i], upper[i + 1], lower[i], lower[i + 1]});
    }
  }
}

DepthCamera::DepthCamera(const geometry::StereoCalibration& calibration, Size depth_size,
                         const std::optional<DepthView>& depth_view)
    : calibration_(calibration),
      depth_size_(depth_size),
      has_distortion_(HasDistortion(calibration.left)) {
  if (calibration.left.width_px <= 0 || calibration.left.height_px <= 0) {
    throw std::logic_error("DepthCamera: the calibration has no size");
  }
  if (depth_view) {
    registration_.emplace(*depth_view,
                          RegisteredView(calibration.rectified, depth_size, depth_view->lens));
  }
  if (!has_distortion_) return;
  MakeMaps(calibration_.left, calibration_.rectified, CV_16SC2, colour_map_x_, colour_map_y_);
}

const RectifiedDepth& DepthCamera::Rectify(const images::RgbdImage& image) {
  result_ = {image.colour.bgr, InPicturesView(image.depth.depth_mm)};
  if (has_distortion_) {
    cv::remap(image.colour.bgr, rectified_bgr_, colour_map_x_, colour_map_y_, cv::INTER_LINEAR);
    result_.left_bgr = rectified_bgr_;
  }
  const cv::Size size = result_.depth_mm.size();
  const bool is_large = size.width >= result_.left_bgr.cols && size.width > 1 && size.height > 1;
  if (depth_size_ == Size::kHalf && is_large) {
    HalveDepth(result_.depth_mm, halved_mm_);
    result_.depth_mm = halved_mm_;
  }
  return result_;
}

const cv::Mat& DepthCamera::InPicturesView(const cv::Mat& depth_mm) {
  if (registration_) {
    registration_->Register(depth_mm, rectified_mm_);
    return rectified_mm_;
  }
  if (!has_distortion_) return depth_mm;
  PrepareDepthMaps(depth_mm.size());
  // Never a mean: between a body and what lies behind it is nothing.
  cv::remap(depth_mm, rectified_mm_, depth_map_x_, depth_map_y_, cv::INTER_NEAREST);
  return rectified_mm_;
}

void DepthCamera::PrepareDepthMaps(cv::Size size) {
  if (size == depth_map_size_) return;
  MakeMaps(geometry::Scaled(calibration_.left, size.width, size.height),
           geometry::Scaled(calibration_.rectified, size.width, size.height), CV_32FC1,
           depth_map_x_, depth_map_y_);
  depth_map_size_ = size;
}

}  // namespace deixis::stereo_driver
