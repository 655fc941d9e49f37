#include "services/gesture_recogniser/core/segmental.h"

#include <algorithm>
#include <cmath>

#include "common/filtering/log_probability.h"
#include "services/gesture_recogniser/core/context.h"
#include "services/gesture_recogniser/core/decision.h"
#include "services/gesture_recogniser/core/index.h"

namespace deixis::gesture_recogniser {

using filtering::kImpossible;
using filtering::kTwoPi;
using filtering::LogAdd;

namespace {

const GestureModel& StrokeModel(const std::vector<GestureModel>& models) {
  const GestureModel* stroke = nullptr;
  for (const GestureModel& model : models) {
    if (model.context == ContextNeed::kNone) continue;
    if (stroke != nullptr) {
      throw config::ConfigError("'models' names two gestures, '" + stroke->name + "' and '" +
                                model.name +
                                "': method segmental knows one; leave one out, or set method to "
                                "as_printed");
    }
    stroke = &model;
  }
  if (stroke != nullptr) return *stroke;
  throw config::ConfigError("'models' must name one whose context is optional or required");
}

std::string RestingModel(const std::vector<GestureModel>& models) {
  for (const GestureModel& model : models) {
    if (model.context == ContextNeed::kNone) return model.name;
  }
  return "rest";
}

}  // namespace

void SegmentalConfig::Validate() const {
  config::Faults faults;
  faults.Require(decide_probability > 0.5 && decide_probability < 1.0, "decide_probability",
                 "must lie in (0.5, 1)");
  faults.Require(ambiguous_after_s >= 0.0, "ambiguous_after_s", "must not be negative");
  faults.Require(ambiguous_share > 0.0 && ambiguous_share <= 0.5, "ambiguous_share",
                 "must lie in (0, 0.5]");
  faults.Require(repeat_after_s >= 0.0, "repeat_after_s", "must not be negative");
  faults.Require(repeat_distance_m >= 0.0, "repeat_distance_m", "must not be negative");
  faults.Require(repeat_forget_s >= repeat_after_s, "repeat_forget_s",
                 "must not be below repeat_after_s");
  faults.Require(measured_share >= 0.0 && measured_share <= 1.0, "measured_share",
                 "must lie in [0, 1]");
  faults.ThrowIfAny();
}

Segmental::Segmental(const SegmentalConfig& config, const std::vector<GestureModel>& models,
                     double step_s)
    : config_(config),
      model_(StrokeModel(models)),
      resting_model_(RestingModel(models)),
      stroke_(config.stroke, model_, step_s),
      destinations_(config.destination, model_.target),
      rest_place_(config.rest_place) {}

const Assessment& Segmental::Observe(const Motion& motion, const Surroundings& surroundings,
                                     scene::Side side) {
  if (motion.elapsed_s <= 0.0) {
    last_.reset();
    rest_place_.Begin(motion.position_m.front());
  }
  if (last_) last_->age_s += motion.elapsed_s;
  rest_place_.Observe(motion, surroundings.face_m);
  Infer(motion, surroundings, side);
  Describe(motion, surroundings);
  assessment_.decision = Decide(motion);
  return assessment_;
}

int Segmental::ShortestHold(const Motion& motion) const {
  return std::max(2, static_cast<int>(std::lround(config_.hold.shortest_s / motion.step_s)));
}

int Segmental::LongestHold(const Motion& motion) const {
  return std::max(ShortestHold(motion),
                  static_cast<int>(std::lround(config_.hold.longest_s / motion.step_s)));
}

void Segmental::Infer(const Motion& motion, const Surroundings& surroundings, scene::Side side) {
  posterior_.target.assign(surroundings.targets.size(), kImpossible);
  posterior_.elsewhere = posterior_.rest = posterior_.face = kImpossible;
  posterior_.best_hold = 0;
  best_log_odds_ = kImpossible;
  const int longest = LongestHold(motion);
  stroke_.Observe(motion, longest);
  for (int steps_ago = ShortestHold(motion); steps_ago <= longest; ++steps_ago) {
    if (stroke_.At(steps_ago).log_odds == kImpossible) break;
    AddArrival(motion, surroundings, side, steps_ago);
  }
  posterior_.total = LogAdd(LogAdd(posterior_.rest, posterior_.face),
                            LogAdd(posterior_.elsewhere, config_.no_stroke_log_odds));
  for (const double target : posterior_.target) {
    posterior_.total = LogAdd(posterior_.total, target);
  }
}

void Segmental::AddArrival(const Motion& motion, const Surroundings& surroundings, scene::Side side,
                           int steps_ago) {
  const HoldEvidence hold = JudgeHold(config_.hold, motion, steps_ago);
  const StrokeEvidence& stroke = stroke_.At(steps_ago);
  const double log_odds = hold.log_odds + stroke.log_odds;
  // Every arrival time is as likely as any other; densities are relative to a hand that is just
  // anywhere and comes from anywhere.
  const double arrivals = LongestHold(motion) - ShortestHold(motion) + 1;
  const double anywhere = -std::log(config_.destination.reach_m2 * kTwoPi);
  Add(destinations_.Judge(DescribeArrival(motion, hold, steps_ago), surroundings,
                          rest_place_.position_m(), side),
      log_odds - anywhere - std::log(arrivals));
  if (log_odds > best_log_odds_) {
    best_log_odds_ = log_odds;
    posterior_.best_hold = steps_ago;
    posterior_.best_duration_s = stroke.duration_s;
  }
}

void Segmental::Add(const DestinationDensities& densities, double evidence) {
  const auto add = [evidence](double& sum, double density) {
    sum = LogAdd(sum, density + evidence);
  };
  for (std::size_t i = 0; i < densities.target.size(); ++i) {
    add(posterior_.target[i], densities.target[i]);
  }
  add(posterior_.elsewhere, densities.elsewhere);
  add(posterior_.rest, densities.rest);
  add(posterior_.face, densities.face);
}

Arrival Segmental::DescribeArrival(const Motion& motion, const HoldEvidence& hold,
                                   int steps_ago) const {
  const auto at = [&motion](int steps) -> const Eigen::Vector2d& {
    return motion.position_m[std::min(Index(steps), motion.size() - 1)];
  };
  const int way = static_cast<int>(std::lround(config_.destination.arrival_s / motion.step_s));
  const int duration =
      static_cast<int>(std::lround(stroke_.At(steps_ago).duration_s / motion.step_s));
  Arrival arrival;
  arrival.position_m = hold.position_m;
  arrival.sigma_m = hold.sigma_m;
  arrival.way_m = hold.position_m - at(steps_ago + way);
  arrival.way_sigma_m = std::hypot(motion.sigma_m, hold.sigma_m);
  if (rest_place_.position_m()) {
    const Eigen::Vector2d& rest = *rest_place_.position_m();
    arrival.nearest_rest_m = std::min({(at(steps_ago + duration - 2) - rest).norm(),
                                       (at(steps_ago + duration) - rest).norm(),
                                       (at(steps_ago + duration + 2) - rest).norm()});
  }
  return arrival;
}

void Segmental::Describe(const Motion& motion, const Surroundings& surroundings) {
  assessment_.target_probability.assign(surroundings.targets.size(), 0.0);
  double named = 0.0;
  for (std::size_t i = 0; i < posterior_.target.size(); ++i) {
    assessment_.target_probability[i] = std::exp(posterior_.target[i] - posterior_.total);
    named += assessment_.target_probability[i];
  }
  assessment_.none_probability = std::clamp(1.0 - named, 0.0, 1.0);
  const double no_stroke = std::exp(config_.no_stroke_log_odds - posterior_.total);
  assessment_.end_probability = std::clamp(1.0 - no_stroke, 0.0, 1.0);
  const bool is_stroke = assessment_.end_probability > 0.5;
  assessment_.model = is_stroke ? model_.name : resting_model_;
  assessment_.phase = is_stroke ? 1.0 : 0.0;
  assessment_.context.reset();
  if (is_stroke) {
    const std::size_t way = std::min(Index(posterior_.best_hold + 3), motion.size() - 1);
    assessment_.context =
        AreaOf(model_.points.back(), motion.position_m.front(),
               (motion.position_m.front() - motion.position_m[way]).stableNormalized());
  }
}

std::optional<Decision> Segmental::Decide(const Motion& motion) {
  const std::optional<scene::GestureOutcome> outcome = Outcome();
  const bool is_held = posterior_.best_hold * motion.step_s >= config_.ambiguous_after_s;
  if (!outcome || (*outcome != scene::GestureOutcome::kObject && !is_held)) return std::nullopt;
  if (!IsMeasured(motion) || IsRepetition(motion)) return std::nullopt;
  last_ = Past{0.0, motion.position_m.front()};
  rest_place_.NoteGesture(motion.position_m.front());
  Decision decision;
  decision.outcome = *outcome;
  decision.started_s = posterior_.best_hold * motion.step_s + posterior_.best_duration_s;
  if (*outcome == scene::GestureOutcome::kObject) {
    decision.target = Largest(assessment_.target_probability);
  }
  return decision;
}

std::optional<scene::GestureOutcome> Segmental::Outcome() const {
  const auto& probability = assessment_.target_probability;
  const int best = Largest(probability);
  if (best >= 0 && probability[Index(best)] > config_.decide_probability) {
    return scene::GestureOutcome::kObject;
  }
  if (1.0 - assessment_.none_probability > config_.decide_probability) {
    double second = 0.0;
    for (std::size_t i = 0; i < probability.size(); ++i) {
      if (i != Index(best)) second = std::max(second, probability[i]);
    }
    if (second > config_.ambiguous_share) return scene::GestureOutcome::kAmbiguous;
  }
  const double elsewhere = std::exp(posterior_.elsewhere - posterior_.total);
  if (model_.context == ContextNeed::kOptional && elsewhere > config_.decide_probability) {
    return scene::GestureOutcome::kNoObject;
  }
  return std::nullopt;
}

/// One event per gesture: a hand that stays at its last hold goes on with the same gesture.
bool Segmental::IsRepetition(const Motion& motion) {
  if (!last_) return false;
  const bool is_same_place =
      (motion.position_m.front() - last_->position_m).norm() < config_.repeat_distance_m;
  if (is_same_place && last_->age_s < config_.repeat_forget_s) {
    last_->age_s = 0.0;
    return true;
  }
  return last_->age_s < config_.repeat_after_s;
}

bool Segmental::IsMeasured(const Motion& motion) const {
  const std::size_t count = std::min(Index(std::max(posterior_.best_hold, 1)), motion.size());
  const auto measured =
      std::count(motion.is_measured.begin(),
                 motion.is_measured.begin() + static_cast<std::ptrdiff_t>(count), true);
  return static_cast<double>(measured) >= config_.measured_share * static_cast<double>(count);
}

}  // namespace deixis::gesture_recogniser
