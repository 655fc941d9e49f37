#include "services/stereo_driver/core/matching/people/people_measurer.h"

#include <algorithm>
#include <opencv2/imgproc.hpp>

#include "services/stereo_driver/core/matching/disparity.h"
#include "services/stereo_driver/core/matching/people/fine_depth_kernels.h"
#include "services/stereo_driver/core/matching/refinement_kernels.h"

namespace deixis::stereo_driver {
namespace {

cv::Rect Halved(const cv::Rect& window) {
  return {window.x / 2, window.y / 2, window.width / 2, window.height / 2};
}

const PeopleConfig& Validated(const PeopleConfig& config) {
  config.Validate();
  config.alignment.Validate();
  return config;
}

}  // namespace

void PeopleConfig::Validate() const {
  config::Faults faults;
  faults.Require(margin_m >= 0.0 && margin_m <= 2.0, "margin_m", "must lie between 0 and 2");
  faults.Require(speed_m_per_s >= 0.0 && speed_m_per_s <= 20.0, "speed_m_per_s",
                 "must lie between 0 and 20");
  faults.Require(memory_s >= 0.0 && memory_s <= 10.0, "memory_s", "must lie between 0 and 10");
  faults.Require(largest_share > 0.0 && largest_share <= 1.0, "largest_share",
                 "must be above 0, at most 1");
  faults.ThrowIfAny();
}

PeopleMeasurer::PeopleMeasurer(const PeopleConfig& config, const DepthGeometry& half)
    : config_(Validated(config)), half_(half), refiner_(config.alignment) {}

void PeopleMeasurer::Measure(const Windows& said, const RectifiedPair& pair,
                             const cv::Mat& half_left_grey, const cv::Mat& half_right_grey,
                             cv::Mat& half_disparity) {
  const cv::Size size = pair.left_grey.size();
  windows_.clear();
  // The pixels of the halves of odd sizes are no pairs of pixels.
  if (size.width % 2 != 0 || size.height % 2 != 0) return;
  windows_ = said.empty()
                 ? Tidied(standing_out_.Find(half_disparity, half_), size, config_.largest_share)
                 : Tidied(said, size, 1.0);
  if (config_.sharpens_silhouettes) {
    Sharpen(pair, half_left_grey, half_right_grey, half_disparity);
  }
  disparity_px_.create(size, CV_32FC1);
  for (const cv::Rect& window : windows_) Align(pair, window, half_disparity);
}

void PeopleMeasurer::Sharpen(const RectifiedPair& pair, const cv::Mat& half_left_grey,
                             const cv::Mat& half_right_grey, cv::Mat& half_disparity) {
  half_bgr_.create(half_disparity.size(), CV_8UC3);
  for (const cv::Rect& window : windows_) {
    const cv::Rect half = Halved(window);
    cv::Mat half_bgr = half_bgr_(half);
    cv::resize(pair.left_bgr(window), half_bgr, half.size(), 0.0, 0.0, cv::INTER_AREA);
    sharpener_.Sharpen({half_bgr_, half_left_grey, half_right_grey}, half, half_disparity);
  }
}

void PeopleMeasurer::Align(const RectifiedPair& pair, const cv::Rect& window,
                           const cv::Mat& half_disparity) {
  cv::Mat disparity_px = disparity_px_(window);
  for (int y = 0; y < window.height; ++y) {
    const auto* from = half_disparity.ptr<std::int16_t>((window.y + y) / 2) + window.x / 2;
    DoubleRow(from, window.width / 2, disparity_px.ptr<float>(y));
  }
  refiner_.RefineWindow(pair.left_grey, pair.right_grey, window, disparity_px);
}

void PeopleMeasurer::WriteTo(cv::Mat& depth_mm) const {
  const bool is_full = depth_mm.size() == disparity_px_.size();
  // Of full-size pixels, of which the focal length is twice as many.
  const FineDepthRange range = {static_cast<float>(2000.0 * half_.focal_px * half_.baseline_m),
                                static_cast<float>(1000.0 * half_.nearest_m),
                                static_cast<float>(1000.0 * half_.farthest_m)};
  for (const cv::Rect& window : windows_) {
    const cv::Rect target = is_full ? window : Halved(window);
    for (int y = 0; y < target.height; ++y) {
      auto* to = depth_mm.ptr<std::uint16_t>(target.y + y) + target.x;
      if (is_full) {
        DepthRow(disparity_px_.ptr<float>(window.y + y) + window.x, target.width, range, to);
      } else {
        HalvedDepthRow(disparity_px_.ptr<float>(window.y + 2 * y) + window.x,
                       disparity_px_.ptr<float>(window.y + 2 * y + 1) + window.x, target.width,
                       range, to);
      }
    }
  }
}

}  // namespace deixis::stereo_driver
