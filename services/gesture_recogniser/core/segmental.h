#pragma once
#include <optional>
#include <vector>

#include "services/gesture_recogniser/core/destination.h"
#include "services/gesture_recogniser/core/hand_recogniser.h"
#include "services/gesture_recogniser/core/hold.h"
#include "services/gesture_recogniser/core/rest_place.h"
#include "services/gesture_recogniser/core/stroke.h"

namespace deixis::gesture_recogniser {

struct SegmentalConfig {
  double decide_probability = 0.8;  ///< Posterior at which an object is named.
  double no_stroke_log_odds = 3.0;  ///< Prior log-odds of no stroke having just ended.
  double ambiguous_after_s = 0.6;   ///< A hold of this length that is undecided is ambiguous.
  double ambiguous_share = 0.2;     ///< Share that the second object needs for that.
  double repeat_after_s = 0.8;      ///< Shortest time between two gestures of a hand.
  double repeat_distance_m = 0.12;  ///< The hand must leave the last hold this far ...
  double repeat_forget_s = 3.0;     ///< ... or stay away from it this long.
  double measured_share = 0.5;      ///< Share of the hold in which the hand must be measured.
  StrokeConfig stroke;
  HoldConfig hold;
  DestinationConfig destination;
  RestPlaceConfig rest_place;

  template <typename Visitor>
  void Visit(Visitor& v) {
    v("decide_probability", decide_probability);
    v("no_stroke_log_odds", no_stroke_log_odds);
    v("ambiguous_after_s", ambiguous_after_s);
    v("ambiguous_share", ambiguous_share);
    v("repeat_after_s", repeat_after_s);
    v("repeat_distance_m", repeat_distance_m);
    v("repeat_forget_s", repeat_forget_s);
    v("measured_share", measured_share);
    v("stroke", stroke);
    v("hold", hold);
    v("destination", destination);
    v("rest_place", rest_place);
  }
  void Validate() const;
};

/// A gesture as two segments, a stroke of the model's shape and a hold at an object. The posterior
/// over where the hand was meant to go is summed exactly over arrival time, duration and speed,
/// against free motion, resting, and strokes that end at the rest place, the face, or nowhere in
/// particular.
class Segmental final : public HandRecogniser {
 public:
  /// `models` needs exactly one model with a context; throws config::ConfigError otherwise.
  Segmental(const SegmentalConfig& config, const std::vector<GestureModel>& models, double step_s);

  const Assessment& Observe(const Motion& motion, const Surroundings& surroundings,
                            scene::Side side) override;

 private:
  /// Unnormalised log-posterior of everything the hand may be doing.
  struct Posterior {
    std::vector<double> target;
    double elsewhere = 0.0, rest = 0.0, face = 0.0;
    double total = 0.0;
    int best_hold = 0;  ///< Steps since the most probable arrival.
    double best_duration_s = 0.0;
  };
  struct Past {
    double age_s = 0.0;
    Eigen::Vector2d position_m = Eigen::Vector2d::Zero();
  };

  int ShortestHold(const Motion& motion) const;
  int LongestHold(const Motion& motion) const;
  void Infer(const Motion& motion, const Surroundings& surroundings, scene::Side side);
  void AddArrival(const Motion& motion, const Surroundings& surroundings, scene::Side side,
                  int steps_ago);
  void Add(const DestinationDensities& densities, double evidence);
  Arrival DescribeArrival(const Motion& motion, const HoldEvidence& hold, int steps_ago) const;
  void Describe(const Motion& motion, const Surroundings& surroundings);
  std::optional<Decision> Decide(const Motion& motion);
  std::optional<scene::GestureOutcome> Outcome() const;
  bool IsRepetition(const Motion& motion);
  bool IsMeasured(const Motion& motion) const;

  SegmentalConfig config_;
  GestureModel model_;
  std::string resting_model_;
  Stroke stroke_;
  Destinations destinations_;
  RestPlace rest_place_;
  Posterior posterior_;
  double best_log_odds_ = 0.0;
  std::optional<Past> last_;
  Assessment assessment_;
};

}  // namespace deixis::gesture_recogniser
