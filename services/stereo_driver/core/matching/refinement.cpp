#include "services/stereo_driver/core/matching/refinement.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "services/stereo_driver/core/matching/disparity.h"
#include "services/stereo_driver/core/matching/refinement_kernels.h"

namespace deixis::stereo_driver {
namespace {

constexpr int kLeastWidth_px = 8;

/// In pixels, kAbsent_px where there is none.
void ToPixels(const cv::Mat& disparity, cv::Mat& disparity_px) {
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

/// What smoothing may have led farther than a pixel from its start is held there.
void HoldRow(const float* start_px, const float* found_px, int width, float* held_px) {
  constexpr float kLeast_px = 1.0F / kDisparityScale;
  for (int x = 0; x < width; ++x) {
    const float start = start_px[x];
    const float held =
        std::min(std::max(found_px[x], std::max(kLeast_px, start - 1.0F)), start + 1.0F);
    held_px[x] = start > 0.0F ? held : kAbsent_px;
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
  const cv::Rect whole({0, 0}, disparity.size());
  MakeRoom(left_grey.size(), whole);
  ToPixels(disparity, start_px_);
  Run(left_grey, right_grey, whole);
  ToSixteenths(current_px_, disparity);
}

void DisparityRefiner::RefineWindow(const cv::Mat& left_grey, const cv::Mat& right_grey,
                                    const cv::Rect& window, cv::Mat& disparity_px) {
  if (config_.iterations == 0 || window.width < kLeastWidth_px || window.height < 1) return;
  MakeRoom(left_grey.size(), window);
  disparity_px.copyTo(start_px_);
  Run(left_grey, right_grey, window);
  for (int y = 0; y < window.height; ++y) {
    HoldRow(start_px_.ptr<float>(y), current_px_.ptr<float>(y), window.width,
            disparity_px.ptr<float>(y));
  }
}

void DisparityRefiner::MakeRoom(cv::Size picture, const cv::Rect& window) {
  cv::Mat* const views[] = {&left_,        &start_px_,     &current_px_,
                            &slope_error_, &slope_square_, &blurred_};
  for (std::size_t i = 0; i < std::size(views); ++i) {
    buffers_[i].create(picture, CV_32FC1);
    *views[i] = buffers_[i](cv::Rect({0, 0}, window.size()));
  }
  right_buffer_.create(picture, CV_32FC1);
  right_ = right_buffer_.rowRange(0, window.height);
  const int border = config_.smoothing_px - 1;
  const cv::Size margin(border, border);
  bordered_buffer_.create(picture + margin, CV_32FC1);
  bordered_px_ = bordered_buffer_(cv::Rect({0, 0}, window.size() + margin));
}

void DisparityRefiner::Run(const cv::Mat& left_grey, const cv::Mat& right_grey,
                           const cv::Rect& window) {
  start_px_.copyTo(current_px_);
  left_grey(window).convertTo(left_, CV_32F);
  right_grey.rowRange(window.y, window.y + window.height).convertTo(right_, CV_32F);
  for (int i = 0; i < config_.iterations; ++i) {
    Align(window.x);
    Smooth();
  }
}

void DisparityRefiner::Align(int first_column) {
  const int width = current_px_.cols;
  cv::parallel_for_({0, current_px_.rows}, [&](const cv::Range& rows) {
    for (int y = rows.start; y < rows.end; ++y) {
      CompareRow(left_.ptr<float>(y), {right_.ptr<float>(y), right_.cols, first_column},
                 current_px_.ptr<float>(y), width, slope_error_.ptr<float>(y),
                 slope_square_.ptr<float>(y));
    }
  });
  Blur(slope_error_);
  Blur(slope_square_);
  for (int y = 0; y < current_px_.rows; ++y) {
    StepRow(slope_error_.ptr<float>(y), slope_square_.ptr<float>(y), start_px_.ptr<float>(y), width,
            current_px_.ptr<float>(y));
  }
}

void DisparityRefiner::Blur(cv::Mat& values) {
  const cv::Size window(config_.window_px, config_.window_px);
  const double sigma = 0.19 * config_.window_px;  // The window ends at 2.6 sigma.
  // Isolated: what lies in the buffers beside the window is of another one.
  cv::GaussianBlur(values, blurred_, window, sigma, sigma,
                   cv::BORDER_DEFAULT | cv::BORDER_ISOLATED);
  cv::swap(values, blurred_);
}

void DisparityRefiner::Smooth() {
  const int border = config_.smoothing_px / 2;
  cv::copyMakeBorder(current_px_, bordered_px_, border, border, border, border,
                     cv::BORDER_CONSTANT | cv::BORDER_ISOLATED, cv::Scalar(kAbsent_px));
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
