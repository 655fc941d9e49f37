#include "services/anthropometer/core/body_report.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "common/body_model/body_plan.h"
#include "common/body_model/kinematics.h"
#include "common/config/config.h"
#include "services/anthropometer/core/json_text.h"
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

std::string VectorJson(const Vector3d& v) {
  return JsonArray({JsonNumber(v.x()), JsonNumber(v.y()), JsonNumber(v.z())});
}

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

std::string MeasureJson(const BodyMeasure& measure, double mm, anatomy::Language language) {
  return JsonObject({{"measure", JsonString(measure.name)},
                     {"name", JsonString(measure.names.In(language))},
                     {"mm", JsonNumber(std::round(10.0 * mm) / 10.0)}});
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

std::string RowJson(const anatomy::JointLimits& limits, const JointLimit& row,
                    anatomy::Language language) {
  return JsonObject(
      {{"joint", JsonString(row.joint)},
       {"joint_name", JsonString(Named(limits.joints(), row.joint).names.In(language))},
       {"posture", JsonString(NameOf(row.posture))},
       {"motion", JsonString(row.motion)},
       {"motion_name", JsonString(Named(limits.motions(), row.motion).names.In(language))},
       {"low_deg", JsonNumber(row.low_deg)},
       {"high_deg", JsonNumber(row.high_deg)},
       {"is_to_both_sides", row.is_to_both_sides ? "true" : "false"},
       {"printed", JsonString(row.printed)},
       {"why", JsonString(row.why)}});
}

std::string LeftJson(const anatomy::JointLimits& limits, const range_of_motion::Margin& margin,
                     anatomy::Language language) {
  return JsonObject(
      {{"motion", JsonString(*margin.motion)},
       {"motion_name", JsonString(Named(limits.motions(), *margin.motion).names.In(language))},
       {"left_deg", JsonNumber(std::round(10.0 * margin.margin_rad * kDegrees) / 10.0)}});
}

std::string AnglesJson(const Limb& limb, const Eigen::VectorXd& angles_rad) {
  std::vector<std::string> angles;
  for (std::size_t k = 0; k < limb.dofs.size(); ++k) {
    const auto& dof = limb.dofs[k];
    angles.push_back(
        JsonObject({{"angle", JsonString(dof.name)},
                    {"kind", JsonString(NameOf(dof.kind))},
                    {"min_deg", JsonNumber(dof.angle_min_rad * kDegrees)},
                    {"max_deg", JsonNumber(dof.angle_max_rad * kDegrees)},
                    {"deg", JsonNumber(angles_rad[static_cast<Eigen::Index>(k)] * kDegrees)}}));
  }
  return JsonArray(angles);
}

}  // namespace

std::string MeasuresJson(const anthropometry::BodyMeasures& measures, const Person& person,
                         const ReportRequest& request) {
  std::vector<std::string> rows;
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
  return JsonArray(rows);
}

std::string JointLimitsJson(const anatomy::JointLimits& limits, const ReportRequest& request) {
  std::vector<std::string> rows;
  for (const JointLimit& row : request.joint.empty() ? limits.rows() : limits.Of(request.joint)) {
    rows.push_back(RowJson(limits, row, request.language));
  }
  if (rows.empty()) {
    std::string names;
    for (const auto& joint : limits.joints()) {
      names = Listed(names, joint.name + " (" + joint.names.In(request.language) + ")");
    }
    RefuseName("joint", request.joint, names);
  }
  return JsonArray(rows);
}

std::string LimbsJson(const body_model::BodyModel& model, const body_model::BodyPose& pose) {
  body_model::Kinematics kinematics(model);
  kinematics.Update(pose);
  std::vector<std::string> limbs;
  for (int i = 0; i < model.limb_count(); ++i) {
    const Limb& limb = model.limbs()[static_cast<std::size_t>(i)];
    const auto& shape = limb.shape;
    const std::string parent =
        limb.parent < 0 ? "" : model.limbs()[static_cast<std::size_t>(limb.parent)].name;
    const auto angles =
        pose.angles_rad.segment(model.first_angle(i), static_cast<Eigen::Index>(limb.dofs.size()));
    limbs.push_back(JsonObject(
        {{"limb", JsonString(limb.name)},
         {"parent", JsonString(parent)},
         {"length_m", JsonNumber(shape.length_m)},
         {"proximal_semi_axes_m", JsonArray({JsonNumber(shape.a0_m), JsonNumber(shape.b0_m)})},
         {"distal_semi_axes_m", JsonArray({JsonNumber(shape.a1_m), JsonNumber(shape.b1_m)})},
         {"volume_m3", JsonNumber(SolidOf(shape).volume_m3)},
         {"proximal_joint_m", VectorJson(kinematics.proximal_m(i))},
         {"distal_end_m", VectorJson(kinematics.distal_m(i))},
         {"angles", AnglesJson(limb, angles)}}));
  }
  return JsonArray(limbs);
}

std::string PostureJson(const body_model::BodyModel& model,
                        const range_of_motion::RangeOfMotion& range,
                        const body_model::BodyPose& pose, const anatomy::JointLimits& limits,
                        const ReportRequest& request) {
  body_model::Kinematics kinematics(model);
  kinematics.Update(pose);
  std::vector<range_of_motion::JointState> states;
  range.Check(kinematics, states);
  std::vector<std::string> joints;
  for (std::size_t i = 0; i < states.size(); ++i) {
    const auto& term = Named(limits.joints(), range.joints()[i].joint.joint());
    if (!request.joint.empty() && request.joint != term.name && !term.names.Match(request.joint)) {
      continue;
    }
    std::vector<std::string> left;
    for (int k = 0; k < states[i].margins.count; ++k) {
      const auto& margin = states[i].margins.each[static_cast<std::size_t>(k)];
      if (margin.motion != nullptr) left.push_back(LeftJson(limits, margin, request.language));
    }
    joints.push_back(JsonObject({{"joint", JsonString(range.joints()[i].Name())},
                                 {"joint_name", JsonString(term.names.In(request.language))},
                                 {"limits", JsonArray(left)}}));
  }
  return JsonArray(joints);
}

std::string JointValuesJson(const body_model::BodyModel& model, const body_model::BodyPose& pose,
                            const std::string& body_id) {
  std::vector<JsonMember> members;
  for (const auto& value : JointValues(model, UrdfJoints(model, body_id), pose)) {
    members.push_back({value.joint, JsonNumber(value.angle_rad)});
  }
  return JsonObject(members);
}

}  // namespace deixis::anthropometer
