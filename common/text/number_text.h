#pragma once
#include <sstream>
#include <string>

namespace deixis::text {

/// As people write numbers, with six significant digits: "57", "0.25", "1e+09".
inline std::string NumberText(double value) {
  std::ostringstream text;
  text << value;
  return text.str();
}

}  // namespace deixis::text
