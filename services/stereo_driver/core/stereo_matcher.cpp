#include "services/stereo_driver/core/stereo_matcher.h"

#include <opencv2/imgproc.hpp>

namespace deixis::stereo_driver {
namespace {

double MatchScale(const StereoMatcherConfig& config) {
  return config.match_size == Size::kHalf ? 0.5 : 1.0;
}

DepthGeometry GeometryOf(const StereoMatcherConfig& config,
                         const geometry::StereoCalibration& calibration) {
  return {calibration.rectified.focal_px.x() * MatchScale(config),
          calibration.right_from_left.translation_m.norm(), config.nearest_m, config.farthest_m};
}

const StereoMatcherConfig& Validated(const StereoMatcherConfig& config) {
  config.Validate();
  config.disparity.Validate();
  config.refinement.Validate();
  return config;
}

int SearchedBy(const StereoMatcherConfig& config, const geometry::StereoCalibration& calibration) {
  const DepthGeometry geometry = GeometryOf(config, calibration);
  const double nearest_px = geometry.focal_px * geometry.baseline_m / geometry.nearest_m;
  const double width_px = calibration.rectified.width_px * MatchScale(config);
  return SearchedDisparities(config.disparity, nearest_px, static_cast<int>(width_px));
}

}  // namespace

void StereoMatcherConfig::Validate() const {
  config::Faults faults;
  faults.Require(match_size == Size::kFull || depth_size == Size::kHalf, "depth_size",
                 "must be half when match_size is");
  faults.Require(nearest_m >= 0.1, "nearest_m", "must be at least 0.1");
  faults.Require(farthest_m > nearest_m && farthest_m <= 65.0, "farthest_m",
                 "must lie between nearest_m and 65");
  faults.ThrowIfAny();
}

StereoMatcher::StereoMatcher(const StereoMatcherConfig& config,
                             const geometry::StereoCalibration& calibration)
    : config_(Validated(config)),
      rectifier_(calibration),
      num_disparities_(SearchedBy(config, calibration)),
      matcher_(config.disparity, num_disparities_),
      refiner_(config.refinement),
      converter_(GeometryOf(config, calibration), num_disparities_) {}

const RectifiedDepth& StereoMatcher::Measure(const images::StereoPair& pair) {
  Rectify(pair);
  Match();
  Refine();
  Convert();
  return result_;
}

void StereoMatcher::Rectify(const images::StereoPair& pair) {
  rectifier_.Rectify(pair, rectified_);
  result_.left_bgr = rectified_.left_bgr;
  if (config_.match_size == Size::kHalf) {
    const cv::Size half(rectified_.left_grey.cols / 2, rectified_.left_grey.rows / 2);
    cv::resize(rectified_.left_grey, left_to_match_, half, 0.0, 0.0, cv::INTER_AREA);
    cv::resize(rectified_.right_grey, right_to_match_, half, 0.0, 0.0, cv::INTER_AREA);
  } else {
    left_to_match_ = rectified_.left_grey;
    right_to_match_ = rectified_.right_grey;
  }
}

void StereoMatcher::Match() { matcher_.Match(left_to_match_, right_to_match_, disparity_); }

void StereoMatcher::Refine() { refiner_.Refine(left_to_match_, right_to_match_, disparity_); }

void StereoMatcher::Convert() {
  if (config_.match_size == config_.depth_size) {
    converter_.Convert(disparity_, result_.depth_mm);
  } else {
    converter_.ConvertHalved(disparity_, result_.depth_mm);
  }
}

}  // namespace deixis::stereo_driver
