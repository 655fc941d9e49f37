#include "services/hand_tracker/core/background_model.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "services/hand_tracker/core/background_kernels.h"

namespace deixis::hand_tracker {
namespace {

constexpr int kFixed = 128;        // Fixed-point factor of the averages.
constexpr int kLongestMs = 60000;  // Where the stop-watches stand still.

int Milliseconds(double seconds) {
  return static_cast<int>(std::lround(1000.0 * std::clamp(seconds, 0.0, 30.0)));
}

/// Weight of the newest value in a running average, in 1/256.
int Share256(double elapsed_s, double time_s) {
  return std::clamp(static_cast<int>(std::lround(256.0 * (1.0 - std::exp(-elapsed_s / time_s)))), 1,
                    256);
}

/// Median over a grid of known pixels of the brightness now over that of the background, or
/// `otherwise` when too few are known.
double LightGain(const cv::Mat& bgr, const cv::Mat& background, const cv::Mat& known,
                 double otherwise) {
  constexpr int kStep = 5;
  constexpr std::size_t kLeast = 200;
  std::vector<float> ratios;
  for (int y = 0; y < bgr.rows; y += kStep) {
    for (int x = 0; x < bgr.cols; x += kStep) {
      if (known.at<std::uint8_t>(y, x) == 0) continue;
      const auto& now = bgr.at<cv::Vec3b>(y, x);
      const auto& before = background.at<cv::Vec<std::uint16_t, 3>>(y, x);
      const int sum_now = now[0] + now[1] + now[2];
      const int sum_before = before[0] + before[1] + before[2];
      if (sum_before < 60 * kFixed || std::max({now[0], now[1], now[2]}) > 250) continue;
      ratios.push_back(static_cast<float>(sum_now * kFixed) / static_cast<float>(sum_before));
    }
  }
  if (ratios.size() < kLeast) return otherwise;
  const auto middle = ratios.begin() + static_cast<std::ptrdiff_t>(ratios.size() / 2);
  std::nth_element(ratios.begin(), middle, ratios.end());
  return std::clamp(static_cast<double>(*middle), 0.2, 5.0);
}

}  // namespace

void BackgroundModelConfig::Validate() const {
  config::Faults faults;
  faults.Require(recent_time_s > 0.0, "recent_time_s", "must be positive");
  faults.Require(still_time_s > 0.0, "still_time_s", "must be positive");
  faults.Require(near_time_s > 0.0, "near_time_s", "must be positive");
  faults.Require(replace_time_s > 0.0, "replace_time_s", "must be positive");
  faults.Require(follow_time_s > 0.0, "follow_time_s", "must be positive");
  faults.Require(change_threshold > 0.0, "change_threshold", "must be positive");
  faults.Require(foreground_threshold > 0.0, "foreground_threshold", "must be positive");
  faults.Require(moving_share > 0.0 && moving_share <= 1.0, "moving_share",
                 "must lie between 0 and 1");
  faults.ThrowIfAny();
}

BackgroundModel::BackgroundModel(const BackgroundModelConfig& config) : config_(config) {}

void BackgroundModel::Reset() { recent_.release(); }

void BackgroundModel::Update(const cv::Mat& bgr, const cv::Mat& held, double elapsed_s,
                             int reach_px) {
  if (recent_.size() != bgr.size()) {
    Start(bgr);
    return;
  }
  NormaliseLight(bgr);
  FindChange(elapsed_s);
  FindAwake(held, reach_px);
  Learn(held, elapsed_s);
}

void BackgroundModel::Start(const cv::Mat& bgr) {
  gain_ = 1.0;
  camera_moves_ = false;
  bgr.copyTo(normalised_);
  bgr.convertTo(recent_, CV_16U, kFixed);
  recent_.copyTo(background_);
  known_ = cv::Mat::zeros(bgr.size(), CV_8UC1);
  // Half awake: who rests at the start shall have time to sway before becoming background.
  still_ms_ = cv::Mat(bgr.size(), CV_16UC1, cv::Scalar(Milliseconds(0.5 * config_.still_time_s)));
  asleep_ms_ = cv::Mat::zeros(bgr.size(), CV_16UC1);
  changed_ = cv::Mat::zeros(bgr.size(), CV_8UC1);
  awake_ = cv::Mat::zeros(bgr.size(), CV_8UC1);
  knowledge_ = cv::Mat(bgr.size(), CV_8UC1, cv::Scalar(kUnknown));
}

void BackgroundModel::NormaliseLight(const cv::Mat& bgr) {
  gain_ = LightGain(bgr, background_, known_, gain_);
  bgr.convertTo(normalised_, CV_8U, 1.0 / gain_);
}

void BackgroundModel::FindChange(double elapsed_s) {
  const int threshold = static_cast<int>(std::lround(config_.change_threshold));
  const int share = Share256(elapsed_s, config_.recent_time_s);
  cv::Mat raw(normalised_.size(), CV_8UC1);
  for (int y = 0; y < raw.rows; ++y) {
    FollowRow(normalised_.ptr<std::uint8_t>(y), recent_.ptr<std::uint16_t>(y), raw.cols, threshold,
              share, raw.ptr<std::uint8_t>(y));
  }
  // Noise changes single pixels; what moves changes several side by side.
  cv::Mat crowd;
  cv::blur(raw, crowd, {3, 3}, {-1, -1}, cv::BORDER_REPLICATE);
  cv::threshold(crowd, changed_, 255.0 * 3.5 / 9.0, 255.0, cv::THRESH_BINARY);
  const double share_changed = cv::countNonZero(changed_) / static_cast<double>(changed_.total());
  camera_moves_ = share_changed > config_.moving_share;
  if (camera_moves_) known_.setTo(0);
  const auto elapsed_ms = static_cast<std::uint16_t>(Milliseconds(elapsed_s));
  for (int y = 0; y < raw.rows; ++y) {
    CountStillRow(changed_.ptr<std::uint8_t>(y), raw.cols, elapsed_ms, kLongestMs,
                  still_ms_.ptr<std::uint16_t>(y));
  }
}

void BackgroundModel::FindAwake(const cv::Mat& held, int reach_px) {
  cv::Mat moved;
  cv::compare(still_ms_, cv::Scalar(Milliseconds(config_.still_time_s)), moved, cv::CMP_LT);
  const int size = 2 * std::max(1, reach_px) + 1;
  cv::dilate(moved, awake_, cv::getStructuringElement(cv::MORPH_RECT, {size, size}));
  cv::bitwise_or(awake_, held, awake_);
}

void BackgroundModel::Learn(const cv::Mat& held, double elapsed_s) {
  LearningRule rule;
  rule.elapsed_ms = Milliseconds(elapsed_s);
  rule.still_ms = Milliseconds(config_.still_time_s);
  rule.near_ms = Milliseconds(config_.near_time_s);
  rule.replace_ms = Milliseconds(config_.replace_time_s);
  rule.longest_ms = kLongestMs;
  rule.follow_share = Share256(elapsed_s, config_.follow_time_s);
  rule.threshold = static_cast<int>(std::lround(config_.foreground_threshold));
  for (int y = 0; y < normalised_.rows; ++y) {
    LearnRow(rule, normalised_.ptr<std::uint8_t>(y), recent_.ptr<std::uint16_t>(y),
             awake_.ptr<std::uint8_t>(y), still_ms_.ptr<std::uint16_t>(y),
             held.ptr<std::uint8_t>(y), normalised_.cols, asleep_ms_.ptr<std::uint16_t>(y),
             background_.ptr<std::uint16_t>(y), known_.ptr<std::uint8_t>(y),
             knowledge_.ptr<std::uint8_t>(y));
  }
}

}  // namespace deixis::hand_tracker
