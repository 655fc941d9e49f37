#pragma once
#include <utility>

#include "common/capture/clocks.h"

namespace deixis::capture {

/// The wall clock as it was when this began, going on by the monotonic one: a recording that is
/// played goes on evenly when somebody sets the clock.
class PlayingClock {
 public:
  explicit PlayingClock(Clocks clocks)
      : clocks_(std::move(clocks)),
        wall_began_(clocks_.wall()),
        monotonic_began_(clocks_.monotonic()) {}

  Timestamp Now() const {
    return {wall_began_.microseconds + clocks_.monotonic().microseconds -
            monotonic_began_.microseconds};
  }

 private:
  Clocks clocks_;
  Timestamp wall_began_;
  Timestamp monotonic_began_;
};

}  // namespace deixis::capture
