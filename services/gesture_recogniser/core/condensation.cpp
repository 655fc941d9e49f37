#include "services/gesture_recogniser/core/condensation.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "common/filtering/resampling.h"
#include "services/gesture_recogniser/core/decision.h"
#include "services/gesture_recogniser/core/index.h"

namespace deixis::gesture_recogniser {

using filtering::CounterRandom;

void CondensationConfig::Validate() const {
  config::Faults faults;
  faults.Require(samples >= 1 && samples <= 1000000, "samples", "must lie between 1 and 1000000");
  faults.Require(scale_min > 0.0, "scale_min", "must be positive");
  faults.Require(scale_max >= scale_min, "scale_max", "must not be below scale_min");
  faults.Require(scale_sigma >= 0.0, "scale_sigma", "must not be negative");
  faults.Require(phase_sigma_s >= 0.0, "phase_sigma_s", "must not be negative");
  faults.Require(window_s > 0.0 && window_s <= 10.0, "window_s", "must lie in (0, 10]");
  faults.Require(p_missing >= 0.0 && p_missing <= 1.0, "p_missing", "must lie in [0, 1]");
  faults.Require(end_phase > 0.0 && end_phase < 1.0, "end_phase", "must lie in (0, 1)");
  faults.Require(end_threshold > 0.0 && end_threshold < 1.0, "end_threshold", "must lie in (0, 1)");
  faults.Require(rearm_threshold >= 0.0 && rearm_threshold <= end_threshold, "rearm_threshold",
                 "must lie between 0 and end_threshold");
  faults.Require(object_share >= 0.0 && object_share < 1.0, "object_share", "must lie in [0, 1)");
  faults.ThrowIfAny();
}

Condensation::Condensation(const CondensationConfig& config,
                           const std::vector<GestureModel>& models, std::uint64_t stream)
    : config_(config),
      models_(models),
      table_(models),
      random_(config.seed, stream),
      ancestors_(Index(config.samples)),
      areas_(models.size()),
      model_weight_(models.size()),
      model_phase_(models.size()),
      end_weight_(models.size()) {
  for (const GestureModel& model : models_) {
    // A model without context is no gesture: it never ends.
    end_s_.push_back(model.context == ContextNeed::kNone
                         ? std::numeric_limits<float>::infinity()
                         : static_cast<float>(config.end_phase * model.duration_s));
  }
  samples_.Resize(Index(config.samples));
  selected_.Resize(Index(config.samples));
  Restart();
}

const Assessment& Condensation::Observe(const Motion& motion, const Surroundings& surroundings,
                                        scene::Side) {
  assessment_.decision.reset();
  step_s_ = motion.step_s;
  if (motion.elapsed_s <= 0.0) Restart();
  FollowTargets(surroundings.targets);
  Select();
  Predict(motion.elapsed_s, motion.step_s);
  Update(motion, surroundings.targets);
  Judge(motion);
  return assessment_;
}

void Condensation::Restart() {
  for (std::size_t n = 0; n < samples_.size(); ++n) {
    Initialise(n);
    samples_.phase_s[n] = CounterRandom::UniformFrom(Draw()) * table_.Duration(samples_.model[n]);
    samples_.weight[n] = 1.0F;
  }
  is_armed_ = true;
}

// Black and Jepson 1998: all models alike, phases near the beginning, scales uniform.
void Condensation::Initialise(std::size_t sample) {
  const auto models = static_cast<float>(table_.size());
  const int model =
      std::min(static_cast<int>(CounterRandom::UniformFrom(Draw()) * models), table_.size() - 1);
  const float root = std::sqrt(std::max(CounterRandom::UniformFrom(Draw()), 1e-4F));
  const float begin_s = (1.0F - root) / root * static_cast<float>(step_s_);
  const auto low = static_cast<float>(config_.scale_min);
  const auto range = static_cast<float>(config_.scale_max - config_.scale_min);
  samples_.model[sample] = model;
  samples_.phase_s[sample] = std::min(begin_s, table_.Duration(model));
  samples_.amplitude[sample] = low + range * CounterRandom::UniformFrom(Draw());
  samples_.rate[sample] = low + range * CounterRandom::UniformFrom(Draw());
  samples_.bound[sample] = -1;
}

/// Samples keep their object when the list of objects changes.
void Condensation::FollowTargets(const std::vector<Target>& targets) {
  const bool is_same =
      std::equal(targets.begin(), targets.end(), target_ids_.begin(), target_ids_.end(),
                 [](const Target& target, int id) { return target.id == id; });
  if (is_same) return;
  for (int& bound : samples_.bound) {
    if (bound < 0) continue;
    const int id = target_ids_[Index(bound)];
    const auto found = std::find_if(targets.begin(), targets.end(),
                                    [id](const Target& target) { return target.id == id; });
    bound = found == targets.end() ? -1 : static_cast<int>(found - targets.begin());
  }
  target_ids_.clear();
  for (const Target& target : targets) target_ids_.push_back(target.id);
}

void Condensation::Select() {
  if (!filtering::ResampleSystematically(samples_.weight, CounterRandom::UniformFrom(Draw()),
                                         ancestors_)) {
    Restart();
    return;
  }
  for (std::size_t n = 0; n < samples_.size(); ++n) {
    selected_.Copy(samples_, Index(ancestors_[n]), n);
  }
  std::swap(samples_, selected_);
}

void Condensation::Predict(double elapsed_s, double step_s) {
  const double steps = elapsed_s / step_s;
  const auto sigma = static_cast<float>(config_.scale_sigma * std::sqrt(steps));
  const auto phase_sigma = static_cast<float>(config_.phase_sigma_s * std::sqrt(steps));
  const auto low = static_cast<float>(config_.scale_min);
  const auto high = static_cast<float>(config_.scale_max);
  const auto elapsed = static_cast<float>(elapsed_s);
  for (std::size_t n = 0; n < samples_.size(); ++n) {
    float& amplitude = samples_.amplitude[n];
    float& rate = samples_.rate[n];
    amplitude = std::clamp(amplitude + sigma * CounterRandom::NormalFrom(Draw()), low, high);
    rate = std::clamp(rate + sigma * CounterRandom::NormalFrom(Draw()), low, high);
    samples_.phase_s[n] += rate * elapsed;
    if (phase_sigma > 0.0F) {
      samples_.phase_s[n] += phase_sigma * CounterRandom::NormalFrom(Draw());
      samples_.phase_s[n] = std::max(samples_.phase_s[n], 0.0F);
    }
    if (samples_.phase_s[n] > table_.Duration(samples_.model[n])) Initialise(n);
  }
}

void Condensation::Observe(const Motion& motion) {
  const std::size_t window =
      std::max<std::size_t>(1, Index(static_cast<int>(config_.window_s / motion.step_s + 0.5)));
  const std::size_t count = std::min(window, motion.size() > 1 ? motion.size() - 1 : 0);
  speeds_.clear();
  turns_.clear();
  for (std::size_t i = 0; i < count; ++i) {
    speeds_.push_back(static_cast<float>(motion.speed_m_per_s[i]));
    turns_.push_back(static_cast<float>(motion.turn_rad[i]));
  }
}

void Condensation::Update(const Motion& motion, const std::vector<Target>& targets) {
  Observe(motion);
  if (speeds_.empty()) {
    std::fill(samples_.weight.begin(), samples_.weight.end(), 1.0F);
  } else {
    WeighByMotion(table_,
                  {speeds_.data(), turns_.data(), static_cast<int>(speeds_.size()),
                   static_cast<float>(motion.step_s)},
                  samples_);
  }
  for (std::size_t m = 0; m < models_.size(); ++m) {
    areas_[m].Update(models_[m], config_.context, motion.position_m.front(), motion.direction,
                     targets);
  }
  if (config_.context != ContextUse::kNone) {
    for (std::size_t n = 0; n < samples_.size(); ++n) ApplyContext(n);
  }
  Normalise();
}

// Hofemann 2004, Eq. 5: binding, and the factor P_symp.
void Condensation::ApplyContext(std::size_t sample) {
  const int model = samples_.model[sample];
  const ContextAreas& areas = areas_[Index(model)];
  const int point = table_.PointAt(model, samples_.phase_s[sample]);
  if (!areas.HasArea(point)) return;
  const TargetSet inside = areas.Inside(point);
  int& bound = samples_.bound[sample];
  bool is_missing = false;
  if (bound >= 0) {
    is_missing = bound >= kMostTargets || (inside >> static_cast<unsigned>(bound) & 1U) == 0;
  } else if (inside != 0) {
    const int count = Count(inside);
    const auto rank =
        static_cast<int>(CounterRandom::UniformFrom(Draw()) * static_cast<float>(count));
    bound = Pick(inside, std::min(rank, count - 1));
  } else {
    is_missing = config_.unbound_is_missing;
  }
  if (is_missing && config_.context == ContextUse::kWeighted) {
    samples_.weight[sample] *= static_cast<float>(config_.p_missing);
  }
}

void Condensation::Normalise() {
  double sum = 0.0;
  for (const float weight : samples_.weight) sum += static_cast<double>(weight);
  if (!(sum > 0.0) || !std::isfinite(sum)) {
    Restart();
    sum = static_cast<double>(samples_.size());
  }
  const auto factor = static_cast<float>(1.0 / sum);
  for (float& weight : samples_.weight) weight *= factor;
}

void Condensation::SumWeights() {
  std::fill(model_weight_.begin(), model_weight_.end(), 0.0);
  std::fill(model_phase_.begin(), model_phase_.end(), 0.0);
  std::fill(end_weight_.begin(), end_weight_.end(), 0.0);
  for (std::size_t n = 0; n < samples_.size(); ++n) {
    const std::size_t model = Index(samples_.model[n]);
    const double weight = static_cast<double>(samples_.weight[n]);
    model_weight_[model] += weight;
    model_phase_[model] += weight * static_cast<double>(samples_.phase_s[n]);
    end_weight_[model] += samples_.phase_s[n] > end_s_[model] ? weight : 0.0;
  }
}

// Hofemann 2004, Eq. 6.
void Condensation::SumTargetWeights(int model) {
  end_target_weight_.assign(target_ids_.size(), 0.0);
  if (target_ids_.empty() || config_.context == ContextUse::kNone) return;
  const float end_s = end_s_[Index(model)];
  for (std::size_t n = 0; n < samples_.size(); ++n) {
    if (samples_.model[n] != model || samples_.bound[n] < 0) continue;
    if (samples_.phase_s[n] <= end_s) continue;
    end_target_weight_[Index(samples_.bound[n])] += static_cast<double>(samples_.weight[n]);
  }
}

void Condensation::Judge(const Motion& motion) {
  SumWeights();
  const int ending = std::max(0, Largest(end_weight_));
  SumTargetWeights(ending);
  Describe(motion, ending);
  if (assessment_.end_probability < config_.rearm_threshold) is_armed_ = true;
  if (!is_armed_ || assessment_.end_probability < config_.end_threshold) return;
  const ContextNeed need =
      config_.context == ContextUse::kNone ? ContextNeed::kNone : models_[Index(ending)].context;
  assessment_.decision =
      DecideByWeight(assessment_.end_probability, end_target_weight_, config_.object_share, need);
  if (!assessment_.decision) return;
  assessment_.decision->started_s = models_[Index(ending)].duration_s;
  is_armed_ = false;
}

void Condensation::Describe(const Motion& motion, int ending) {
  const std::size_t likeliest = Index(std::max(0, Largest(model_weight_)));
  assessment_.model = models_[likeliest].name;
  assessment_.phase = model_phase_[likeliest] / std::max(model_weight_[likeliest], 1e-12) /
                      models_[likeliest].duration_s;
  assessment_.end_probability = end_weight_[Index(ending)];
  assessment_.target_probability = end_target_weight_;
  double bound = 0.0;
  for (const double weight : end_target_weight_) bound += weight;
  assessment_.none_probability = std::clamp(1.0 - bound, 0.0, 1.0);
  assessment_.context.reset();
  const int point =
      table_.PointAt(static_cast<int>(likeliest), static_cast<float>(assessment_.phase) *
                                                      table_.Duration(static_cast<int>(likeliest)));
  const ModelPoint& here = models_[likeliest].points[Index(point)];
  if (here.context_radius_m > 0.0 && config_.context != ContextUse::kNone) {
    assessment_.context = AreaOf(here, motion.position_m.front(), motion.direction);
  }
}

}  // namespace deixis::gesture_recogniser
