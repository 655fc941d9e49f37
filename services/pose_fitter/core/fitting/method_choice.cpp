#include "services/pose_fitter/core/fitting/method_choice.h"

namespace deixis::pose_fitter {

std::unique_ptr<PoseMethod> MakePoseMethod(const FitSettings& settings,
                                           const body_model::BodyModel& model) {
  if (settings.method == FitMethod::kLimbIcp) {
    return std::make_unique<LimbIcp>(settings.limb_icp, model);
  }
  return std::make_unique<BodyFitter>(settings.articulated, model);
}

}  // namespace deixis::pose_fitter
