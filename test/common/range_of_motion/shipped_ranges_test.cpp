// The joints of the shipped body models.
#include <gmock/gmock.h>

#include <map>

#include "common/body_model/joint_angles.h"
#include "common/range_of_motion/range_of_motion.h"
#include "test/common/range_of_motion/range_samples.h"
#include "test/support/allocation_count.h"

namespace deixis::range_of_motion {
namespace {

using body_model::BodyModel;
using body_model::BodyPose;
using body_model::Kinematics;

std::vector<std::string> NamesOf(const std::string& model) {
  const BodyModel body = ShippedBody(model);
  const RangeOfMotion ranges(body, ShippedRanges(), ShippedRows());
  std::vector<std::string> names;
  for (const ModelJoint& joint : ranges.joints()) names.push_back(joint.Name());
  return names;
}

TEST(ShippedRanges, AreThoseOfTheJointsThatAModelHas) {
  using testing::UnorderedElementsAre;
  EXPECT_THAT(NamesOf("whole_body_detailed"),
              UnorderedElementsAre("thoracolumbar_spine", "cervical_spine", "right_shoulder",
                                   "left_shoulder", "right_elbow", "left_elbow", "right_wrist",
                                   "left_wrist", "right_hip", "left_hip", "right_knee", "left_knee",
                                   "right_ankle", "left_ankle"));
  EXPECT_THAT(NamesOf("upper_body"),
              UnorderedElementsAre("cervical_spine", "right_shoulder", "left_shoulder",
                                   "right_elbow", "left_elbow"));
}

/// A pose with one angle of one limb set, degrees; arms and legs hang otherwise.
class Posed {
 public:
  explicit Posed(const std::string& model)
      : body_(ShippedBody(model)),
        ranges_(body_, ShippedRanges(), ShippedRows()),
        pose_(Standing(body_)) {}
  void Turn(const std::string& limb, int dof, double degrees) {
    pose_.angles_rad[body_.first_angle(*body_.Find(limb)) + dof] += degrees * kDegree;
  }
  AnatomicalAngles Degrees(const std::string& joint) const {
    Kinematics kinematics(body_);
    kinematics.Update(pose_);
    for (const ModelJoint& each : ranges_.joints()) {
      if (each.Name() == joint) return ranges_.Measure(kinematics, each) / kDegree;
    }
    throw std::logic_error("no joint " + joint);
  }

