#include "services/pose_fitter/core/fitting/fit_result.h"

#include <algorithm>

namespace deixis::pose_fitter {

std::string WithoutSide(const std::string& limb) {
  for (const std::string side : {"right_", "left_"}) {
    if (limb.rfind(side, 0) == 0) return limb.substr(side.size());
  }
  return limb;
}

std::vector<int> TrunkOf(const body_model::BodyModel& model) {
  std::vector<int> trunk;
  for (int i = 0; i < model.limb_count(); ++i) {
    const auto& name = model.limbs()[static_cast<std::size_t>(i)].name;
    if (WithoutSide(name) == name) trunk.push_back(i);
  }
  return trunk;
}

void Score(const std::vector<int>& trunk, int points, int explained, double cost,
           FitResult& result) {
  double trunk_samples = 0.0, trunk_seen = 0.0;
  for (const int limb : trunk) {
    const LimbView& view = result.limbs[static_cast<std::size_t>(limb)].view;
    trunk_samples += view.samples - view.outside;
    trunk_seen += view.seen;
  }
  result.trunk_seen = trunk_samples > 0.0 ? trunk_seen / trunk_samples : 0.0;
  result.explained = points > 0 ? static_cast<double>(explained) / points : 0.0;
  double free = 0.0, hidden = 0.0, samples = 0.0;
  for (const LimbEvidence& limb : result.limbs) {
    free += limb.view.free;
    hidden += limb.view.hidden;
    samples += limb.view.samples;
  }
  result.score = (cost + points - explained) / std::max(1, points) +
                 (samples > 0.0 ? (2.0 * free + 0.3 * hidden) / samples : 2.0);
}

}  // namespace deixis::pose_fitter
