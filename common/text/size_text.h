#pragma once
#include <string>

namespace deixis::text {

/// "640x480": two counts as people write sizes of pictures, boards (columns first) and matrices
/// (rows first).
inline std::string SizeText(int first, int second) {
  return std::to_string(first) + "x" + std::to_string(second);
}

}  // namespace deixis::text
