#include "services/stereo_driver/core/matching/disparity.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <opencv2/core.hpp>

namespace deixis::stereo_driver {
namespace {

constexpr int kSearchStep = 16;  // OpenCV takes multiples of this.
constexpr int kDefaultSgbmBlock_px = 5;
constexpr int kDefaultBmBlock_px = 15;

/// OpenCV's StereoSGBM takes -1 for 1: only a difference that cannot be turns its check off.
int LargestDifference(const DisparityConfig& config, int num_disparities) {
  return config.left_right_px >= 0 ? config.left_right_px : num_disparities;
}

int SgbmBlock_px(const DisparityConfig& config) {
  return config.block_px > 0 ? config.block_px : kDefaultSgbmBlock_px;
}

/// OpenCV sums up costs in 16 bits.
bool FitsSgbmCosts(const DisparityConfig& config) {
  const std::int64_t block_px = SgbmBlock_px(config);
  return config.smoothness_large * block_px * block_px <= std::numeric_limits<std::int16_t>::max();
}

cv::Ptr<cv::StereoMatcher> MakeSgbm(const DisparityConfig& config, int num_disparities) {
  const int block_px = SgbmBlock_px(config);
  const int area = block_px * block_px;
  return cv::StereoSGBM::create(
      0, num_disparities, block_px, config.smoothness_small * area, config.smoothness_large * area,
      LargestDifference(config, num_disparities), config.prefilter_cap, config.uniqueness_percent,
      config.speckle_area_px, config.speckle_range_px, cv::StereoSGBM::MODE_SGBM_3WAY);
}

cv::Ptr<cv::StereoMatcher> MakeBm(const DisparityConfig& config, int num_disparities) {
  const int block_px = BlockSide_px(config);
  const cv::Ptr<cv::StereoBM> matcher = cv::StereoBM::create(num_disparities, block_px);
  matcher->setPreFilterCap(config.prefilter_cap);
  matcher->setTextureThreshold(config.texture_threshold);
  matcher->setUniquenessRatio(config.uniqueness_percent);
  matcher->setDisp12MaxDiff(LargestDifference(config, num_disparities));
  matcher->setSpeckleWindowSize(config.speckle_area_px);
  matcher->setSpeckleRange(config.speckle_range_px);
  return matcher;
}

/// Takes over what the right picture can show: a pixel of column x has at most disparity x.
void CopySeenByBoth(const std::int16_t* from, int width, std::int16_t* to) {
  for (int x = 0; x < width; ++x) {
    const bool is_seen = from[x] > 0 && from[x] <= x * kDisparityScale;
    to[x] = is_seen ? from[x] : static_cast<std::int16_t>(kNoDisparity);
  }
}

}  // namespace

void DisparityConfig::Validate() const {
  config::Faults faults;
  const int least_block = method == Method::kBm ? 5 : 1;
  faults.Require(
      num_disparities >= 0 && num_disparities <= 1024 && num_disparities % kSearchStep == 0,
      "num_disparities", "must be 0 or a multiple of 16 up to 1024");
  faults.Require(block_px == 0 || (block_px % 2 == 1 && block_px >= least_block && block_px <= 51),
                 "block_px", "must be 0 or odd, from 1 (bm: 5) to 51");
  faults.Require(smoothness_small > 0, "smoothness_small", "must be positive");
  faults.Require(smoothness_large > smoothness_small, "smoothness_large",
                 "must be larger than smoothness_small");
  faults.Require(method != Method::kSgbm3way || FitsSgbmCosts(*this), "smoothness_large",
                 "times block_px times block_px must be 32767 at most; take less of either");
  faults.Require(uniqueness_percent >= 0 && uniqueness_percent < 100, "uniqueness_percent",
                 "must lie between 0 and 99");
  faults.Require(texture_threshold >= 0, "texture_threshold", "must not be negative");
  faults.Require(prefilter_cap >= 1 && prefilter_cap <= 63, "prefilter_cap",
                 "must lie between 1 and 63");
  faults.Require(left_right_px >= -1, "left_right_px", "must be -1 (any) or more");
  faults.Require(speckle_area_px >= 0, "speckle_area_px", "must not be negative");
  faults.Require(speckle_range_px >= 1, "speckle_range_px", "must be positive");
  faults.ThrowIfAny();
}

int BlockSide_px(const DisparityConfig& config) {
  if (config.block_px > 0) return config.block_px;
  return config.method == Method::kBm ? kDefaultBmBlock_px : kDefaultSgbmBlock_px;
}

int SearchedDisparities(const DisparityConfig& config, double nearest_px, int width_px) {
  const int widest = std::max(kSearchStep, width_px / kSearchStep * kSearchStep);
  if (config.num_disparities > 0) return std::min(config.num_disparities, widest);
  // One more than the nearest: sub-pixel interpolation needs both neighbours.
  const double steps = std::ceil((nearest_px + 1.0) / kSearchStep);
  return static_cast<int>(std::clamp(steps * kSearchStep, 1.0 * kSearchStep, 1.0 * widest));
}

cv::Ptr<cv::StereoMatcher> MakeMatcher(const DisparityConfig& config, int num_disparities) {
  switch (config.method) {
    case Method::kBm:
      return MakeBm(config, num_disparities);
    case Method::kSgbm3way:
      break;
  }
  return MakeSgbm(config, num_disparities);
}

DisparityMatcher::DisparityMatcher(const DisparityConfig& config, int num_disparities)
    : num_disparities_(num_disparities) {
  config.Validate();
  matcher_ = MakeMatcher(config, num_disparities);
}

void DisparityMatcher::Match(const cv::Mat& left_grey, const cv::Mat& right_grey,
                             cv::Mat& disparity) {
  // OpenCV leaves out the left columns from which the largest disparity would lead out of the right
  // picture: a fifth of the view at the usual values. With a border to lead into, only those
  // matches are lost that truly lie outside.
  const int border = num_disparities_;
  cv::copyMakeBorder(left_grey, wide_left_, 0, 0, border, 0, cv::BORDER_REPLICATE);
  cv::copyMakeBorder(right_grey, wide_right_, 0, 0, border, 0, cv::BORDER_REPLICATE);
  matcher_->compute(wide_left_, wide_right_, wide_disparity_);
  disparity.create(left_grey.size(), CV_16SC1);
  for (int y = 0; y < disparity.rows; ++y) {
    CopySeenByBoth(wide_disparity_.ptr<std::int16_t>(y) + border, disparity.cols,
                   disparity.ptr<std::int16_t>(y));
  }
}

}  // namespace deixis::stereo_driver
