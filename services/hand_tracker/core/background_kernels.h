#pragma once
#include <cstdint>

namespace deixis::hand_tracker {

/// Marks in `changed` (0 or 255) the pixels of a row whose largest channel difference from the
/// running average `recent` (times 128) exceeds `threshold`, then moves the average by `share256` /
/// 256.
void FollowRow(const std::uint8_t* bgr, std::uint16_t* recent, int width, int threshold,
               int share256, std::uint8_t* changed);

/// Sets `still_ms` to 0 where `changed`, else adds `elapsed_ms` up to `longest_ms`.
void CountStillRow(const std::uint8_t* changed, int width, std::uint16_t elapsed_ms, int longest_ms,
                   std::uint16_t* still_ms);

/// When a pixel becomes background, and what counts as different from it.
struct LearningRule {
  int elapsed_ms = 0;
  int still_ms = 0;    ///< Asleep for this long: learned for the first time.
  int near_ms = 0;     ///< Still itself for this long though something moves nearby: learned too.
  int replace_ms = 0;  ///< Asleep for this long: replaces what was known.
  int longest_ms = 0;
  int follow_share = 0;  ///< Of 256, towards the recent average where it looks the same.
  int threshold = 0;     ///< Grey levels between foreground and background.
};

/// Learns one row of background (times 128) and says in `knowledge` what each pixel shows.
void LearnRow(const LearningRule& rule, const std::uint8_t* bgr, const std::uint16_t* recent,
              const std::uint8_t* awake, const std::uint16_t* still_ms, const std::uint8_t* held,
              int width, std::uint16_t* asleep_ms, std::uint16_t* background, std::uint8_t* known,
              std::uint8_t* knowledge);

}  // namespace deixis::hand_tracker
