#pragma once
#include <Eigen/Core>
#include <string>

#include "common/anatomy/joint_limits.h"
#include "common/anthropometry/person_estimate.h"
#include "common/body_model/body_plan.h"
#include "common/range_of_motion/range_plan.h"

namespace deixis::range_of_motion {

inline constexpr double kDegree = M_PI / 180.0;

inline const anatomy::JointLimits& ShippedRows() {
  static const auto rows =
      anatomy::JointLimits::Load(DEIXIS_SOURCE_DIR "/config/kinematics/joint_limits.yaml");
  return rows;
}

inline const RangePlan& ShippedRanges() {
  static const auto plan =
      LoadRangePlan(DEIXIS_SOURCE_DIR "/config/kinematics/range_of_motion.yaml");
  return plan;
}

/// A woman of 1.65 m.
inline body_model::BodyModel ShippedBody(const std::string& name) {
  static const auto populations =
      anthropometry::Populations::Load(DEIXIS_SOURCE_DIR "/config/kinematics/population.yaml");
  return Build(body_model::LoadBodyPlan(DEIXIS_SOURCE_DIR "/config/body_models/" + name + ".yaml"),
               SizesOf(populations, anthropometry::Sex::kFemale, 1.65));
}

}  // namespace deixis::range_of_motion
