#include "services/stereo_driver/core/matching/people/silhouettes.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <opencv2/imgproc.hpp>

#include "services/stereo_driver/core/matching/disparity.h"

namespace deixis::stereo_driver {
namespace {

constexpr int kReach_px = 4;            // How far matchers spread near disparities.
constexpr int kStep = kDisparityScale;  // A smaller step between surfaces is none.
constexpr int kWidestHole_px = 24;
constexpr int kAround_px = 8;          // Where colours of either surface are looked up,
constexpr int kEvery_px = 2;           // at every so manyth pixel.
constexpr int kLeastSamples = 2;       // Of either surface, else a pixel stays as it is.
constexpr float kColourScale = 12.0F;  // Grey levels at which a colour is half the same.
constexpr float kFloor = 0.01F;        // Keeps strange colours from deciding.
constexpr float kPerGreyLevel = 0.1F;  // What the right picture counts.
constexpr float kLargestMiss = 30.0F;  // Grey levels.
constexpr float kLargestVote = 2.0F;
constexpr float kUndecided = 0.5F;   // Stays.
constexpr float kGivenBack = -0.6F;  // A body's pixel lost costs more than one kept too many.
constexpr std::int16_t kHighest = std::numeric_limits<std::int16_t>::max();

cv::Mat View(cv::Mat& buffer, cv::Size picture, cv::Size window, int type) {
  buffer.create(picture, type);
  return buffer(cv::Rect({0, 0}, window));
}

float ColourLikeness(const cv::Vec3b& a, const cv::Vec3b& b) {
  float square = 0.0F;
  for (int i = 0; i < 3; ++i) {
    const auto difference = static_cast<float>(a[i] - b[i]);
    square += difference * difference;
  }
  return 1.0F / (1.0F + square / (kColourScale * kColourScale));
}

/// Mean difference of 3x3 pixels and those that `sixteenths` leads to.
float Miss(const MatchedPair& pair, cv::Point centre, int sixteenths) {
  float sum = 0.0F;
  const float shift_px = static_cast<float>(sixteenths) / kDisparityScale;
  const int width = pair.right_grey.cols;
  for (int dy = -1; dy <= 1; ++dy) {
    const int y = std::clamp(centre.y + dy, 0, pair.left_grey.rows - 1);
    const auto* left = pair.left_grey.ptr<std::uint8_t>(y);
    const auto* right = pair.right_grey.ptr<std::uint8_t>(y);
    for (int dx = -1; dx <= 1; ++dx) {
      const int x = std::clamp(centre.x + dx, 0, width - 1);
      const float place =
          std::clamp(static_cast<float>(x) - shift_px, 0.0F, static_cast<float>(width) - 2.0F);
      const int i = static_cast<int>(place);
      const float share = place - static_cast<float>(i);
      const float seen =
          static_cast<float>(right[i]) * (1.0F - share) + static_cast<float>(right[i + 1]) * share;
      sum += std::min(kLargestMiss, std::abs(static_cast<float>(left[x]) - seen));
    }
  }
  return sum / 9.0F;
}

}  // namespace

void SilhouetteSharpener::Sharpen(const MatchedPair& pair, const cv::Rect& window,
                                  cv::Mat& disparity) {
  const cv::Size picture = disparity.size();
  filled_ = View(filled_buffer_, picture, window.size(), CV_16SC1);
  lowest_ = View(lowest_buffer_, picture, window.size(), CV_16SC1);
  band_ = View(band_buffer_, picture, window.size(), CV_8UC1);
  judged_ = View(judged_buffer_, picture, window.size(), CV_32FC1);
  cv::Mat inside = disparity(window);
  FillHoles(inside);
  FindBand(inside);
  for (const BandPixel& pixel : pixels_) {
    judged_.at<float>(pixel.place) = Judged(pair, window, pixel);
  }
  for (const BandPixel& pixel : pixels_) {
    if (MeanJudgement(pixel) >= kGivenBack) continue;
    inside.at<std::int16_t>(pixel.place) =
        static_cast<std::int16_t>(pixel.is_hidden ? kNoDisparity : pixel.far);
  }
}

void SilhouetteSharpener::FillHoles(const cv::Mat& disparity) {
  for (int y = 0; y < disparity.rows; ++y) {
    const auto* from = disparity.ptr<std::int16_t>(y);
    auto* to = filled_.ptr<std::int16_t>(y);
    for (int x = 0; x < disparity.cols;) {
      int end = x;
      while (end < disparity.cols && from[end] <= 0) ++end;
      const std::int16_t before = x > 0 ? from[x - 1] : kHighest;
      const std::int16_t behind = end < disparity.cols ? from[end] : kHighest;
      const bool is_narrow = end - x <= kWidestHole_px;
      std::fill(to + x, to + end, is_narrow ? std::min(before, behind) : kHighest);
      if (end < disparity.cols) to[end] = from[end];
      x = end + 1;
    }
  }
}

void SilhouetteSharpener::FindBand(const cv::Mat& disparity) {
  constexpr int kSide = 2 * kReach_px + 1;
  static const cv::Mat kSquare = cv::Mat::ones(kSide, kSide, CV_8UC1);
  cv::erode(filled_, lowest_, kSquare, {-1, -1}, 1, cv::BORDER_REPLICATE | cv::BORDER_ISOLATED);
  pixels_.clear();
  band_.setTo(0);
  for (int y = 0; y < disparity.rows; ++y) {
    const auto* near = disparity.ptr<std::int16_t>(y);
    const auto* lowest = lowest_.ptr<std::int16_t>(y);
    for (int x = 0; x < disparity.cols; ++x) {
      if (near[x] <= 0 || lowest[x] >= near[x] - kStep) continue;
      AddToBand({x, y}, near[x]);
    }
  }
}

void SilhouetteSharpener::AddToBand(cv::Point place, int near) {
  int nearest = kReach_px * kReach_px + 2;
  BandPixel pixel{place, near, 0, false};
  const cv::Rect whole({0, 0}, filled_.size());
  for (int dy = -kReach_px; dy <= kReach_px; ++dy) {
    for (int dx = -kReach_px; dx <= kReach_px; ++dx) {
      const int square = dx * dx + dy * dy;
      const cv::Point other = place + cv::Point(dx, dy);
      if (square >= nearest || !other.inside(whole)) continue;
      const int far = filled_.at<std::int16_t>(other);
      if (far >= near - kStep) continue;
      nearest = square;
      pixel.far = far;
      pixel.is_hidden = dx < 0;
    }
  }
  if (pixel.far <= 0) return;
  band_.at<std::uint8_t>(place) = 255;
  pixels_.push_back(pixel);
}

float SilhouetteSharpener::Judged(const MatchedPair& pair, const cv::Rect& window,
                                  const BandPixel& pixel) const {
  const cv::Vec3b colour = pair.left_bgr.at<cv::Vec3b>(pixel.place + window.tl());
  float near_sum = 0.0F, far_sum = 0.0F;
  int near_count = 0, far_count = 0;
  const cv::Point low(std::max(pixel.place.x - kAround_px, 0),
                      std::max(pixel.place.y - kAround_px, 0));
  const cv::Point high(std::min(pixel.place.x + kAround_px, filled_.cols - 1),
                       std::min(pixel.place.y + kAround_px, filled_.rows - 1));
  for (int y = low.y; y <= high.y; y += kEvery_px) {
    const auto* disparities = filled_.ptr<std::int16_t>(y);
    const auto* band = band_.ptr<std::uint8_t>(y);
    const auto* colours = pair.left_bgr.ptr<cv::Vec3b>(y + window.y) + window.x;
    for (int x = low.x; x <= high.x; x += kEvery_px) {
      const int other = disparities[x];
      const bool is_near = band[x] == 0 && 2 * std::abs(other - pixel.near) < 3 * kStep;
      const bool is_far = other < pixel.near - kStep && std::abs(other - pixel.far) < 2 * kStep;
      if (is_near == is_far) continue;
      const float likeness = ColourLikeness(colour, colours[x]);
      (is_near ? near_sum : far_sum) += likeness;
      ++(is_near ? near_count : far_count);
    }
  }
  if (near_count < kLeastSamples || far_count < kLeastSamples) return kUndecided;
  float vote = std::log((near_sum / static_cast<float>(near_count) + kFloor) /
                        (far_sum / static_cast<float>(far_count) + kFloor));
  if (!pixel.is_hidden) {
    const cv::Point place = pixel.place + window.tl();
    vote += kPerGreyLevel * (Miss(pair, place, pixel.far) - Miss(pair, place, pixel.near));
  }
  return std::clamp(vote, -kLargestVote, kLargestVote);
}

float SilhouetteSharpener::MeanJudgement(const BandPixel& pixel) const {
  float sum = 0.0F;
  int count = 0;
  const cv::Rect whole({0, 0}, band_.size());
  for (int dy = -1; dy <= 1; ++dy) {
    for (int dx = -1; dx <= 1; ++dx) {
      const cv::Point other = pixel.place + cv::Point(dx, dy);
      if (!other.inside(whole) || band_.at<std::uint8_t>(other) == 0) continue;
      if (std::abs(filled_.at<std::int16_t>(other) - pixel.near) >= 2 * kStep) continue;
      sum += judged_.at<float>(other);
      ++count;
    }
  }
  return sum / static_cast<float>(count);
}

}  // namespace deixis::stereo_driver
