#include "services/stereo_driver/core/matching/stereo_matcher.h"

#include <algorithm>
#include <opencv2/imgproc.hpp>

#include "common/text/size_text.h"

namespace deixis::stereo_driver {
namespace {

// Below it OpenCV's matchers find no room for their windows.
constexpr int kLeastMatched_px = 8;
// Pixels times disparities: some three seconds of one core.
constexpr std::int64_t kMostCompared = std::int64_t{1} << 30;

// Half of an odd size is not half as large: the view is the whole one, its scale follows.
cv::Size MatchedSize(const StereoMatcherConfig& config, cv::Size size) {
  const bool is_full = config.match_size == MatchSize::kFull;
  return is_full ? size : cv::Size(size.width / 2, size.height / 2);
}

int MatchedWidth(const StereoMatcherConfig& config, const geometry::CameraCalibration& rectified) {
  return MatchedSize(config, {rectified.width_px, rectified.height_px}).width;
}

DepthGeometry GeometryOf(const StereoMatcherConfig& config,
                         const geometry::StereoCalibration& calibration) {
  const geometry::CameraCalibration& rectified = calibration.rectified;
  const double scale = 1.0 * MatchedWidth(config, rectified) / rectified.width_px;
  return {rectified.focal_px.x() * scale, calibration.right_from_left.translation_m.norm(),
          config.nearest_m, config.farthest_m};
}

const StereoMatcherConfig& Validated(const StereoMatcherConfig& config) {
  config.Validate();
  if (config.match_size == MatchSize::kHalf && config.depth_size == Size::kFull) {
    throw std::logic_error("StereoMatcher: depth cannot be larger than what is matched");
  }
  config.disparity.Validate();
  config.refinement.Validate();
  return config;
}

int SearchedBy(const StereoMatcherConfig& config, const geometry::StereoCalibration& calibration) {
  const DepthGeometry geometry = GeometryOf(config, calibration);
  const double nearest_px = geometry.focal_px * geometry.baseline_m / geometry.nearest_m;
  return SearchedDisparities(config.disparity, nearest_px,
                             MatchedWidth(config, calibration.rectified));
}

}  // namespace

void StereoMatcherConfig::Validate() const {
  config::Faults faults;
  faults.Require(nearest_m >= 0.1, "nearest_m", "must be at least 0.1");
  faults.Require(farthest_m > nearest_m && farthest_m <= 65.0, "farthest_m",
                 "must lie between nearest_m and 65");
  faults.ThrowIfAny();
}

std::string MatchingFault(const StereoMatcherConfig& config,
                          const geometry::StereoCalibration& calibration) {
  const geometry::CameraCalibration& rectified = calibration.rectified;
  const cv::Size size = MatchedSize(config, {rectified.width_px, rectified.height_px});
  const std::string pictures =
      "pictures of " + text::SizeText(rectified.width_px, rectified.height_px) + " are too ";
  const int least_px = std::max(kLeastMatched_px, BlockSide_px(config.disparity));
  if (std::min(size.width, size.height) < least_px) return pictures + "small to be matched";
  const std::int64_t disparities = SearchedBy(config, calibration);
  if (std::int64_t{size.width} * size.height * disparities <= kMostCompared) return "";
  return pictures + "large to be matched over " + std::to_string(disparities) +
         " disparities; set matcher.match_size half, matcher.nearest_m larger, or the cameras to"
         " smaller pictures";
}

StereoMatcher::StereoMatcher(const StereoMatcherConfig& config,
                             const geometry::StereoCalibration& calibration)
    : config_(Validated(config)),
      rectifier_(calibration),
      num_disparities_(SearchedBy(config, calibration)),
      matcher_(config.disparity, num_disparities_),
      refiner_(config.refinement),
      people_(config.people, GeometryOf(config, calibration)),
      converter_(GeometryOf(config, calibration), num_disparities_) {}

const RectifiedDepth& StereoMatcher::Measure(const images::StereoPair& pair,
                                             const Windows& people) {
  Rectify(pair);
  Match();
  Refine();
  MeasurePeople(people);
  Convert();
  return result_;
}

void StereoMatcher::Rectify(const images::StereoPair& pair) {
  rectifier_.Rectify(pair, rectified_);
  result_.left_bgr = rectified_.left_bgr;
  if (config_.match_size != MatchSize::kFull) {
    const cv::Size half = MatchedSize(config_, rectified_.left_grey.size());
    cv::resize(rectified_.left_grey, left_to_match_, half, 0.0, 0.0, cv::INTER_AREA);
    cv::resize(rectified_.right_grey, right_to_match_, half, 0.0, 0.0, cv::INTER_AREA);
  } else {
    left_to_match_ = rectified_.left_grey;
    right_to_match_ = rectified_.right_grey;
  }
}

void StereoMatcher::Match() { matcher_.Match(left_to_match_, right_to_match_, disparity_); }

void StereoMatcher::Refine() { refiner_.Refine(left_to_match_, right_to_match_, disparity_); }

void StereoMatcher::MeasurePeople(const Windows& people) {
  if (config_.match_size != MatchSize::kPeople) return;
  people_.Measure(people, rectified_, left_to_match_, right_to_match_, disparity_);
}

void StereoMatcher::Convert() {
  const bool is_half = config_.match_size != MatchSize::kFull;
  if (is_half == (config_.depth_size == Size::kHalf)) {
    converter_.Convert(disparity_, result_.depth_mm);
  } else if (is_half) {
    converter_.Convert(disparity_, half_depth_mm_);
    cv::resize(half_depth_mm_, result_.depth_mm, rectified_.left_grey.size(), 0.0, 0.0,
               cv::INTER_NEAREST);
  } else {
    converter_.ConvertHalved(disparity_, result_.depth_mm);
  }
  if (config_.match_size == MatchSize::kPeople) people_.WriteTo(result_.depth_mm);
}

}  // namespace deixis::stereo_driver
