#pragma once
#include <cstddef>

namespace deixis::gesture_recogniser {

/// A number that is not negative, as an index.
inline std::size_t Index(int value) { return static_cast<std::size_t>(value); }

}  // namespace deixis::gesture_recogniser
