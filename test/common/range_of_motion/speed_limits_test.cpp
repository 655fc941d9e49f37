#include "common/range_of_motion/speed_limits.h"

#include <gmock/gmock.h>

#include "common/config/config.h"
#include "test/common/range_of_motion/range_samples.h"
#include "test/support/temporary_folder.h"

namespace deixis::range_of_motion {
namespace {

const std::string kGood = R"(derived_from: a test
certainty: low
joints:
  - {joint: knee, speed_deg_per_s: 180, acceleration_deg_per_s2: 3600}
)";

TEST(SpeedLimits, AreGivenToTheLimbsOfTheirJoint) {
  const test::TemporaryFolder folder;
  const SpeedLimits limits = LoadSpeedLimits(folder.Write("speeds.yaml", kGood));
  const auto model = WithSpeedLimits(ShippedBody("whole_body"), ShippedRanges(), limits);
  for (const body_model::Limb& limb : model.limbs()) {
    const bool is_shank = limb.name.find("shank") != std::string::npos;
    for (const body_model::DegreeOfFreedom& dof : limb.dofs) {
      EXPECT_NEAR(dof.speed_max_rad_per_s, is_shank ? M_PI : 0.0, 1e-9) << limb.name;
      EXPECT_NEAR(dof.acceleration_max_rad_per_s2, is_shank ? 20.0 * M_PI : 0.0, 1e-9);
    }
  }
}

TEST(SpeedLimits, AreRefusedForAJointThatHasNoRange) {
  const test::TemporaryFolder folder;
  SpeedLimits limits = LoadSpeedLimits(folder.Write("speeds.yaml", kGood));
  limits.joints.front().joint = "kneee";
  try {
    WithSpeedLimits(ShippedBody("whole_body"), ShippedRanges(), limits);
    FAIL();
  } catch (const config::ConfigError& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("kneee"));
  }
}

TEST(SpeedLimits, AreShippedForEveryJointWithTheirOriginAndCertainty) {
  const SpeedLimits limits =
      LoadSpeedLimits(DEIXIS_SOURCE_DIR "/config/kinematics/joint_speeds.yaml");
  for (const JointPlan& joint : ShippedRanges().joints) {
    EXPECT_NE(limits.Find(joint.joint), nullptr) << joint.joint;
  }
  EXPECT_THAT(limits.derived_from, testing::HasSubstr("motion capture"));
  EXPECT_THAT(limits.certainty, testing::StartsWith("low"));
}

struct Broken {
  std::string old_text, new_text, complaint;
};

TEST(SpeedLimits, AreRefusedByFileAndKeyWhenTheyAreWrong) {
  for (const Broken& broken :
       {Broken{"180", "-1", "speed_deg_per_s"}, Broken{"3600", "0", "acceleration"},
        Broken{"certainty: low\n", "", "certainty"}, Broken{"a test", "''", "derived_from"},
        Broken{"joint: knee", "joint: ''", "joint"},
        Broken{"joints:\n",
               "joints:\n  - {joint: knee, speed_deg_per_s: 1, "
               "acceleration_deg_per_s2: 1}\n",
               "'knee' is there already"}}) {
    std::string text = kGood;
    text.replace(text.find(broken.old_text), broken.old_text.size(), broken.new_text);
    const test::TemporaryFolder folder;
    try {
      LoadSpeedLimits(folder.Write("speeds.yaml", text));
      ADD_FAILURE() << broken.complaint;
    } catch (const config::ConfigError& error) {
      EXPECT_THAT(error.what(), testing::HasSubstr("speeds.yaml"));
      EXPECT_THAT(error.what(), testing::HasSubstr(broken.complaint));
    }
  }
}

}  // namespace
}  // namespace deixis::range_of_motion
