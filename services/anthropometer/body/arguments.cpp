#include "services/anthropometer/body/arguments.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cctype>
#include <cmath>
#include <map>
#include <set>
#include <utility>

#include "common/body_model/joint_angles.h"
#include "common/config/config.h"
#include "common/program/command_line.h"
#include "common/text/number_text.h"

namespace deixis::anthropometer {
namespace {

using body_model::BodyModel;
using text::NumberText;

constexpr double kLowest_m = 1.2, kHighest_m = 2.3;

const std::vector<std::pair<std::string, StartingPose>> kPoses = {
    {"standing", StartingPose::kStanding}, {"rest", StartingPose::kRest}};

/// An option that takes one of a few words.
template <typename Value>
CLI::Option* AddChoice(CLI::App& app, const std::string& option, Value& value,
                       const std::vector<std::pair<std::string, Value>>& choices,
                       const std::string& help) {
  const std::map<std::string, Value> by_name(choices.begin(), choices.end());
  std::string words;
  for (const auto& [name, each] : choices) words += (words.empty() ? "" : "|") + name;
  return app
      .add_option_function<std::string>(
          option, [&value, by_name](const std::string& name) { value = by_name.at(name); }, help)
      ->check([by_name, words](const std::string& name) {
        return by_name.count(name) ? std::string() : "'" + name + "' is none of " + words;
      })
      ->type_name(words);
}

/// LIMB.ANGLE=DEG; nothing when it is none.
std::optional<AngleSetting> ParseAngle(const std::string& text) {
  const std::size_t dot = text.find('.'), is = text.find('=');
  if (dot == std::string::npos || is == std::string::npos || is < dot) return std::nullopt;
  AngleSetting setting{text.substr(0, dot), text.substr(dot + 1, is - dot - 1), 0.0};
  const std::string number = text.substr(is + 1);
  if (!CLI::detail::lexical_cast(number, setting.angle_deg) || !std::isfinite(setting.angle_deg)) {
    return std::nullopt;
  }
  return setting;
}

std::string StatureFault(const std::string& text) {
  double stature_m = 0.0;
  if (!CLI::detail::lexical_cast(text, stature_m)) return "'" + text + "' is no number";
  if (stature_m >= kLowest_m && stature_m <= kHighest_m) return {};
  return text + " is beyond " + NumberText(kLowest_m) + ".." + NumberText(kHighest_m) + " metres";
}

void AddPersonOptions(CLI::App& app, Arguments& arguments) {
  AddChoice(app, "--sex", arguments.sex, EnumNames(arguments.sex), "Whose sizes")->required();
  auto* stature = app.add_option("--stature", arguments.stature_m, "Body height, metres")
                      ->check(StatureFault)
                      ->type_name("METRES");
  app.add_option("--percentile", arguments.percentile,
                 "Instead: how many of that sex are no taller")
      ->check(CLI::Range(0.1, 99.9))
      ->type_name("PERCENT")
      ->excludes(stature);
  app.add_option("--model", arguments.model, "Name of a file of config/body_models");
}

void AddReportOptions(CLI::App& app, ReportRequest& request) {
  app.add_option("--joint", request.joint, "Tell the limits of this joint only, in any language")
      ->check(program::EmptyFault);
  app.add_option("--measure", request.measure, "Tell this measure only, in any language")
      ->check(program::EmptyFault);
  AddChoice(app, "--language", request.language, EnumNames(request.language), "Of the names");
}

void AddPoseOptions(CLI::App& app, Arguments& arguments, std::vector<std::string>& angles) {
  AddChoice(app, "--pose", arguments.pose, kPoses, "How it begins; rest: all angles 0");
  app.add_option("--angle", angles, "Then one angle of it; as often as needed")
      ->check([](const std::string& text) {
        return ParseAngle(text) ? std::string() : "'" + text + "' is no LIMB.ANGLE=DEGREES";
      })
      ->allow_extra_args(false)
      ->type_name("LIMB.ANGLE=DEGREES");
}

void AddFileOptions(CLI::App& app, Arguments& arguments) {
  app.add_option("--png", arguments.png, "Draw the body with the ranges of its joints");
  app.add_option("--urdf", arguments.urdf, "Write the model as URDF to this file");
  app.add_option("--body-id", arguments.body_id, "Ends all names of the URDF, as in REP 155")
      ->check([](const std::string& id) {
        const bool is_word = !id.empty() && std::all_of(id.begin(), id.end(), [](unsigned char c) {
          return c == '_' || (c < 0x80 && std::isalnum(c));
        });
        return is_word ? std::string() : "'" + id + "': letters, digits and _ only";
      });
  app.add_option("--ply", arguments.ply, "Write the surface in the pose as PLY to this file");
}

[[noreturn]] void RefuseAngle(const BodyModel& model, const AngleSetting& setting) {
  std::string names;
  for (const auto& limb : model.limbs()) {
    for (const auto& dof : limb.dofs)
      names += (names.empty() ? "" : ", ") + limb.name + "." + dof.name;
  }
  throw config::ConfigError("--angle " + setting.limb + "." + setting.angle +
                            " is none: there are " + names);
}

void Bend(const BodyModel& model, const AngleSetting& setting, body_model::BodyPose& pose) {
  const auto index = model.Find(setting.limb);
  if (!index) RefuseAngle(model, setting);
  const auto& dofs = model.limbs()[static_cast<std::size_t>(*index)].dofs;
  for (std::size_t k = 0; k < dofs.size(); ++k) {
    if (dofs[k].name != setting.angle) continue;
    const double low_deg = dofs[k].angle_min_rad * 180.0 / M_PI;
    const double high_deg = dofs[k].angle_max_rad * 180.0 / M_PI;
    if (setting.angle_deg < low_deg - 1e-9 || setting.angle_deg > high_deg + 1e-9) {
      throw config::ConfigError("--angle " + setting.limb + "." + setting.angle + ": " +
                                NumberText(setting.angle_deg) + " is beyond " +
                                NumberText(low_deg) + ".." + NumberText(high_deg) + " degrees");
    }
    pose.angles_rad[model.first_angle(*index) + static_cast<int>(k)] =
        setting.angle_deg * M_PI / 180.0;
    return;
  }
  RefuseAngle(model, setting);
}

}  // namespace

Arguments Parse(int argc, char** argv) {
  Arguments arguments;
  std::vector<std::string> angles;
  CLI::App app("Tells of the body model of one person, as JSON, and writes it to files.",
               "deixis-body");
  app.set_version_flag("--version", "deixis-body " DEIXIS_VERSION);
  AddPersonOptions(app, arguments);
  AddReportOptions(app, arguments.request);
  AddPoseOptions(app, arguments, angles);
  AddFileOptions(app, arguments);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    std::exit(app.exit(error) == 0 ? program::kStopped : program::kWrongCommand);
  }
  for (const std::string& text : angles) arguments.angles.push_back(*ParseAngle(text));
  return arguments;
}

body_model::BodyPose PoseOf(const BodyModel& model, const Arguments& arguments) {
  body_model::BodyPose pose =
      arguments.pose == StartingPose::kStanding ? Standing(model) : RestPose(model);
  std::set<std::pair<std::string, std::string>> bent;
  for (const AngleSetting& setting : arguments.angles) {
    if (!bent.emplace(setting.limb, setting.angle).second) {
      throw config::ConfigError("--angle " + setting.limb + "." + setting.angle +
                                " is given twice");
    }
    Bend(model, setting, pose);
  }
  return pose;
}

anthropometry::BodyMeasures ShippedMeasures() {
  return anthropometry::BodyMeasures::Load({config::FindConfig("kinematics/measures.yaml"),
                                            config::FindConfig("kinematics/measures_ansur2.yaml")});
}

anatomy::JointLimits ShippedLimits() {
  return anatomy::JointLimits::Load(config::FindConfig("kinematics/joint_limits.yaml"));
}

}  // namespace deixis::anthropometer
