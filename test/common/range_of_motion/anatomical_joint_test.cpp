// Anatomical angles of every joint of the shipped ranges, on either side.
#include "common/range_of_motion/anatomical_joint.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "common/config/config.h"
#include "test/common/range_of_motion/range_samples.h"

namespace deixis::range_of_motion {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

const JointPlan& PlanOf(const std::string& joint) {
  const auto& joints = ShippedRanges().joints;
  return *std::find_if(joints.begin(), joints.end(),
                       [&joint](const JointPlan& plan) { return plan.joint == joint; });
}

AnatomicalJoint Joint(const std::string& joint, BodySide side, Limits limits = Limits::kSource) {
  return {PlanOf(joint), side, ShippedRows(), limits};
}

std::vector<std::string> JointNames() {
  std::vector<std::string> names;
  for (const JointPlan& plan : ShippedRanges().joints) names.push_back(plan.joint);
  return names;
}

class EveryJoint : public testing::TestWithParam<std::string> {};

TEST_P(EveryJoint, HasAnglesOfZeroInTheNeutralStance) {
  for (const BodySide side : {BodySide::kRight, BodySide::kLeft}) {
    const AnatomicalJoint joint = Joint(GetParam(), side);
    const AnatomicalAngles angles = joint.Measure(joint.Orientation(AnatomicalAngles::Zero()));
    EXPECT_NEAR(angles[0], 0.0, 1e-9);
    EXPECT_NEAR(angles[2], 0.0, 1e-9);
  }
}

TEST_P(EveryJoint, TakesAnglesToAnOrientationAndBack) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> wide(-1.2, 1.2);
  for (const BodySide side : {BodySide::kRight, BodySide::kLeft}) {
    const AnatomicalJoint joint = Joint(GetParam(), side);
    for (int i = 0; i < 200; ++i) {
      AnatomicalAngles angles = AnatomicalAngles::Zero();
      for (std::size_t k = 0; k < joint.angle_names().size(); ++k) {
        angles[static_cast<Eigen::Index>(k)] = wide(random);
      }
      if (!joint.reach().empty()) angles[0] = std::abs(angles[0]) + 0.01;
      EXPECT_LT((joint.Measure(joint.Orientation(angles)) - angles).norm(), 1e-9)
          << angles.transpose();
    }
  }
}

TEST_P(EveryJoint, MeasuresMirroredLimbsAlike) {
  const Matrix3d mirror = Vector3d(1, -1, 1).asDiagonal();
  const AnatomicalJoint right = Joint(GetParam(), BodySide::kRight);
  const AnatomicalJoint left = Joint(GetParam(), BodySide::kLeft);
  std::mt19937 random(6);
  std::uniform_real_distribution<double> wide(-1.0, 1.0);
  for (int i = 0; i < 50; ++i) {
    AnatomicalAngles angles(std::abs(wide(random)) + 0.1, wide(random), wide(random));
    if (right.angle_names().size() < 3) angles[2] = 0.0;
    // A mirror makes axes left-handed: y is turned back.
    const Matrix3d turned = right.Orientation(angles);
    EXPECT_LT((mirror * turned * mirror - left.Orientation(angles)).norm(), 1e-9);
  }
}

INSTANTIATE_TEST_SUITE_P(OfTheBody, EveryJoint, testing::ValuesIn(JointNames()));

/// A row of the source and how its motion is made: one angle alone.
struct PureMotion {
  std::string joint, motion;
  int angle;
  double sign;
  double flexion_deg;
  double limit_deg;
};

std::ostream& operator<<(std::ostream& out, const PureMotion& motion) {
  return out << motion.joint << " " << motion.motion;
}

class EveryMotion : public testing::TestWithParam<PureMotion> {};

AnatomicalAngles AnglesOf(const PureMotion& motion, double degrees) {
  AnatomicalAngles angles(motion.flexion_deg * kDegree, 0.0, 0.0);
  angles[motion.angle] = motion.sign * degrees * kDegree;
  return angles;
}

const Margin* Find(const Margins& margins, const std::string& motion) {
  for (int i = 0; i < margins.count; ++i) {
    const Margin& margin = margins.each[static_cast<std::size_t>(i)];
    if (*margin.motion == motion) return &margin;
  }
  return nullptr;
}

TEST_P(EveryMotion, IsPossibleUpToItsRowAndNotBeyond) {
  const PureMotion& motion = GetParam();
  for (const BodySide side : {BodySide::kRight, BodySide::kLeft}) {
    const AnatomicalJoint joint = Joint(motion.joint, side);
    const auto margin_deg = [&](double degrees) {
      const Margins margins =
          joint.Check(joint.Measure(joint.Orientation(AnglesOf(motion, degrees))), Load::kUnknown);
      const Margin* margin = Find(margins, motion.motion);
      return margin == nullptr ? -1e9 : margin->margin_rad / kDegree;
    };
    EXPECT_NEAR(margin_deg(motion.limit_deg - 2.0), 2.0, 1e-6);
    EXPECT_NEAR(margin_deg(motion.limit_deg + 2.0), -2.0, 1e-6);
  }
}

