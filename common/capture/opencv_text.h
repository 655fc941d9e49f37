#pragma once
#include <cstddef>
#include <string>
#include <string_view>

namespace deixis::capture {

/// Of a calibration: a few kilobytes. OpenCV's other files of this kind are not much larger.
inline constexpr std::size_t kLargestOpenCvFile = std::size_t{4} * 1024 * 1024;
/// OpenCV's parsers call themselves for each level, with 5 kB and more on the stack.
inline constexpr int kDeepestNesting = 128;

/// What of `text` OpenCV's parsers of YAML, JSON and XML must not see, with the cure: it is binary
/// or compressed, or nests so deeply that they run out of stack. Empty when they can have it.
/// Levels are counted from above, of all these formats at once: what can be within a text, a key or
/// a comment closes none.
std::string OpenCvTextFault(std::string_view text);

}  // namespace deixis::capture
