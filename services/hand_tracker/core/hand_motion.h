#pragma once
#include <Eigen/Core>

#include "common/config/config.h"

namespace deixis::hand_tracker {

struct HandMotionConfig {
  double rest_time_s = 1.6;    ///< Mean time between two fast motions.
  double stroke_time_s = 0.4;  ///< Mean time that a fast motion lasts.
  double rest_spread = 0.1;    ///< Sigma of a resting hand's place from image to image ...
  double rest_speed = 0.6;     ///< ... and how it grows with time, per second.
  double move_spread = 0.12;   ///< Sigma of a moving hand about where its speed takes it ...
  double move_speed = 2.5;     ///< ... and how it grows with time, per second.
  double jump_spread = 0.25;   ///< The same of a hand whose motion nothing foretold ...
  double jump_speed = 13.0;    ///< ... per second ...
  double jump_largest = 3.0;   ///< ... and at most.
  double jump_share = 0.05;    ///< Share of fast motions of that kind.
  double fastest = 18.0;       ///< No hand is faster, per second: about 3.5 m/s.
  double largest_error = 0.5;  ///< What it may be farther away all the same.
  double speed_time_s = 0.3;   ///< In which the speed of a hand that is not seen dies away.
  double area = 40.0;          ///< In which hands and what looks like them are found.

  template <typename Visitor>
  void Visit(Visitor& v) {
    v("rest_time_s", rest_time_s);
    v("stroke_time_s", stroke_time_s);
    v("rest_spread", rest_spread);
    v("rest_speed", rest_speed);
    v("move_spread", move_spread);
    v("move_speed", move_speed);
    v("jump_spread", jump_spread);
    v("jump_speed", jump_speed);
    v("jump_largest", jump_largest);
    v("jump_share", jump_share);
    v("fastest", fastest);
    v("largest_error", largest_error);
    v("speed_time_s", speed_time_s);
    v("area", area);
  }
  void Validate() const;
};

/// Where a hand was last seen, and how it moved there. Pixels.
struct LastSight {
  Eigen::Vector2d position = Eigen::Vector2d::Zero();
  Eigen::Vector2d velocity = Eigen::Vector2d::Zero();  ///< Per second.
  double elapsed_s = 0.0;                              ///< Since then.
  bool is_moving = false;                              ///< Faster than hands do at rest.
};

/// Log density of a hand's next place, relative to one that may be anywhere in `area`.
struct NextPlace {
  double resting = 0.0;
  double moving = 0.0;
};

/// How likely a hand goes to `position`; `image_s` after the last image. Lengths are divided by
/// `hand_length_px`.
NextPlace JudgeNextPlace(const HandMotionConfig& config, const LastSight& last,
                         const Eigen::Vector2d& position, double image_s, double hand_length_px);

}  // namespace deixis::hand_tracker
