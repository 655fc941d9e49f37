#include "services/anthropometer/core/body_report.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <functional>

#include "common/body_model/joint_angles.h"
#include "common/config/config.h"
#include "test/services/anthropometer/person.h"
#include "test/support/temporary_folder.h"

namespace deixis::anthropometer {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using ::testing::Not;

const std::string kKinematics = DEIXIS_SOURCE_DIR "/config/kinematics/";

range_of_motion::RangePlan Plan() {
  return range_of_motion::LoadRangePlan(kKinematics + "range_of_motion.yaml");
}

std::string FaultOf(const std::function<void()>& work) {
  try {
    work();
  } catch (const config::ConfigError& error) {
    return error.what();
  }
  return {};
}

TEST(BodyReport, TellsSumsOfMeasuresToo) {
  const auto measures = anthropometry::BodyMeasures::Load({kKinematics + "measures.yaml"});
  const Person person{anthropometry::Sex::kMale, 1.8, {{"kph", 1.8}, {"stl", 0.94}}};
  ASSERT_FALSE(measures.Find("blp")->derived.empty());  // kph - stl
  const Json told = MeasuresJson(measures, person, {anatomy::Language::kGerman, "", "blp"});
  ASSERT_EQ(told.size(), 1u);
  EXPECT_EQ(told[0]["measure"], "blp");
  EXPECT_EQ(told[0]["name"], measures.Find("blp")->names.german);
  EXPECT_EQ(told[0]["mm"], 860.0);
}

TEST(BodyReport, ListsWhatThereIsForANameThatIsNone) {
  const auto measures = anthropometry::BodyMeasures::Load({kKinematics + "measures.yaml"});
  const auto limits = anatomy::JointLimits::Load(kKinematics + "joint_limits.yaml");
  const Person person{anthropometry::Sex::kMale, 1.8, {{"kph", 1.8}}};
  const ReportRequest request{anatomy::Language::kGerman, "tail", "wingspan"};
  EXPECT_THAT(FaultOf([&] { JointLimitsJson(limits, Plan(), request); }),
              AllOf(HasSubstr("--joint tail is none"), HasSubstr("knee (Kniegelenk)")));
  EXPECT_THAT(FaultOf([&] { MeasuresJson(measures, person, request); }),
              AllOf(HasSubstr("--measure wingspan is none"), HasSubstr("kph (Körperhöhe)")));
}

TEST(BodyReport, FindsJointsByTheirNamesInAnyLanguage) {
  const auto limits = anatomy::JointLimits::Load(kKinematics + "joint_limits.yaml");
  const auto told = [&](const std::string& name) {
    return JointLimitsJson(limits, Plan(), {anatomy::Language::kEnglish, name, ""}).dump();
  };
  EXPECT_THAT(told("hip"), AllOf(HasSubstr("\"hip joint\""), Not(HasSubstr("knee"))));
  for (const char* name : {"Hip joint", "Hüftgelenk", "hueftgelenk", "articulatio coxae"}) {
    EXPECT_EQ(told(name), told("hip")) << name;
  }
}

TEST(BodyReport, TellsWhatTheDefaultLimitsAddToARowAndWhy) {
  const auto limits = anatomy::JointLimits::Load(kKinematics + "joint_limits.yaml");
  auto plan = Plan();
  for (range_of_motion::JointPlan& joint : plan.joints) {
    if (joint.joint == "knee") joint.allowed_beyond = {{"flexion", 7.0, "a test"}};
  }
  const Json rows = JointLimitsJson(limits, plan, {anatomy::Language::kEnglish, "knee", ""});
  for (const Json& row : rows) {
    const bool is_flexion = row["motion"] == "flexion";
    EXPECT_EQ(row["default_deg"], row["high_deg"].get<double>() + (is_flexion ? 7.0 : 0.0));
    EXPECT_EQ(row["default_why"], is_flexion ? "a test" : "");
  }
}

TEST(BodyReport, TellsLimitsOfSpeedWithTheirCertainty) {
  const auto limits = anatomy::JointLimits::Load(kKinematics + "joint_limits.yaml");
  range_of_motion::SpeedLimits speeds{"a test", "low", {{"knee", 300, 4000}, {"hip", 200, 3000}}};
  const Json told = SpeedLimitsJson(speeds, limits, {anatomy::Language::kGerman, "Kniegelenk", ""});
  EXPECT_EQ(told["certainty"], "low");
  ASSERT_EQ(told["joints"].size(), 1u);
  EXPECT_EQ(told["joints"][0]["joint_name"], "Kniegelenk");
  EXPECT_EQ(told["joints"][0]["speed_deg_per_s"], 300.0);
}

TEST(BodyReport, TellsHowFarJointsAreFromTheirLimitsInThePose) {
  const body_model::BodyModel model = TallMan("whole_body_detailed");
  const auto limits = anatomy::JointLimits::Load(kKinematics + "joint_limits.yaml");
  const range_of_motion::RangeOfMotion range(
      model, range_of_motion::LoadRangePlan(kKinematics + "range_of_motion.yaml"), limits,
      range_of_motion::Limits::kSource);
  body_model::BodyPose pose = body_model::Standing(model);
  pose.angles_rad[model.first_angle(*model.Find("left_lower_arm"))] = 120.0 * M_PI / 180.0;
  const std::string told =
      PostureJson(model, range, pose, limits, {anatomy::Language::kGerman, "Ellenbogengelenk", ""})
          .dump();
  EXPECT_THAT(told, HasSubstr(R"("joint":"left_elbow","joint_name":"Ellenbogengelenk")"));
  EXPECT_THAT(told, HasSubstr(R"("motion":"flexion","motion_name":"Beugen","left_deg":30.0})"));
  EXPECT_THAT(told, Not(HasSubstr("hip")));
}

}  // namespace
}  // namespace deixis::anthropometer
