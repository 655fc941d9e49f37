#include "services/pose_fitter/core/bodies/limb_chain.h"

#include <algorithm>

#include "services/pose_fitter/core/cues/part_cue.h"

namespace deixis::pose_fitter {
std::optional<ChainLimbs> LimbsOf(const body_model::BodyModel& model, Chain chain) {
  const std::string side = IsRight(chain) ? "right_" : "left_";
  const auto upper = model.Find(side + (IsArm(chain) ? "upper_arm" : "thigh"));
  const auto lower = model.Find(side + (IsArm(chain) ? "lower_arm" : "shank"));
  const auto end = model.Find(side + (IsArm(chain) ? "hand" : "foot"));
  if (!upper || !lower) return std::nullopt;
  const auto& limbs = model.limbs();
  const auto length_m = [&limbs](int limb) {
    return limbs[static_cast<std::size_t>(limb)].shape.length_m;
  };
  ChainLimbs found{chain,
                   limbs[static_cast<std::size_t>(*upper)].parent,
                   *upper,
                   *lower,
                   end.value_or(-1),
                   length_m(*upper),
                   length_m(*lower)};
  // A shoulder blade moves with its arm.
  if (IsArm(chain) && found.trunk > 0) {
    found.trunk = limbs[static_cast<std::size_t>(found.trunk)].parent;
  }
  found.trunk = std::max(0, found.trunk);
  if (IsArm(chain) && end) found.lower_m += kHandShare * length_m(*end);
  return found;
}

}  // namespace deixis::pose_fitter
