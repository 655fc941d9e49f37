#pragma once
#include "common/capture/source.h"

namespace deixis::capture {

/// The times of a recording without end: each round begins one period after the last picture of the
/// round before.
class Rounds {
 public:
  /// When what the recording has at `time` comes in this round, since the first one began.
  Timestamp Shifted(Timestamp time, double period_s);

  /// Whether another round may follow: not when this one has given nothing, since all would be as
  /// empty, nor when time is up (2^59).
  bool HasNext() const { return has_given_ && next_start_ < kLatestTime; }
  void BeginNext();

 private:
  bool has_given_ = false;
  Timestamp start_;
  Timestamp next_start_;
};

}  // namespace deixis::capture
