#pragma once
#include <cstdint>

namespace deixis {

/// Capture time of an image and of everything that came from it: microseconds since 1970 (or since
/// the start of a recording). It travels unchanged from the camera to the last result; nobody
/// stamps "now".
struct Timestamp {
  std::int64_t microseconds = 0;
};

/// Seconds from `earlier` to `later`; negative when the order is the other way round. Exact for 285
/// years around 1970, and without overflow for any two times.
inline double SecondsBetween(Timestamp earlier, Timestamp later) {
  return 1e-6 *
         (static_cast<double>(later.microseconds) - static_cast<double>(earlier.microseconds));
}

inline bool operator==(Timestamp a, Timestamp b) { return a.microseconds == b.microseconds; }
inline bool operator!=(Timestamp a, Timestamp b) { return a.microseconds != b.microseconds; }
inline bool operator<(Timestamp a, Timestamp b) { return a.microseconds < b.microseconds; }

}  // namespace deixis
