#include "services/anthropometer/core/body_report.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "common/body_model/body_plan.h"
#include "common/body_model/kinematics.h"
#include "common/config/config.h"
#include "services/anthropometer/core/solid.h"
#include "services/anthropometer/core/urdf.h"

namespace deixis::anthropometer {
namespace {

using anatomy::JointLimit;
using anthropometry::BodyMeasure;
using body_model::Limb;
using Eigen::Vector3d;

constexpr double kDegrees = 180.0 / M_PI;

template <typename Enum>
std::string NameOf(Enum value) {
  for (const auto& [name, each] : EnumNames(value)) {
    if (each == value) return name;
  }
  return {};
}

Json VectorJson(const Vector3d& v) { return Json::array({v.x(), v.y(), v.z()}); }

/// Millimetres; nothing for what is neither estimated nor a sum of what is.
std::optional<double> Millimetres(const BodyMeasure& measure, const Person& person) {
  const auto found = person.sizes_m.find(measure.name);
  if (found != person.sizes_m.end()) return 1000.0 * found->second;
  if (measure.derived.empty()) return std::nullopt;
  double sum_mm = 0.0;
  for (const auto& part : measure.derived) {
    const auto size = person.sizes_m.find(part.of);
    if (size == person.sizes_m.end()) return std::nullopt;
    sum_mm += part.sign * 1000.0 * size->second;
  }
  return sum_mm;
}

Json MeasureJson(const BodyMeasure& measure, double mm, anatomy::Language language) {
  return Json({{"measure", measure.name},
               {"name", measure.names.In(language)},
               {"mm", std::round(10.0 * mm) / 10.0}});
}

[[noreturn]] void RefuseName(const std::string& option, const std::string& name,
                             const std::string& there_are) {
  throw config::ConfigError("--" + option + " " + name + " is none: there are " + there_are);
}

std::string Listed(const std::string& list, const std::string& item) {
  return list.empty() ? item : list + ", " + item;
}

const anatomy::NamedTerm& Named(const std::vector<anatomy::NamedTerm>& terms,
                                const std::string& name) {
  return *std::find_if(terms.begin(), terms.end(),
                       [&](const anatomy::NamedTerm& term) { return term.name == name; });
}

/// What the default limits add to a row; nullptr = nothing.
const range_of_motion::AllowancePlan* AllowanceOf(const range_of_motion::RangePlan& plan,
                                                  const JointLimit& row) {
  for (const range_of_motion::JointPlan& joint : plan.joints) {
    if (joint.joint != row.joint) continue;
    for (const range_of_motion::AllowancePlan& allowance : joint.allowed_beyond) {
      if (allowance.motion == row.motion) return &allowance;
    }
  }
  return nullptr;
}

Json RowJson(const anatomy::JointLimits& limits, const range_of_motion::RangePlan& plan,
             const JointLimit& row, anatomy::Language language) {
  const range_of_motion::AllowancePlan* allowance = AllowanceOf(plan, row);
  return Json({{"joint", row.joint},
               {"joint_name", Named(limits.joints(), row.joint).names.In(language)},
               {"posture", NameOf(row.posture)},
               {"motion", row.motion},
               {"motion_name", Named(limits.motions(), row.motion).names.In(language)},
               {"low_deg", row.low_deg},
               {"high_deg", row.high_deg},
               {"is_to_both_sides", row.is_to_both_sides},
               {"printed", row.printed},
               {"why", row.why},
               {"default_deg", row.high_deg + (allowance == nullptr ? 0.0 : allowance->degrees)},
               {"default_why", allowance == nullptr ? "" : allowance->why}});
}

Json LeftJson(const anatomy::JointLimits& limits, const range_of_motion::Margin& margin,
              anatomy::Language language) {
  return Json({{"motion", *margin.motion},
               {"motion_name", margin.motion->empty()
                                   ? std::string("reach")
                                   : Named(limits.motions(), *margin.motion).names.In(language)},
               {"left_deg", std::round(10.0 * margin.margin_rad * kDegrees) / 10.0}});
}

Json AnglesJson(const Limb& limb, const Eigen::VectorXd& angles_rad) {
  Json angles = Json::array();
  for (std::size_t k = 0; k < limb.dofs.size(); ++k) {
    const auto& dof = limb.dofs[k];
    angles.push_back(Json({{"angle", dof.name},
                           {"kind", NameOf(dof.kind)},
                           {"min_deg", dof.angle_min_rad * kDegrees},
                           {"max_deg", dof.angle_max_rad * kDegrees},
                           {"deg", angles_rad[static_cast<Eigen::Index>(k)] * kDegrees}}));
  }
  return angles;
}

}  // namespace

Json MeasuresJson(const anthropometry::BodyMeasures& measures, const Person& person,
                  const ReportRequest& request) {
  Json rows = Json::array();
  std::string names;
  for (const BodyMeasure& measure : measures.all()) {
    const auto mm = Millimetres(measure, person);
    if (!mm) continue;
    names = Listed(names, measure.name + " (" + measure.names.In(request.language) + ")");
    if (!request.measure.empty() && request.measure != measure.name &&
        !measure.names.Match(request.measure)) {
      continue;
    }
    rows.push_back(MeasureJson(measure, *mm, request.language));
  }
  if (rows.empty()) RefuseName("measure", request.measure, names);
  return rows;
}

Json JointLimitsJson(const anatomy::JointLimits& limits, const range_of_motion::RangePlan& plan,
                     const ReportRequest& request) {
  Json rows = Json::array();
  for (const JointLimit& row : request.joint.empty() ? limits.rows() : limits.Of(request.joint)) {
    rows.push_back(RowJson(limits, plan, row, request.language));
  }
  if (rows.empty()) {
    std::string names;
    for (const auto& joint : limits.joints()) {
      names = Listed(names, joint.name + " (" + joint.names.In(request.language) + ")");
    }
    RefuseName("joint", request.joint, names);
  }
  return rows;
}

Json SpeedLimitsJson(const range_of_motion::SpeedLimits& speeds, const anatomy::JointLimits& limits,
                     const ReportRequest& request) {
  Json joints = Json::array();
  for (const range_of_motion::JointSpeed& speed : speeds.joints) {
    const auto& term = Named(limits.joints(), speed.joint);
    if (!request.joint.empty() && request.joint != term.name && !term.names.Match(request.joint)) {
      continue;
    }
    joints.push_back({{"joint", speed.joint},
                      {"joint_name", term.names.In(request.language)},
                      {"speed_deg_per_s", speed.speed_deg_per_s},
                      {"acceleration_deg_per_s2", speed.acceleration_deg_per_s2}});
  }
  return Json{
      {"derived_from", speeds.derived_from}, {"certainty", speeds.certainty}, {"joints", joints}};
}

Json LimbsJson(const body_model::BodyModel& model, const body_model::BodyPose& pose) {
  body_model::Kinematics kinematics(model);
  kinematics.Update(pose);
  Json limbs = Json::array();
  for (int i = 0; i < model.limb_count(); ++i) {
    const Limb& limb = model.limbs()[static_cast<std::size_t>(i)];
    const auto& shape = limb.shape;
    const std::string parent =
        limb.parent < 0 ? "" : model.limbs()[static_cast<std::size_t>(limb.parent)].name;
    const auto angles =
        pose.angles_rad.segment(model.first_angle(i), static_cast<Eigen::Index>(limb.dofs.size()));
    limbs.push_back(Json({{"limb", limb.name},
                          {"parent", parent},
                          {"length_m", shape.length_m},
                          {"proximal_semi_axes_m", Json::array({shape.a0_m, shape.b0_m})},
                          {"distal_semi_axes_m", Json::array({shape.a1_m, shape.b1_m})},
                          {"volume_m3", SolidOf(shape).volume_m3},
                          {"proximal_joint_m", VectorJson(kinematics.proximal_m(i))},
                          {"distal_end_m", VectorJson(kinematics.distal_m(i))},
                          {"angles", AnglesJson(limb, angles)}}));
  }
  return limbs;
}

Json PostureJson(const body_model::BodyModel& model, const range_of_motion::RangeOfMotion& range,
                 const body_model::BodyPose& pose, const anatomy::JointLimits& limits,
                 const ReportRequest& request) {
  body_model::Kinematics kinematics(model);
  kinematics.Update(pose);
  std::vector<range_of_motion::JointState> states;
  range.Check(kinematics, states);
  Json joints = Json::array();
  for (std::size_t i = 0; i < states.size(); ++i) {
    const auto& term = Named(limits.joints(), range.joints()[i].joint.joint());
    if (!request.joint.empty() && request.joint != term.name && !term.names.Match(request.joint)) {
      continue;
    }
    Json left = Json::array();
    for (int k = 0; k < states[i].margins.count; ++k) {
      const auto& margin = states[i].margins.each[static_cast<std::size_t>(k)];
      if (margin.motion != nullptr) left.push_back(LeftJson(limits, margin, request.language));
    }
    joints.push_back(Json({{"joint", range.joints()[i].Name()},
                           {"joint_name", term.names.In(request.language)},
                           {"limits", left}}));
  }
  return joints;
}

Json JointValuesJson(const body_model::BodyModel& model, const body_model::BodyPose& pose,
                     const std::string& body_id) {
  Json members = Json::object();
  for (const auto& value : JointValues(model, UrdfJoints(model, body_id), pose)) {
    members[value.joint] = value.angle_rad;
  }
  return members;
}

}  // namespace deixis::anthropometer
