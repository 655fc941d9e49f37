// Limits that depend on the posture, with the source's rows.
#include "common/range_of_motion/bound.h"

#include <gmock/gmock.h>

#include <cmath>

#include "common/config/config.h"

namespace deixis::range_of_motion {
namespace {

const anatomy::JointLimits& Rows() {
  static const auto rows =
      anatomy::JointLimits::Load(DEIXIS_SOURCE_DIR "/config/kinematics/joint_limits.yaml");
  return rows;
}

constexpr double kDegree = M_PI / 180.0;

double Limit_deg(const std::string& joint, const std::string& motion, double flexion_deg,
                 Load load = Load::kUnknown) {
  return BoundOf(Rows(), joint, motion, 0.0).At(flexion_deg * kDegree, load).high_rad / kDegree;
}

TEST(Bound, OfTheHipChangesWithItsFlexion) {
  EXPECT_NEAR(Limit_deg("hip", "abduction", 0), 50, 1e-9);
  EXPECT_NEAR(Limit_deg("hip", "abduction", 45), 65, 1e-9);
  EXPECT_NEAR(Limit_deg("hip", "abduction", 90), 80, 1e-9);
  EXPECT_NEAR(Limit_deg("hip", "adduction", 30), 30 - 10.0 / 3.0, 1e-9);
  EXPECT_NEAR(Limit_deg("hip", "outside_rotation", 90), 50, 1e-9);
}

TEST(Bound, StaysBeyondTheFlexionsThatTheSourceNames) {
  EXPECT_NEAR(Limit_deg("hip", "abduction", -20), 50, 1e-9);
  EXPECT_NEAR(Limit_deg("hip", "abduction", 130), 80, 1e-9);
}

TEST(Bound, LetsAStretchedKneeNotRotate) {
  EXPECT_NEAR(Limit_deg("knee", "outside_rotation", 0), 0, 1e-9);
  EXPECT_NEAR(Limit_deg("knee", "outside_rotation", 45), 20, 1e-9);
  EXPECT_NEAR(Limit_deg("knee", "outside_rotation", 90), 40, 1e-9);
}

TEST(Bound, OfTheAnkleDependsOnLoadAndIsTheWiderOneWhenThatIsUnknown) {
  EXPECT_NEAR(Limit_deg("ankle", "dorsal_extension", 0, Load::kLoaded), 50, 1e-9);
  EXPECT_NEAR(Limit_deg("ankle", "dorsal_extension", 0, Load::kFree), 30, 1e-9);
  EXPECT_NEAR(Limit_deg("ankle", "dorsal_extension", 0), 50, 1e-9);
  EXPECT_NEAR(Limit_deg("ankle", "plantar_flexion", 0, Load::kLoaded), 30, 1e-9);
  EXPECT_NEAR(Limit_deg("ankle", "plantar_flexion", 0), 50, 1e-9);
}

TEST(Bound, KeepsRangesAsRanges) {
  const Bound bound = BoundOf(Rows(), "knee", "flexion", 0.0);
  EXPECT_NEAR(bound.At(0.0, Load::kUnknown).low_rad, 120 * kDegree, 1e-12);
  EXPECT_NEAR(bound.At(0.0, Load::kUnknown).high_rad, 150 * kDegree, 1e-12);
}

TEST(Bound, IsWidenedAtItsOuterEndOnly) {
  const Bound bound = BoundOf(Rows(), "knee", "flexion", 5 * kDegree);
  EXPECT_NEAR(bound.At(0.0, Load::kUnknown).low_rad, 120 * kDegree, 1e-12);
  EXPECT_NEAR(bound.At(0.0, Load::kUnknown).high_rad, 155 * kDegree, 1e-12);
}

TEST(Bound, KnowsItsOutermost) {
  EXPECT_NEAR(BoundOf(Rows(), "hip", "adduction", 0.0).Outermost_rad(), 30 * kDegree, 1e-12);
  EXPECT_NEAR(BoundOf(Rows(), "ankle", "plantar_flexion", 0.0).Outermost_rad(), 50 * kDegree,
              1e-12);
}

TEST(Bound, NamesJointAndMotionWithoutARow) {
  try {
    BoundOf(Rows(), "elbow", "eversion", 0.0);
    FAIL();
  } catch (const config::ConfigError& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("'elbow'"));
    EXPECT_THAT(error.what(), testing::HasSubstr("'eversion'"));
  }
}

}  // namespace
}  // namespace deixis::range_of_motion
