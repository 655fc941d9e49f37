#pragma once
#include <Eigen/Core>
#include <array>
#include <optional>
#include <string>

#include "common/body_model/body_model.h"

namespace deixis::pose_fitter {

/// Limbs that a body may hold in many ways: from shoulder to hand, or from hip to foot.
enum class Chain { kRightArm, kLeftArm, kRightLeg, kLeftLeg };

constexpr std::array<Chain, 4> kChains{Chain::kRightArm, Chain::kLeftArm, Chain::kRightLeg,
                                       Chain::kLeftLeg};

constexpr bool IsArm(Chain chain) { return chain == Chain::kRightArm || chain == Chain::kLeftArm; }
constexpr bool IsRight(Chain chain) {
  return chain == Chain::kRightArm || chain == Chain::kRightLeg;
}

/// The limbs of a chain in one model.
struct ChainLimbs {
  Chain chain = Chain::kRightArm;
  int trunk = 0;  ///< What it hangs on.
  int upper = -1, lower = -1;
  int end = -1;          ///< Hand or foot; -1 = the model has none.
  double upper_m = 0.0;  ///< Shoulder to elbow, hip to knee.
  double lower_m = 0.0;  ///< From there to the middle of the hand, or to the ankle.
};

/// Nothing when the model lacks its upper or lower limb.
std::optional<ChainLimbs> LimbsOf(const body_model::BodyModel& model, Chain chain);

}  // namespace deixis::pose_fitter