INSTANTIATE_TEST_SUITE_P(
    OfTheSource, EveryMotion,
    testing::Values(
        PureMotion{"cervical_spine", "lateral_flexion", 1, 1, 0, 35},
        PureMotion{"cervical_spine", "lateral_flexion", 1, -1, 0, 35},
        PureMotion{"cervical_spine", "ventral_flexion", 0, 1, 0, 65},
        PureMotion{"cervical_spine", "dorsal_flexion", 0, -1, 0, 40},
        PureMotion{"cervical_spine", "rotation", 2, 1, 0, 50},
        PureMotion{"thoracolumbar_spine", "lateral_flexion", 1, -1, 0, 40},
        PureMotion{"thoracolumbar_spine", "ventral_flexion", 0, 1, 0, 85},
        PureMotion{"thoracolumbar_spine", "dorsal_flexion", 0, -1, 0, 60},
        PureMotion{"thoracolumbar_spine", "rotation", 2, -1, 0, 40},
        PureMotion{"shoulder", "inside_rotation", 2, 1, 45, 100},
        PureMotion{"shoulder", "outside_rotation", 2, -1, 45, 90},
        PureMotion{"elbow", "flexion", 0, 1, 0, 150},
        PureMotion{"elbow", "extension", 0, -1, 0, 10},
        PureMotion{"elbow", "pronation", 1, 1, 90, 90},
        PureMotion{"elbow", "supination", 1, -1, 90, 90},
        PureMotion{"wrist", "palmar_flexion", 0, 1, 0, 80},
        PureMotion{"wrist", "dorsal_extension", 0, -1, 0, 60},
        PureMotion{"wrist", "radial_abduction", 1, 1, 0, 20},
        PureMotion{"wrist", "ulnar_abduction", 1, -1, 0, 40},
        PureMotion{"hip", "flexion", 0, 1, 0, 140}, PureMotion{"hip", "extension", 0, -1, 0, 20},
        PureMotion{"hip", "abduction", 1, 1, 0, 50}, PureMotion{"hip", "abduction", 1, 1, 90, 80},
        PureMotion{"hip", "adduction", 1, -1, 0, 30}, PureMotion{"hip", "adduction", 1, -1, 90, 20},
        PureMotion{"hip", "inside_rotation", 2, 1, 0, 40},
        PureMotion{"hip", "outside_rotation", 2, -1, 0, 30},
        PureMotion{"hip", "outside_rotation", 2, -1, 90, 50},
        PureMotion{"knee", "flexion", 0, 1, 0, 150}, PureMotion{"knee", "extension", 0, -1, 0, 10},
        PureMotion{"knee", "inside_rotation", 1, 1, 90, 10},
        PureMotion{"knee", "outside_rotation", 1, -1, 90, 40},
        PureMotion{"ankle", "dorsal_extension", 0, 1, 0, 50},
        PureMotion{"ankle", "plantar_flexion", 0, -1, 0, 50},
        PureMotion{"ankle", "inversion", 1, 1, 0, 20},
        PureMotion{"ankle", "eversion", 1, -1, 0, 10}));

/// The shoulder's rows: elevation in a plane, degrees.
struct Elevation {
  std::string motion;
  double plane_deg;
  double limit_deg;
};

std::ostream& operator<<(std::ostream& out, const Elevation& elevation) {
  return out << elevation.motion;
}

class EveryElevation : public testing::TestWithParam<Elevation> {};

TEST_P(EveryElevation, EndsAtItsRow) {
  const auto& [motion, plane_deg, limit_deg] = GetParam();
  for (const BodySide side : {BodySide::kRight, BodySide::kLeft}) {
    const AnatomicalJoint joint = Joint("shoulder", side);
    const Margin at =
        joint.Check(AnatomicalAngles(limit_deg * kDegree, plane_deg * kDegree, 0.0)).each[0];
    EXPECT_NEAR(at.margin_rad, 0.0, 1e-6);
    EXPECT_EQ(*at.motion, motion);
    const auto margin_at = [&](double elevation_deg) {
      return joint.Check(AnatomicalAngles(elevation_deg * kDegree, plane_deg * kDegree, 0.0))
          .each[0]
          .margin_rad;
    };
    EXPECT_GT(margin_at(limit_deg - 3.0), 0.0);
    // Straight up is reached by abduction; beyond 170 degrees of flexion lies the way there.
    EXPECT_LT(margin_at(limit_deg + (motion == "flexion" ? 15.0 : 3.0)), 0.0);
  }
}

INSTANTIATE_TEST_SUITE_P(OfTheSource, EveryElevation,
                         testing::Values(Elevation{"flexion", 0, 170},
                                         Elevation{"abduction", 90, 180},
                                         Elevation{"extension", 180, 40},
                                         Elevation{"adduction", -90, 40}));

TEST(AnatomicalJoint, RefusesAKnotAlongTheNeutralLimb) {
  for (JointPlan joint : ShippedRanges().joints) {
    if (joint.joint != "shoulder") continue;
    joint.reach.knots[1].towards = {0.0, 0.0, 2.0};
    EXPECT_THROW(AnatomicalJoint(joint, BodySide::kRight, ShippedRows(), Limits::kSource),
                 config::ConfigError);
  }
}

TEST(AnatomicalJoint, AllowsMoreByDefaultWhereItsPlanSaysSo) {
  JointPlan plan = PlanOf("elbow");
  plan.allowed_beyond = {{"flexion", 7.0, "a test"}};
  const AnatomicalAngles bent(155 * kDegree, 0.0, 0.0);
  const AnatomicalJoint source(plan, BodySide::kRight, ShippedRows(), Limits::kSource);
  const AnatomicalJoint wide(plan, BodySide::kRight, ShippedRows(), Limits::kDefault);
  EXPECT_NEAR(source.Check(bent).each[0].margin_rad, -5 * kDegree, 1e-9);
  EXPECT_NEAR(wide.Check(bent).each[0].margin_rad, 2 * kDegree, 1e-9);
}

}  // namespace
}  // namespace deixis::range_of_motion
