#include "services/stereo_driver/core/matching/refinement.h"

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "services/stereo_driver/core/matching/disparity.h"
#include "services/stereo_driver/core/matching/refinement_kernels.h"

namespace deixis::stereo_driver {
namespace {

constexpr int kLeastWidth_px = 8;

/// In pixels, kAbsent_px where there is none.
void ToPixels(const cv::Mat& disparity, cv::Mat& disparity_px) {
  disparity_px.create(disparity.size(), CV_32FC1);
  for (int y = 0; y < disparity.rows; ++y) {
    const auto* from = disparity.ptr<std::int16_t>(y);
    auto* to = disparity_px.ptr<float>(y);
    for (int x = 0; x < disparity.cols; ++x) {
      to[x] = from[x] > 0 ? static_cast<float>(from[x]) * (1.0F / kDisparityScale) : kAbsent_px;
    }
  }
}

/// The nearest 1/16, within a pixel of what `disparity` holds: smoothing goes farther where much
/// agrees by its configuration. What was valid stays valid.
void ToSixteenths(const cv::Mat& disparity_px, cv::Mat& disparity) {
  for (int y = 0; y < disparity.rows; ++y) {
    const auto* from = disparity_px.ptr<float>(y);
    auto* to = disparity.ptr<std::int16_t>(y);
    for (int x = 0; x < disparity.cols; ++x) {
      if (to[x] <= 0) continue;
      const long sixteenths = std::lround(from[x] * kDisparityScale);
      const long least = std::max(1, to[x] - kDisparityScale);
      const long most = to[x] + kDisparityScale;
      to[x] = static_cast<std::int16_t>(std::clamp(sixteenths, least, most));
    }
  }
}

}  // namespace

void RefinementConfig::Validate() const {
  config::Faults faults;
  faults.Require(iterations >= 0 && iterations <= 20, "iterations", "must lie between 0 and 20");
  faults.Require(window_px % 2 == 1 && window_px >= 3 && window_px <= 99, "window_px",
                 "must be odd, from 3 to 99");
  faults.Require(smoothing_px % 2 == 1 && smoothing_px >= 1 && smoothing_px <= 31, "smoothing_px",
                 "must be odd, from 1 to 31");
  faults.Require(agree_px > 0.0 && agree_px <= 10.0, "agree_px", "must lie between 0 and 10");
  faults.ThrowIfAny();
}

DisparityRefiner::DisparityRefiner(const RefinementConfig& config) : config_(config) {
  config_.Validate();
}

void DisparityRefiner::Refine(const cv::Mat& left_grey, const cv::Mat& right_grey,
                              cv::Mat& disparity) {
  if (config_.iterations == 0 || disparity.cols < kLeastWidth_px) return;
  ToPixels(disparity, start_px_);
  start_px_.copyTo(current_px_);
  left_grey.convertTo(left_, CV_32F);
  right_grey.convertTo(right_, CV_32F);
  for (int i = 0; i < config_.iterations; ++i) {
    Align();
    Smooth();
  }
  ToSixteenths(current_px_, disparity);
}

void DisparityRefiner::Align() {
  slope_error_.create(current_px_.size(), CV_32FC1);
  slope_square_.create(current_px_.size(), CV_32FC1);
  const int width = current_px_.cols;
  cv::parallel_for_({0, current_px_.rows}, [&](const cv::Range& rows) {
    for (int y = rows.start; y < rows.end; ++y) {
      CompareRow(left_.ptr<float>(y), right_.ptr<float>(y), current_px_.ptr<float>(y), width,
                 slope_error_.ptr<float>(y), slope_square_.ptr<float>(y));
    }
  });
  const cv::Size window(config_.window_px, config_.window_px);
  const double sigma = 0.19 * config_.window_px;  // The window ends at 2.6 sigma.
  cv::GaussianBlur(slope_error_, slope_error_, window, sigma);
  cv::GaussianBlur(slope_square_, slope_square_, window, sigma);
  for (int y = 0; y < current_px_.rows; ++y) {
    StepRow(slope_error_.ptr<float>(y), slope_square_.ptr<float>(y), start_px_.ptr<float>(y), width,
            current_px_.ptr<float>(y));
  }
}

void DisparityRefiner::Smooth() {
  const int border = config_.smoothing_px / 2;
  cv::copyMakeBorder(current_px_, bordered_px_, border, border, border, border, cv::BORDER_CONSTANT,
                     cv::Scalar(kAbsent_px));
  const auto stride = static_cast<std::int64_t>(bordered_px_.step1());
  const auto agree_px = static_cast<float>(config_.agree_px);
  cv::parallel_for_({0, current_px_.rows}, [&](const cv::Range& rows) {
    for (int y = rows.start; y < rows.end; ++y) {
      SmoothRow(bordered_px_.ptr<float>(y), stride, config_.smoothing_px, agree_px,
                current_px_.cols, current_px_.ptr<float>(y));
    }
  });
}

}  // namespace deixis::stereo_driver