 private:
  BodyModel body_;
  RangeOfMotion ranges_;
  BodyPose pose_;
};

TEST(ShippedRanges, AreMeasuredFromTheStandingBody) {
  const Posed standing("whole_body_detailed");
  for (const char* joint : {"right_shoulder", "left_shoulder", "right_hip", "left_hip",
                            "right_knee", "right_elbow", "left_wrist", "right_ankle"}) {
    const AnatomicalAngles angles = standing.Degrees(joint);
    EXPECT_NEAR(angles[0], 0.0, 1e-5) << joint;
    EXPECT_NEAR(angles[2], 0.0, 1e-5) << joint;
  }
}

TEST(ShippedRanges, SumTheLimbsThatMakeAJointTogether) {
  Posed bent("whole_body_detailed");
  bent.Turn("abdomen", 1, 20.0);
  bent.Turn("chest", 1, 25.0);
  EXPECT_NEAR(bent.Degrees("thoracolumbar_spine")[0], 45.0, 1e-6);
  bent.Turn("neck", 2, 15.0);
  bent.Turn("head", 2, 10.0);
  EXPECT_GT(bent.Degrees("cervical_spine")[2], 20.0);
}

TEST(ShippedRanges, CountTheClavicleToTheShoulder) {
  Posed raised("whole_body_detailed");
  raised.Turn("right_clavicle", 0, 30.0);
  EXPECT_NEAR(raised.Degrees("right_shoulder")[0], 30.0, 0.5);
  EXPECT_NEAR(raised.Degrees("left_shoulder")[0], 0.0, 1e-5);
}

TEST(ShippedRanges, GiveEachMotionItsSign) {
  Posed moved("whole_body_detailed");
  moved.Turn("right_lower_arm", 0, 70.0);
  moved.Turn("left_lower_arm", 1, 40.0);
  moved.Turn("right_shank", 0, 60.0);
  moved.Turn("left_foot", 0, 10.0);
  moved.Turn("right_hand", 0, 30.0);
  EXPECT_NEAR(moved.Degrees("right_elbow")[0], 70.0, 1e-6);
  EXPECT_NEAR(moved.Degrees("left_elbow")[1], 40.0, 1e-6);
  EXPECT_NEAR(moved.Degrees("right_knee")[0], 60.0, 1e-6);
  EXPECT_NEAR(moved.Degrees("left_ankle")[0], 10.0, 1e-6);
  EXPECT_NEAR(moved.Degrees("right_wrist")[0], 30.0, 1e-6);
}

/// Margin of a joint's rotation about its limb, degrees.
double RotationMargin_deg(const std::string& name, double elbow_deg, double pronation_deg,
                          double inside_deg) {
  const BodyModel body = ShippedBody("whole_body");
  const RangeOfMotion ranges(body, ShippedRanges(), ShippedRows(), Limits::kSource);
  BodyPose pose = Standing(body);
  const int arm = *body.Find("right_upper_arm"), forearm = *body.Find("right_lower_arm");
  pose.angles_rad[body.first_angle(arm) + 2] += inside_deg * kDegree;
  pose.angles_rad[body.first_angle(forearm)] = elbow_deg * kDegree;
  pose.angles_rad[body.first_angle(forearm) + 1] = pronation_deg * kDegree;
  Kinematics kinematics(body);
  kinematics.Update(pose);
  std::vector<JointState> states;
  ranges.Check(kinematics, states);
  for (std::size_t i = 0; i < states.size(); ++i) {
    if (ranges.joints()[i].Name() != name) continue;
    const Margins& margins = states[i].margins;
    return margins.each[static_cast<std::size_t>(margins.count - 1)].margin_rad / kDegree;
  }
  throw std::logic_error("no joint " + name);
}

TEST(ShippedRanges, KeepTheReachOfAShoulderThatHasNoRotationToShare) {
  RangePlan plan = ShippedRanges();
  for (JointPlan& joint : plan.joints) {
    if (joint.joint != "shoulder") continue;
    joint.angles.clear();
    joint.allowed_beyond.clear();
  }
  const RangeOfMotion ranges(ShippedBody("whole_body"), plan, ShippedRows());
  for (const ModelJoint& joint : ranges.joints()) EXPECT_EQ(joint.shares_with, -1) << joint.Name();
}

TEST(ShippedRanges, BoundRotationsThatAStretchedElbowCannotTellApartByTheirSum) {
  EXPECT_NEAR(RotationMargin_deg("right_elbow", 60.0, 100.0, -50.0), -10.0, 1e-6);
  EXPECT_GT(RotationMargin_deg("right_elbow", 10.0, 100.0, -50.0), 0.0);
  EXPECT_GT(RotationMargin_deg("right_shoulder", 10.0, 110.0, -120.0), 0.0);
  EXPECT_NEAR(RotationMargin_deg("right_shoulder", 60.0, 110.0, -120.0), -30.0, 1e-6);
  EXPECT_NEAR(RotationMargin_deg("right_elbow", 10.0, 100.0, 100.0), -10.0, 1e-6);
}

TEST(ShippedRanges, HaveNobodyBeyondThemWhoStands) {
  for (const char* name :
       {"upper_body", "whole_body", "whole_body_detailed", "clothed_body", "right_arm"}) {
    const BodyModel body = ShippedBody(name);
    const RangeOfMotion ranges(body, ShippedRanges(), ShippedRows(), Limits::kSource);
    Kinematics kinematics(body);
    kinematics.Update(Standing(body));
    std::vector<JointState> states;
    ranges.Check(kinematics, states);
    for (const JointState& state : states) {
      for (int i = 0; i < state.margins.count; ++i) {
        EXPECT_GE(state.margins.each[static_cast<std::size_t>(i)].margin_rad, 0.0) << name;
      }
    }
  }
}

TEST(ShippedRanges, AreCheckedWithoutTakingMemory) {
  const BodyModel body = ShippedBody("whole_body_detailed");
  const RangeOfMotion ranges(body, ShippedRanges(), ShippedRows());
  const BodyPose pose = Standing(body);
  Kinematics kinematics(body);
  std::vector<JointState> states;
  ranges.Check(kinematics, states);
  const std::size_t before = test::AllocatedBytes();
  kinematics.Update(pose);
  ranges.Check(kinematics, states);
  EXPECT_EQ(test::AllocatedBytes(), before);
}

}  // namespace
}  // namespace deixis::range_of_motion
