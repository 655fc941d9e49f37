// Tells of the body model of one person: sizes, limbs and joint limits as JSON; draws it; writes it
// as URDF and as a mesh.
#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdint>
#include <iostream>
#include <opencv2/imgcodecs.hpp>
#include <string>
#include <vector>

#include "common/anthropometry/person_estimate.h"
#include "common/body_model/body_plan.h"
#include "common/config/config.h"
#include "common/files/whole_file.h"
#include "common/program/command_line.h"
#include "common/range_of_motion/range_plan.h"
#include "common/text/number_text.h"
#include "services/anthropometer/body/arguments.h"
#include "services/anthropometer/core/body_report.h"
#include "services/anthropometer/core/mesh.h"
#include "services/anthropometer/core/model_file.h"
#include "services/anthropometer/core/range_picture.h"
#include "services/anthropometer/core/urdf.h"

namespace deixis::anthropometer {
namespace {

using config::FindConfig;
using files::WriteWhole;

constexpr int kPicture_px = 1200;  // Height; twice as wide.

Person PersonOf(const Arguments& arguments) {
  const auto populations =
      anthropometry::Populations::Load(FindConfig("kinematics/population.yaml"));
  const double stature_m =
      arguments.stature_m
          ? *arguments.stature_m
          : StatureAt(populations, arguments.sex, 0.01 * arguments.percentile.value_or(50.0));
  return {arguments.sex, stature_m, SizesOf(populations, arguments.sex, stature_m)};
}

range_of_motion::RangeOfMotion RangeOf(const body_model::BodyModel& model,
                                       const anatomy::JointLimits& limits) {
  return {model,
          range_of_motion::LoadRangePlan(FindConfig("kinematics/range_of_motion.yaml"), limits),
          limits};
}

Json Told(const Person& person, const body_model::BodyModel& model,
          const body_model::BodyPose& pose, const Arguments& arguments) {
  const ReportRequest& request = arguments.request;
  Json parts = {{"sex", person.sex == anthropometry::Sex::kFemale ? "female" : "male"},
                {"stature_m", person.stature_m},
                {"model", model.name()}};
  const bool is_all = request.joint.empty() && request.measure.empty();
  if (is_all || !request.measure.empty()) {
    parts["measures"] = MeasuresJson(ShippedMeasures(), person, request);
  }
  if (is_all) {
    parts["limbs"] = LimbsJson(model, pose);
    parts["urdf_joints_rad"] = JointValuesJson(model, pose, arguments.body_id);
  }
  if (is_all || !request.joint.empty()) {
    const auto limits = ShippedLimits();
    const auto plan =
        range_of_motion::LoadRangePlan(FindConfig("kinematics/range_of_motion.yaml"), limits);
    parts["joint_limits"] = JointLimitsJson(limits, plan, request);
    parts["speed_limits"] = SpeedLimitsJson(
        range_of_motion::LoadSpeedLimits(FindConfig("kinematics/joint_speeds.yaml")), limits,
        request);
    parts["posture"] = PostureJson(model, RangeOf(model, limits), pose, limits, request);
  }
  return parts;
}

void WritePicture(const Person& person, const body_model::BodyModel& model,
                  const body_model::BodyPose& pose, const Arguments& arguments) {
  const auto limits = ShippedLimits();
  const std::string title = model.name() + ", " +
                            (person.sex == anthropometry::Sex::kFemale ? "female" : "male") + ", " +
                            text::NumberText(std::round(1000.0 * person.stature_m) / 1000.0) + " m";
  const PictureWords words{&limits, arguments.request.language, title};
  std::vector<std::uint8_t> png;
  cv::imencode(".png", DrawWithRanges(model, pose, RangeOf(model, limits), words, kPicture_px),
               png);
  WriteWhole(arguments.png, {png.begin(), png.end()});
}

void Run(const Arguments& arguments) {
  const Person person = PersonOf(arguments);
  const auto model = body_model::LoadBody(FindModelFile(arguments.model), person.sizes_m);
  const body_model::BodyPose pose = PoseOf(model, arguments);
  const Json told = Told(person, model, pose, arguments);
  if (!arguments.urdf.empty()) WriteWhole(arguments.urdf, UrdfOf(model, arguments.body_id));
  if (!arguments.ply.empty()) WriteWhole(arguments.ply, PlyOf(model, pose));
  if (!arguments.png.empty()) WritePicture(person, model, pose, arguments);
  std::cout << told.dump() << "\n";
  program::FinishOutput(std::cout);
}

}  // namespace
}  // namespace deixis::anthropometer

int main(int argc, char** argv) {
  try {
    deixis::anthropometer::Run(deixis::anthropometer::Parse(argc, argv));
  } catch (const std::exception& error) {
    std::cerr << "deixis-body: " << error.what() << "\n";
    return deixis::program::kCannotWork;
  }
  return deixis::program::kStopped;
}
