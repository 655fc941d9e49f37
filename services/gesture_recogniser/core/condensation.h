#pragma once
#include <cstdint>
#include <vector>

#include "common/filtering/random.h"
#include "services/gesture_recogniser/core/context.h"
#include "services/gesture_recogniser/core/hand_recogniser.h"
#include "services/gesture_recogniser/core/sample_set.h"

namespace deixis::gesture_recogniser {

struct CondensationConfig {
  int samples = 1000;                          ///< N.
  double scale_min = 0.65;                     ///< Lower bound of alpha and rho.
  double scale_max = 1.35;                     ///< Upper bound of alpha and rho.
  double scale_sigma = 0.15;                   ///< Noise added to alpha and rho per step.
  double phase_sigma_s = 0.0;                  ///< Noise added to phi per step.
  double window_s = 0.25;                      ///< w: how much of the past is compared.
  ContextUse context = ContextUse::kWeighted;  ///< What of the context is used.
  double p_missing = 0.1;                      ///< P_missing: weight without the expected object.
  bool unbound_is_missing = false;             ///< P_missing also where nothing has been bound yet.
  double end_phase = 0.9;         ///< Share of the model past which it counts as ended.
  double end_threshold = 0.3;     ///< End probability at which a gesture is recognised.
  double rearm_threshold = 0.15;  ///< ... and below which the next one may be.
  double object_share = 0.3;      ///< T_O: share of the end probability that an object needs.
  std::uint64_t seed = 1;         ///< Of the random numbers.

  template <typename Visitor>
  void Visit(Visitor& v) {
    v("samples", samples);
    v("scale_min", scale_min);
    v("scale_max", scale_max);
    v("scale_sigma", scale_sigma);
    v("phase_sigma_s", phase_sigma_s);
    v("window_s", window_s);
    v("context", context);
    v("p_missing", p_missing);
    v("unbound_is_missing", unbound_is_missing);
    v("end_phase", end_phase);
    v("end_threshold", end_threshold);
    v("rearm_threshold", rearm_threshold);
    v("object_share", object_share);
    v("seed", seed);
  }
  void Validate() const;
};

/// The method as printed: Hofemann, Fritsch, Sagerer 2004, sections 4 and 5.
class Condensation final : public HandRecogniser {
 public:
  /// `stream` tells the random numbers of several hands apart.
  Condensation(const CondensationConfig& config, const std::vector<GestureModel>& models,
               std::uint64_t stream);

  const Assessment& Observe(const Motion& motion, const Surroundings& surroundings,
                            scene::Side side) override;

  const SampleSet& samples() const { return samples_; }

 private:
  void Restart();
  void FollowTargets(const std::vector<Target>& targets);
  void Select();
  void Predict(double elapsed_s, double step_s);
  void Update(const Motion& motion, const std::vector<Target>& targets);
  void Observe(const Motion& motion);
  void ApplyContext(std::size_t sample);
  void Normalise();
  void SumWeights();
  void SumTargetWeights(int model);
  void Judge(const Motion& motion);
  void Describe(const Motion& motion, int ending);
  void Initialise(std::size_t sample);
  std::uint64_t Draw() { return random_.Bits(draws_++); }

  CondensationConfig config_;
  std::vector<GestureModel> models_;
  ModelTable table_;
  filtering::CounterRandom random_;
  std::uint64_t draws_ = 0;
  SampleSet samples_;
  SampleSet selected_;
  std::vector<int> ancestors_;
  std::vector<int> target_ids_;
  std::vector<ContextAreas> areas_;
  std::vector<float> speeds_;
  std::vector<float> turns_;
  std::vector<double> model_weight_;
  std::vector<double> model_phase_;
  std::vector<float> end_s_;  // Phase past which a model counts as ended.
  std::vector<double> end_weight_;
  std::vector<double> end_target_weight_;  // Of the model that is judged.
  bool is_armed_ = true;
  double step_s_ = 0.0;
  Assessment assessment_;
};

}  // namespace deixis::gesture_recogniser
