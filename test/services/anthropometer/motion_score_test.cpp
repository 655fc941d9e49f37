// What limits say of recordings, on recordings that are made up.
#include "services/anthropometer/motion_evaluation/motion_score.h"

#include <gmock/gmock.h>

#include <stdexcept>

#include "common/body_model/joint_angles.h"
#include "services/anthropometer/motion_evaluation/speed_score.h"
#include "test/services/anthropometer/person.h"

namespace deixis::anthropometer {
namespace {

using range_of_motion::Limits;
using retargeting::Retargeted;

const std::string kKinematics = DEIXIS_SOURCE_DIR "/config/kinematics/";

const anatomy::JointLimits& Rows() {
  static const auto rows = anatomy::JointLimits::Load(kKinematics + "joint_limits.yaml");
  return rows;
}

const range_of_motion::RangePlan& Plan() {
  static const auto plan = range_of_motion::LoadRangePlan(kKinematics + "range_of_motion.yaml");
  return plan;
}

/// A man who stands and bends one knee to these angles, frame by frame, at 30 Hz.
Retargeted KneeBends(const std::vector<double>& degrees) {
  Retargeted made{{TallMan("whole_body_detailed"), 30.0, {}}, {{"right_shank", 0.002, 0.005}}, {}};
  const body_model::BodyModel& model = made.motion.model;
  for (const double angle : degrees) {
    body_model::BodyPose pose = Standing(model);
    pose.angles_rad[model.first_angle(*model.Find("right_shank"))] = angle * M_PI / 180.0;
    made.motion.poses.push_back(pose);
  }
  return made;
}

TEST(MotionScore, CountsWhatIsBeyondALimitByJointAndMotion) {
  MotionScore score;
  AddClip("knee", KneeBends({0, 100, 154, 158, 157}), {Plan(), Rows(), Limits::kSource}, score);
  EXPECT_EQ(score.joints["knee"].joint_frames, 10);
  EXPECT_EQ(score.joints["knee"].rejected, 3);
  EXPECT_EQ(score.joints["hip"].rejected, 0);
  const CauseScore& cause = score.causes[Cause{"knee", "flexion"}];
  EXPECT_EQ(cause.rejected, 3);
  EXPECT_NEAR(cause.worst_deg, 8.0, 1e-6);
  EXPECT_NEAR(score.RejectedShare(), 3.0 / (14.0 * 5.0), 1e-12);
  ASSERT_EQ(score.clips.size(), 1u);
  EXPECT_EQ(score.clips[0].rejected, 3);
  EXPECT_NEAR(score.clips[0].largest_error_m, 0.005, 1e-12);
}

TEST(MotionScore, JudgesByTheDefaultLimitsTooWhichAllowMore) {
  MotionScore score;
  AddClip("knee", KneeBends({154, 158}), {Plan(), Rows(), Limits::kDefault}, score);
  EXPECT_EQ(score.joints["knee"].rejected, 1);
}

TEST(MotionScore, CountsAJointThatNobodyHasApart) {
  MotionScore score;
  AddClip("knee", KneeBends({0, -80, 158}), {Plan(), Rows(), Limits::kSource}, score);
  EXPECT_EQ(score.joints["knee"].joint_frames, 3);  // The left one.
  EXPECT_EQ(score.joints["knee"].rejected, 0);
  EXPECT_EQ(score.faulty.joint_frames, 6);  // The ankle beyond it too.
  EXPECT_EQ(score.faulty.rejected, 2);
  EXPECT_THAT(score.clips[0].faulty, testing::UnorderedElementsAre("right_knee", "right_ankle"));
}

TEST(MotionScore, MakesTheAllowancesThatItsRecordingsNeed) {
  MotionScore score;
  AddClip("knee", KneeBends({0, 158}), {Plan(), Rows(), Limits::kSource}, score);
  const auto plan = WithAllowancesFor(score, Plan());
  for (const range_of_motion::JointPlan& joint : plan.joints) {
    EXPECT_EQ(joint.allowed_beyond.size(), joint.joint == "knee" ? 1u : 0u) << joint.joint;
    for (const auto& allowance : joint.allowed_beyond) EXPECT_EQ(allowance.degrees, 10.0);
  }
  MotionScore again;
  AddClip("knee", KneeBends({0, 158}), {plan, Rows(), Limits::kDefault}, again);
  EXPECT_EQ(again.joints["knee"].rejected, 0);
}

TEST(SpeedScore, MeasuresSpeedsAndAccelerationsOfJoints) {
  SpeedSamples samples;
  AddSpeeds(KneeBends({0, 3, 6, 12}).motion, {Plan(), Rows(), Limits::kSource}, samples);
  EXPECT_NEAR(Quantile(samples.speeds["knee"], 1.0), 180.0, 1e-6);  // 6 degrees in 1/30 s.
  EXPECT_NEAR(Quantile(samples.speeds["knee"], 0.0), 0.0, 1e-6);    // The left one.
  EXPECT_NEAR(Quantile(samples.accelerations["knee"], 1.0), 90.0 * 30.0, 1e-6);
}

TEST(SpeedScore, MakesLimitsWithAReserveAndTellsWhatExceedsThem) {
  SpeedSamples samples;
  samples.speeds["knee"] = std::vector<double>(1000, 101.0);
  samples.accelerations["knee"] = std::vector<double>(1000, 2000.0);
  const auto limits = LimitsFrom(samples, 2.0);
  ASSERT_EQ(limits.size(), 1u);
  EXPECT_EQ(limits[0].speed_deg_per_s, 210.0);
  EXPECT_EQ(limits[0].acceleration_deg_per_s2, 4000.0);
  samples.speeds["knee"][0] = 211.0;
  range_of_motion::SpeedLimits known;
  known.joints = limits;
  const auto scores = ScoreSpeeds(samples, known);
  ASSERT_EQ(scores.size(), 1u);
  EXPECT_NEAR(scores[0].too_fast, 0.001, 1e-12);
  EXPECT_EQ(scores[0].too_sudden, 0.0);
  EXPECT_EQ(scores[0].fastest_deg_per_s, 211.0);
}

TEST(SpeedScore, RefusesFramesTooFarApart) {
  Retargeted slow = KneeBends({0, 3});
  slow.motion.frame_rate_hz = 10.0;
  SpeedSamples samples;
  EXPECT_THROW(AddSpeeds(slow.motion, {Plan(), Rows(), Limits::kSource}, samples),
               std::invalid_argument);
}

}  // namespace
}  // namespace deixis::anthropometer
