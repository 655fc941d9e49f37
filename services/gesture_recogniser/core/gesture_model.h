#pragma once
#include <string>
#include <utility>
#include <vector>

#include "common/config/config.h"

namespace deixis::gesture_recogniser {

/// Whether a gesture needs an object (Hofemann 2004, section 5).
enum class ContextNeed { kNone, kOptional, kRequired };
inline auto EnumNames(ContextNeed) {
  return std::vector<std::pair<std::string, ContextNeed>>{{"none", ContextNeed::kNone},
                                                          {"optional", ContextNeed::kOptional},
                                                          {"required", ContextNeed::kRequired}};
}

/// The model at one phase: what the hand does there and where its object is looked for. Lengths are
/// metres in the image plane at the person's distance.
struct ModelPoint {
  double speed_m_per_s = 0.0;         ///< Mean speed of the examples.
  double speed_spread_m_per_s = 0.1;  ///< Its standard deviation.
  double turn_rad = 0.0;              ///< Mean change of direction from step to step.
  double turn_spread_rad = 1.0;       ///< Its standard deviation.
  double shape = 0.0;                 ///< Mean of speed over peak speed.
  double shape_spread = 0.1;          ///< Its standard deviation.
  double context_radius_m = 0.0;      ///< Search radius c_r; 0 = no context area here.
  double context_start_rad = 0.0;     ///< Start angle c_alpha relative to the hand's direction.
  double context_end_rad = 0.0;       ///< End angle c_beta.

  template <typename Visitor>
  void Visit(Visitor& v) {
    v("speed_m_per_s", speed_m_per_s);
    v("speed_spread_m_per_s", speed_spread_m_per_s);
    v("turn_rad", turn_rad);
    v("turn_spread_rad", turn_spread_rad);
    v("shape", shape);
    v("shape_spread", shape_spread);
    v("context_radius_m", context_radius_m);
    v("context_start_rad", context_start_rad);
    v("context_end_rad", context_end_rad);
  }
};

/// How the motion as a whole varies between examples.
struct StrokeStatistics {
  double duration_spread_s = 0.1;      ///< Standard deviation of the duration.
  double peak_speed_m_per_s = 2.0;     ///< Geometric mean of the peak speed.
  double peak_speed_log_spread = 0.3;  ///< Standard deviation of its logarithm.

  template <typename Visitor>
  void Visit(Visitor& v) {
    v("duration_spread_s", duration_spread_s);
    v("peak_speed_m_per_s", peak_speed_m_per_s);
    v("peak_speed_log_spread", peak_speed_log_spread);
  }
};

/// Where the object is when the hand has arrived.
struct TargetStatistics {
  double gap_m = 0.2;          ///< From the hand's centre to the object's box.
  double gap_spread_m = 0.05;  ///< Its standard deviation.
  /// Between the last part of the way and the object's direction.
  double direction_spread_rad = 0.4;
  /// Between the forearm's direction, guessed from face and hand, and the object's.
  double posture_spread_rad = 0.4;

  template <typename Visitor>
  void Visit(Visitor& v) {
    v("gap_m", gap_m);
    v("gap_spread_m", gap_spread_m);
    v("direction_spread_rad", direction_spread_rad);
    v("posture_spread_rad", posture_spread_rad);
  }
};

/// One motion model mu: points at equal steps of phase from beginning to end, in seconds, so that
/// it holds for any frame rate.
struct GestureModel {
  std::string name;
  ContextNeed context = ContextNeed::kNone;
  double duration_s = 0.5;  ///< At rate 1.
  int examples = 0;         ///< How many examples it was averaged from.
  StrokeStatistics stroke;
  TargetStatistics target;
  std::vector<ModelPoint> points;

  template <typename Visitor>
  void Visit(Visitor& v) {
    v("name", name);
    v("context", context);
    v("duration_s", duration_s);
    v("examples", examples);
    v("stroke", stroke);
    v("target", target);
    v("points", points);
  }
  void Validate() const;  ///< Throws ConfigError.
};

/// Reads `gestures/<name>.yaml` for every name, searched as all configuration. Throws ConfigError,
/// also when the name in a file is not the file's.
std::vector<GestureModel> LoadModels(const std::vector<std::string>& names);

/// The model as its YAML file.
std::string ToYaml(const GestureModel& model);

}  // namespace deixis::gesture_recogniser
