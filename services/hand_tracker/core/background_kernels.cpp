#include "services/hand_tracker/core/background_kernels.h"

#include <algorithm>
#include <cstdlib>

#include "common/kernels/kernel.h"

namespace deixis::hand_tracker {
namespace {

constexpr int kFixedBits = 7;
constexpr std::uint8_t kBackground = 0;
constexpr std::uint8_t kUnknown = 1;
constexpr std::uint8_t kForeground = 2;

[[gnu::always_inline]] inline std::uint16_t Moved(int from, int to, int share256) {
  return static_cast<std::uint16_t>(from + ((to - from) * share256) / 256);
}

/// How different a pixel looks from its background, in grey levels: the change of colour once the
/// brightness is evened out, and a part of the change of brightness, less of it where the pixel may
/// simply lie in a shadow.
[[gnu::always_inline]] inline int Distance(const std::uint8_t* bgr,
                                           const std::uint16_t* background) {
  constexpr float kToLevels = 1.0F / (1 << kFixedBits);
  const float b0 = static_cast<float>(background[0]) * kToLevels;
  const float g0 = static_cast<float>(background[1]) * kToLevels;
  const float r0 = static_cast<float>(background[2]) * kToLevels;
  const float b = bgr[0];
  const float g = bgr[1];
  const float r = bgr[2];
  const float ratio = (b + g + r + 1.0F) / (b0 + g0 + r0 + 1.0F);
  const float colour =
      std::abs(b - ratio * b0) + std::abs(g - ratio * g0) + std::abs(r - ratio * r0);
  const float brightness = std::abs(b + g + r - b0 - g0 - r0) * (1.0F / 3.0F);
  const bool may_be_shadow = ratio > 0.6F && ratio < 1.0F;
  return static_cast<int>(colour + (may_be_shadow ? 0.25F : 0.7F) * brightness);
}

}  // namespace

DEIXIS_KERNEL void FollowRow(const std::uint8_t* bgr, std::uint16_t* recent, int width,
                             int threshold, int share256, std::uint8_t* changed) {
  for (int x = 0; x < width; ++x) {
    int largest = 0;
    for (int channel = 0; channel < 3; ++channel) {
      const int i = 3 * x + channel;
      const int now = bgr[i] << kFixedBits;
      largest = std::max(largest, std::abs(now - recent[i]));
      recent[i] = Moved(recent[i], now, share256);
    }
    changed[x] = largest > (threshold << kFixedBits) ? 255 : 0;
  }
}

DEIXIS_KERNEL void CountStillRow(const std::uint8_t* changed, int width, std::uint16_t elapsed_ms,
                                 int longest_ms, std::uint16_t* still_ms) {
  for (int x = 0; x < width; ++x) {
    const int longer = std::min(still_ms[x] + elapsed_ms, longest_ms);
    still_ms[x] = changed[x] != 0 ? std::uint16_t{0} : static_cast<std::uint16_t>(longer);
  }
}

DEIXIS_KERNEL void LearnRow(const LearningRule& rule, const std::uint8_t* bgr,
                            const std::uint16_t* recent, const std::uint8_t* awake,
                            const std::uint16_t* still_ms, const std::uint8_t* held, int width,
                            std::uint16_t* asleep_ms, std::uint16_t* background,
                            std::uint8_t* known, std::uint8_t* knowledge) {
  for (int x = 0; x < width; ++x) {
    const int asleep =
        awake[x] != 0 ? 0 : std::min(asleep_ms[x] + rule.elapsed_ms, rule.longest_ms);
    asleep_ms[x] = static_cast<std::uint16_t>(asleep);
    const bool is_same = Distance(bgr + 3 * x, background + 3 * x) <= rule.threshold;
    const bool is_known = known[x] != 0;
    const bool is_still = held[x] == 0 && still_ms[x] > rule.near_ms && !(is_known && !is_same);
    if (is_still || asleep > (is_known && !is_same ? rule.replace_ms : rule.still_ms)) {
      const int share = is_known && is_same ? rule.follow_share : 256;
      for (int i = 3 * x; i < 3 * x + 3; ++i) {
        background[i] = Moved(background[i], recent[i], share);
      }
      known[x] = 255;
      knowledge[x] = kBackground;
    } else {
      knowledge[x] = !is_known ? kUnknown : is_same ? kBackground : kForeground;
    }
  }
}

}  // namespace deixis::hand_tracker
