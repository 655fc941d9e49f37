#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "common/time/timestamp.h"

namespace deixis::capture {

/// How fast a recording is played.
enum class Pace {
  kByTime,            ///< As its times say.
  kAsFastAsPossible,  ///< One picture after the other.
};

inline auto EnumNames(Pace) {
  return std::vector<std::pair<std::string, Pace>>{
      {"by_time", Pace::kByTime}, {"as_fast_as_possible", Pace::kAsFastAsPossible}};
}

/// Decides when a recorded picture is due and which capture time it carries. The recording's times
/// are mapped once, at the first question: capture time = start + time in the recording.
class Pacer {
 public:
  /// `start_time_utime`: capture time of the recording's beginning; -1 = wall clock at the start
  /// when played by time, 0 when played as fast as possible (the same file then gives the same
  /// messages).
  Pacer(Pace pace, std::int64_t start_time_utime);

  bool IsDue(Timestamp recorded, Timestamp now);
  /// Valid from the first IsDue() on.
  Timestamp CaptureTime(Timestamp recorded) const;

  /// What is wrong when the picture that was asked for last was due more than a second ago; empty
  /// when nothing is.
  std::string trouble() const;

 private:
  Pace pace_;
  std::int64_t start_time_utime_;
  std::optional<Timestamp> began_;  ///< Wall clock at the first question.
  std::int64_t late_us_ = 0;        ///< Of the picture that was asked for last.
};

}  // namespace deixis::capture
