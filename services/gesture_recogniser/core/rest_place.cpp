#include "services/gesture_recogniser/core/rest_place.h"

#include <algorithm>
#include <cmath>

namespace deixis::gesture_recogniser {

void RestPlaceConfig::Validate() const {
  config::Faults faults;
  faults.Require(still_s > 0.0 && still_s <= 10.0, "still_s", "must lie in (0, 10]");
  faults.Require(scatter_m > 0.0, "scatter_m", "must be positive");
  faults.Require(gesture_radius_m >= 0.0, "gesture_radius_m", "must not be negative");
  faults.ThrowIfAny();
}

void RestPlace::Observe(const Motion& motion, const std::optional<scene::Box>& face_m) {
  const auto samples = static_cast<std::size_t>(config_.still_s / motion.step_s);
  if (samples < 2 || motion.size() < samples) return;
  Eigen::Vector2d mean = Eigen::Vector2d::Zero();
  for (std::size_t i = 0; i < samples; ++i) mean += motion.position_m[i];
  mean /= static_cast<double>(samples);
  double square = 0.0;
  for (std::size_t i = 0; i < samples; ++i) square += (motion.position_m[i] - mean).squaredNorm();
  const double scatter = std::sqrt(square / static_cast<double>(samples));
  if (scatter > std::max(1.8 * motion.sigma_m, config_.scatter_m)) return;
  if (IsPlausible(mean, face_m)) position_m_ = mean;
}

bool RestPlace::IsPlausible(const Eigen::Vector2d& place_m,
                            const std::optional<scene::Box>& face_m) const {
  if (face_m && place_m.y() < face_m->y_px + face_m->height_px + config_.below_face_m) return false;
  return !gesture_m_ || (place_m - *gesture_m_).norm() > config_.gesture_radius_m;
}

}  // namespace deixis::gesture_recogniser
