#pragma once
#include <string>

namespace deixis::motion {

/// A trunk, an arm that slides and a head that does not turn; two frames of 13 channels.
inline const std::string kBvh = R"(HIERARCHY
ROOT Hips
{
  OFFSET 1 2 3
  CHANNELS 6 Xposition Yposition Zposition Zrotation Xrotation Yrotation
  JOINT Chest
  {
    OFFSET 0 10 0
    CHANNELS 3 Yrotation Zrotation Xrotation
    JOINT Head
    {
      OFFSET 0 5 1
      End Site
      {
        OFFSET 0 4 0
      }
    }
    JOINT Left Hand
    {
      OFFSET 6 0 0
      CHANNELS 4 Zposition Xrotation Xposition Yrotation
      End Site
      {
        OFFSET 2 0 0
      }
    }
  }
}
MOTION
Frames: 2
Frame Time: 0.025
10 90 -5 30 -20 45 15 -35 60 1.5 70 -0.5 -25
0 0 0 0 0 0 0 0 0 0 0 0 0
)";

/// `text` with its first `from` replaced; throws nothing but std::out_of_range when there is none.
inline std::string Replaced(std::string text, const std::string& from, const std::string& to) {
  return text.replace(text.find(from), from.size(), to);
}

}  // namespace deixis::motion
