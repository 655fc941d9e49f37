#pragma once
#include <Eigen/Core>
#include <vector>

#include "common/body_model/body_model.h"
#include "common/motion/skeleton.h"
#include "common/retargeting/skeleton_map.h"

namespace deixis::retargeting {

/// How a file's zero pose stands in the axes of the human model: x forward, y left, z up.
struct ZeroStance {
  Eigen::Matrix3d body_from_file;       ///< A rotation.
  std::vector<Eigen::Matrix3d> frames;  ///< Of each driven limb, in the body's axes.
};

/// Front, left and up follow from hips or shoulders, neck and head; they are the file's own axes
/// where those are near. Throws ConfigError when left and up cannot be told.
ZeroStance FindZeroStance(const motion::Skeleton& skeleton, const std::vector<DrivenLimb>& limbs,
                          const body_model::BodyModel& model);

}  // namespace deixis::retargeting
