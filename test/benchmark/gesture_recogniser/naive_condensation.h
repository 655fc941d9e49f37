#pragma once
#include <random>
#include <vector>

#include "services/gesture_recogniser/core/gesture_model.h"

namespace deixis::gesture_recogniser {

/// CONDENSATION as one writes it first: an array of structures in double precision, std::mt19937, a
/// binary search per selected sample, a density per comparison. The peer of the benchmark, without
/// context.
class NaiveCondensation {
 public:
  NaiveCondensation(const std::vector<GestureModel>& models, int samples);

  /// One image; speeds and turns newest first. Returns the end probability.
  double Step(const std::vector<double>& speeds, const std::vector<double>& turns, double step_s);

 private:
  struct Sample {
    int model = 0;
    double phase_s = 0.0;
    double amplitude = 1.0;
    double rate = 1.0;
    double weight = 1.0;
  };
  void Initialise(Sample& sample);
  void Select();
  void Predict(double step_s);
  double Density(const Sample& sample, const std::vector<double>& speeds,
                 const std::vector<double>& turns, double step_s) const;

  std::vector<GestureModel> models_;
  std::vector<Sample> samples_;
  std::mt19937 random_{1};
  std::normal_distribution<double> normal_{0.0, 0.15};
  std::uniform_real_distribution<double> uniform_{0.0, 1.0};
};

}  // namespace deixis::gesture_recogniser
