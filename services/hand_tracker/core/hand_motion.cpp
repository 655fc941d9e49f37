#include "services/hand_tracker/core/hand_motion.h"

#include <algorithm>
#include <cmath>

#include "common/filtering/log_probability.h"

namespace deixis::hand_tracker {
namespace {

using filtering::LogAdd;
using filtering::LogPlaneNormal;

/// Where the last speed takes the hand while it dies away.
Eigen::Vector2d Foretold(const HandMotionConfig& config, const LastSight& last) {
  const double time_s =
      config.speed_time_s * (1.0 - std::exp(-last.elapsed_s / config.speed_time_s));
  return last.position + time_s * last.velocity;
}

}  // namespace

void HandMotionConfig::Validate() const {
  config::Faults faults;
  const auto require = [&faults](double value, const char* key) {
    faults.Require(value > 0.0, key, "must be positive");
  };
  require(rest_time_s, "rest_time_s");
  require(stroke_time_s, "stroke_time_s");
  require(rest_spread, "rest_spread");
  require(rest_speed, "rest_speed");
  require(move_spread, "move_spread");
  require(move_speed, "move_speed");
  require(jump_spread, "jump_spread");
  require(jump_speed, "jump_speed");
  require(jump_largest, "jump_largest");
  require(fastest, "fastest");
  require(largest_error, "largest_error");
  require(speed_time_s, "speed_time_s");
  require(area, "area");
  faults.Require(jump_share > 0.0 && jump_share < 1.0, "jump_share", "must lie between 0 and 1");
  faults.ThrowIfAny();
}

NextPlace JudgeNextPlace(const HandMotionConfig& config, const LastSight& last,
                         const Eigen::Vector2d& position, double image_s, double hand_length_px) {
  const double stays = (position - last.position).norm() / hand_length_px;
  const double goes_on = (position - Foretold(config, last)).norm() / hand_length_px;
  const double rest_sigma = config.rest_spread + config.rest_speed * last.elapsed_s;
  const double move_sigma = config.move_spread + config.move_speed * last.elapsed_s;
  const double jump_sigma =
      std::min(config.jump_spread + config.jump_speed * last.elapsed_s, config.jump_largest);
  const double rest =
      LogAdd(LogPlaneNormal(stays, rest_sigma), LogPlaneNormal(goes_on, rest_sigma)) -
      std::log(2.0);
  const double move =
      LogAdd(std::log(1.0 - config.jump_share) + LogPlaneNormal(goes_on, move_sigma),
             std::log(config.jump_share) + LogPlaneNormal(stays, jump_sigma));
  const double log_stop = std::log(-std::expm1(-image_s / config.stroke_time_s));
  const double log_start = std::log(-std::expm1(-image_s / config.rest_time_s));
  const double log_rests = last.is_moving ? log_stop : -image_s / config.rest_time_s;
  const double log_moves = last.is_moving ? -image_s / config.stroke_time_s : log_start;
  const double anywhere = std::log(config.area);
  return {anywhere + log_rests + rest, anywhere + log_moves + move};
}

}  // namespace deixis::hand_tracker
