#pragma once
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "services/pose_fitter/core/fitting/body_fitter.h"
#include "services/pose_fitter/core/fitting/pose_method.h"
#include "services/pose_fitter/core/limb_icp/limb_icp.h"

namespace deixis::pose_fitter {

/// How bodies are fitted.
enum class FitMethod {
  kArticulated,  ///< BodyFitter.
  kLimbIcp       ///< LimbIcp.
};

inline auto EnumNames(FitMethod) {
  return std::vector<std::pair<std::string, FitMethod>>{{"articulated", FitMethod::kArticulated},
                                                        {"limb_icp", FitMethod::kLimbIcp}};
}

/// A method, and the settings of each.
struct FitSettings {
  FitMethod method = FitMethod::kArticulated;
  BodyFitterConfig articulated;
  LimbIcpConfig limb_icp;
};

/// `model` must outlive it.
std::unique_ptr<PoseMethod> MakePoseMethod(const FitSettings& settings,
                                           const body_model::BodyModel& model);

}  // namespace deixis::pose_fitter
