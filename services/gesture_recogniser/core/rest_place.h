#pragma once
#include <Eigen/Core>
#include <optional>

#include "common/config/config.h"
#include "common/scene/box.h"
#include "services/gesture_recogniser/core/motion_features.h"

namespace deixis::gesture_recogniser {

struct RestPlaceConfig {
  double still_s = 1.0;      ///< Still for so long: the hand rests there.
  double scatter_m = 0.012;  ///< Scatter of a still hand beyond the noise of its track.
  double below_face_m =
      0.33;  ///< Hands rest at least this far below the chin, where a face is seen.
  double gesture_radius_m = 0.08;  ///< So near to the last gesture's hold it is no rest place.

  template <typename Visitor>
  void Visit(Visitor& v) {
    v("still_s", still_s);
    v("scatter_m", scatter_m);
    v("below_face_m", below_face_m);
    v("gesture_radius_m", gesture_radius_m);
  }
  void Validate() const;
};

/// Where a hand returns to between its gestures: learned from where it stays.
class RestPlace {
 public:
  explicit RestPlace(const RestPlaceConfig& config) : config_(config) {}

  /// The hand is seen for the first time (again): it is taken to come from rest.
  void Begin(const Eigen::Vector2d& position_m) { position_m_ = position_m; }
  void Observe(const Motion& motion, const std::optional<scene::Box>& face_m);
  /// A gesture's hold is no rest, however long it lasts.
  void NoteGesture(const Eigen::Vector2d& position_m) { gesture_m_ = position_m; }

  const std::optional<Eigen::Vector2d>& position_m() const { return position_m_; }

 private:
  bool IsPlausible(const Eigen::Vector2d& place_m, const std::optional<scene::Box>& face_m) const;

  RestPlaceConfig config_;
  std::optional<Eigen::Vector2d> position_m_;
  std::optional<Eigen::Vector2d> gesture_m_;
};

}  // namespace deixis::gesture_recogniser
