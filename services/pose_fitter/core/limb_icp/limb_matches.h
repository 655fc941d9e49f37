#pragma once
#include <vector>

#include "common/body_model/kinematics.h"
#include "services/pose_fitter/core/fitting/body_points.h"
#include "services/pose_fitter/core/limb_icp/rigid_motion.h"

namespace deixis::pose_fitter {

struct MatchSettings {
  double reach_m = 0.1;   ///< Points farther from all limbs do not count.
  double equal_m = 1e-3;  ///< Distances that differ by less are equal.
};

/// Which measured points belong to which limb of a body, and to which places of its surface: the
/// nearest limb's closest point. A point in equal distance to several limbs counts for each. Takes
/// its memory once per number of points.
class LimbMatches {
 public:
  explicit LimbMatches(const body_model::BodyModel& model);

  void Find(const BodyPoints& points, const body_model::Kinematics& kinematics,
            const MatchSettings& settings);

  /// From the limb's surface to its points, both in the limb's frame.
  const PairSums& pairs(int limb) const { return pairs_[static_cast<std::size_t>(limb)]; }
  /// Nearest limb of each point; -1 = none is within reach.
  const std::vector<int>& winners() const { return winners_; }

 private:
  /// A block of points as one limb sees it, in its frame.
  struct LimbBlock {
    float x_m[BodyPoints::kBlock], y_m[BodyPoints::kBlock], z_m[BodyPoints::kBlock];
    float distance_m[BodyPoints::kBlock];
    float normal_x[BodyPoints::kBlock], normal_y[BodyPoints::kBlock], normal_z[BodyPoints::kBlock];
  };
  struct Ball {
    Eigen::Vector3f centre_m = Eigen::Vector3f::Zero();  ///< In the camera's frame.
    float radius_m = 0.0F;
  };

  void Place(const body_model::Kinematics& kinematics);
  void Measure(const BodyPoints& points, const PointBlock& block,
               const body_model::Kinematics& kinematics, std::size_t limb);
  void Share(const PointBlock& block, const MatchSettings& settings);

  std::vector<Ball> balls_;  ///< Around each limb.
  std::vector<LimbBlock> seen_;
  std::vector<std::size_t> near_;  ///< Limbs that the block may belong to.
  std::vector<PairSums> pairs_;
  std::vector<int> winners_;
};

}  // namespace deixis::pose_fitter
