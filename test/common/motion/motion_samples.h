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

/// A pelvis, an arm of two bones (the second turns in the order ZXY) and a leg that does not turn.
inline const std::string kAsf = R"(# by hand
:version 1.10
:name sample
:units
  mass 1.0
  length 0.5
  angle deg
:documentation
  Free text,
  in :lines
:root
  order TZ TX TY RX RZ RY
  axis XYZ
  position 1 2 3
  orientation 10 -20 30
:bonedata
  begin
    id 1
    name hand
    direction 0 0.8 0.6
    length 1.5
    axis 5 10 15 XYZ
  end
  begin
    id 2
    name upper
    direction 1 0 0
    length 4
    axis 20 -30 40 XYZ
    dof rx ry rz
    limits (-160.0 20.0)
           (-70.0, 70.0)
           (-inf inf)
  end
  begin
    id 3
    name lower
    direction 0.6 -0.8 0
    length 3
    axis -15 25 35 ZXY
    dof rz ry
    limits (-10 170) (0 1)
  end
  begin
    id 4
    name leg
    direction 0 -1 0
    length 5
    axis 0 0 0 XYZ
  end
:hierarchy
  begin
    root leg upper
    upper lower
    lower hand
  end
)";

inline const std::string kAmc = R"(#!made by hand
:FULLY-SPECIFIED
:DEGREES
1
root 10 20 30 40 50 60
upper 15 -25 35
lower 45 -55
2
lower 0 0
upper 0 0 0
root 0 0 0 0 0 0
)";

/// `text` with its first `from` replaced; throws nothing but std::out_of_range when there is none.
inline std::string Replaced(std::string text, const std::string& from, const std::string& to) {
  return text.replace(text.find(from), from.size(), to);
}

}  // namespace deixis::motion
