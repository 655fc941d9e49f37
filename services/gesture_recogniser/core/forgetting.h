#pragma once
#include <cmath>
#include <iterator>

#include "common/time/timestamp.h"

namespace deixis::gesture_recogniser {

/// Erases the entries of a map, whose values have a `last_seen`, that lie further than `memory_s`
/// from `now` on either side, so that it does not grow with the ids that were ever given.
template <typename Map>
void ForgetOlder(Map& entries, Timestamp now, double memory_s) {
  for (auto entry = entries.begin(); entry != entries.end();) {
    const bool is_old = std::abs(SecondsBetween(entry->second.last_seen, now)) > memory_s;
    entry = is_old ? entries.erase(entry) : std::next(entry);
  }
}

}  // namespace deixis::gesture_recogniser
