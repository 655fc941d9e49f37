#pragma once
#include <string>
#include <vector>

#include "common/config/config.h"
#include "common/scene/box.h"
#include "services/gesture_recogniser/core/gesture_model.h"
#include "services/gesture_recogniser/core/motion_features.h"

namespace deixis::gesture_recogniser {

struct TrainingConfig {
  int points = 21;  ///< Points of a model.
  double smallest_speed_spread_m_per_s = 0.1;
  double smallest_turn_spread_rad = 0.12;
  double smallest_shape_spread = 0.12;
  double context_begin = 0.5;            ///< Phase from which a model has a context area.
  double context_half_angle_rad = 0.26;  ///< Half of the area's opening.
};

/// One labelled example, from its beginning to its end.
struct Example {
  double duration_s = 0.0;
  std::vector<double> speed_m_per_s;  ///< At equal steps of phase, as many as a model has points.
  std::vector<double> turn_rad;       ///< The same.
  std::vector<double> centred_speed_m_per_s;  ///< The same.
  std::vector<double> gap_m;       ///< Distance to the object's box; empty without an object.
  double final_gap_m = 0.0;        ///< In the hold.
  double arrival_error_rad = 0.0;  ///< Last part of the way against the object's direction.
  double posture_error_rad = 0.0;  ///< Forearm as guessed against the object's direction.
};

/// Averages examples of a gesture that refers to an object into its model. Throws
/// std::invalid_argument without examples.
GestureModel TrainStroke(const TrainingConfig& config, const std::string& name,
                         const std::vector<Example>& examples);

/// Averages examples of a resting hand.
GestureModel TrainRest(const TrainingConfig& config, const std::string& name,
                       const std::vector<Example>& examples);

}  // namespace deixis::gesture_recogniser
