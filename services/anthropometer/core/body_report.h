#pragma once
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "common/anatomy/joint_limits.h"
#include "common/anthropometry/body_measures.h"
#include "common/body_model/body_model.h"
#include "common/range_of_motion/range_of_motion.h"
#include "common/range_of_motion/speed_limits.h"

namespace deixis::anthropometer {

using Json = nlohmann::ordered_json;

/// What is told of a body.
struct ReportRequest {
  anatomy::Language language = anatomy::Language::kEnglish;
  std::string joint;    ///< Only this one's limits; empty = those of all.
  std::string measure;  ///< Only this one; empty = all.
};

/// A person as the tables have him or her.
struct Person {
  anthropometry::Sex sex = anthropometry::Sex::kFemale;
  double stature_m = 0.0;
  std::map<std::string, double> sizes_m;  ///< By measure.
};

/// Millimetres of each measure that is known, those that are sums of others too, as JSON.
/// Throws ConfigError, with all names, for a `request.measure` that is none.
Json MeasuresJson(const anthropometry::BodyMeasures& measures, const Person& person,
                  const ReportRequest& request);

/// The rows of joint limits, as JSON, with what the default limits of `plan` make of them. Throws
/// ConfigError, with all names, for a `request.joint` that is none.
Json JointLimitsJson(const anatomy::JointLimits& limits, const range_of_motion::RangePlan& plan,
                     const ReportRequest& request);

/// The limits of speed and acceleration of the same joints, as JSON, with their certainty.
Json SpeedLimitsJson(const range_of_motion::SpeedLimits& speeds, const anatomy::JointLimits& limits,
                     const ReportRequest& request);

/// The limbs with their sizes, where they lie in a pose (frame of the base limb's joint) and their
/// angles, as JSON.
Json LimbsJson(const body_model::BodyModel& model, const body_model::BodyPose& pose);

/// How many degrees each joint has left in a pose before it meets its limits, posture and other
/// joints counted, as JSON: negative beyond. The nearest limit per angle; of shoulder and hip one
/// for where the limb points at. Only those of `request.joint`, if it is one.
Json PostureJson(const body_model::BodyModel& model, const range_of_motion::RangeOfMotion& range,
                 const body_model::BodyPose& pose, const anatomy::JointLimits& limits,
                 const ReportRequest& request);

/// What the joints of the model's URDF stand at in a pose, radians, as JSON.
Json JointValuesJson(const body_model::BodyModel& model, const body_model::BodyPose& pose,
                     const std::string& body_id);

}  // namespace deixis::anthropometer
