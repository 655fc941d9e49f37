#pragma once
#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "services/gesture_recogniser/core/gesture_model.h"
#include "services/gesture_recogniser/core/hand_recogniser.h"

namespace deixis::gesture_recogniser {

/// What of the symbolic context is used: the columns of the paper's Table 1.
enum class ContextUse {
  kNone,      ///< Trajectory alone; no object is named.
  kDistance,  ///< Objects within the search radius, in whatever direction.
  kDirected,  ///< Objects within the context area.
  kWeighted   ///< The same, and samples whose object is missing weigh P_missing.
};
inline auto EnumNames(ContextUse) {
  return std::vector<std::pair<std::string, ContextUse>>{{"none", ContextUse::kNone},
                                                         {"distance", ContextUse::kDistance},
                                                         {"directed", ContextUse::kDirected},
                                                         {"weighted", ContextUse::kWeighted}};
}

/// One bit per target.
using TargetSet = std::uint64_t;
constexpr int kMostTargets = 64;

/// Which targets lie in the context area of each phase of a model, for the hand as it is now.
class ContextAreas {
 public:
  /// Fills the set of every point of `model`. Allocates only when the model has more points than
  /// any before.
  void Update(const GestureModel& model, ContextUse use, const Eigen::Vector2d& hand_m,
              const Eigen::Vector2d& direction, const std::vector<Target>& targets);

  bool HasArea(int point) const { return has_area_[static_cast<std::size_t>(point)]; }
  TargetSet Inside(int point) const { return inside_[static_cast<std::size_t>(point)]; }

 private:
  std::vector<TargetSet> inside_;
  std::vector<bool> has_area_;
};

/// The area of a model's point around the hand; angles follow the hand's direction.
Area AreaOf(const ModelPoint& point, const Eigen::Vector2d& hand_m,
            const Eigen::Vector2d& direction);

/// How many targets the set holds.
int Count(TargetSet set);
/// Index of the `rank`-th target of a set that holds more than `rank`.
int Pick(TargetSet set, int rank);

}  // namespace deixis::gesture_recogniser
