#pragma once
#include <vector>

#include "services/gesture_recogniser/core/gesture_model.h"
#include "services/gesture_recogniser/core/index.h"

namespace deixis::gesture_recogniser {

/// Samples s = (mu, phi, alpha, rho, ID) with their weights pi (Hofemann 2004, Eq. 4), as a
/// structure of arrays.
struct SampleSet {
  std::vector<int> model;        ///< mu: index of the motion model.
  std::vector<float> phase_s;    ///< phi: time within the model.
  std::vector<float> amplitude;  ///< alpha: scale of the speed.
  std::vector<float> rate;       ///< rho: scale of time.
  std::vector<int> bound;        ///< ID: index of the target; -1 = none yet.
  std::vector<float> weight;     ///< pi: sums to 1 after an update.

  void Resize(std::size_t count);
  std::size_t size() const { return model.size(); }
  void Copy(const SampleSet& from, std::size_t source, std::size_t destination);
};

/// The points of all models as the likelihood needs them: products with the inverse spreads, laid
/// out in one block.
class ModelTable {
 public:
  struct Point {
    float inverse_speed_spread, scaled_speed, inverse_turn_spread, scaled_turn, log_norm;
    float padding[3];
  };

  explicit ModelTable(const std::vector<GestureModel>& models);

  const Point* Points(int model) const { return points_.data() + first_[Index(model)]; }
  float PointsPerSecond(int model) const { return points_per_s_[Index(model)]; }
  float Duration(int model) const { return duration_s_[Index(model)]; }
  int PointAt(int model, float phase_s) const;
  int size() const { return static_cast<int>(first_.size()); }

 private:
  std::vector<Point> points_;
  std::vector<std::size_t> first_;
  std::vector<int> last_;
  std::vector<float> points_per_s_;
  std::vector<float> duration_s_;
};

/// What the hand did in the last `count` steps, newest first.
struct Observations {
  const float* speed_m_per_s = nullptr;
  const float* turn_rad = nullptr;
  int count = 0;
  float step_s = 0.0F;
};

/// Writes into `weight` p(z | s) of every sample: a Gaussian per model point, its exponent averaged
/// over the window as in Black and Jepson 1998, which the paper builds on.
void WeighByMotion(const ModelTable& table, const Observations& observed, SampleSet& samples);

}  // namespace deixis::gesture_recogniser
