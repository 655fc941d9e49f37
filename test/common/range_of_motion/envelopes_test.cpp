// The envelopes of config/body_models against the limits of config/kinematics.
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>

#include "common/body_model/joint_angles.h"
#include "common/range_of_motion/range_of_motion.h"
#include "test/common/range_of_motion/range_samples.h"

namespace deixis::range_of_motion {
namespace {

using body_model::BodyModel;
using body_model::Limb;
using Eigen::Matrix3d;
using Eigen::VectorXd;

constexpr double kStep_deg = 4.0;

bool IsPossible(const AnatomicalJoint& joint, const AnatomicalAngles& angles) {
  const Margins margins = joint.Check(angles);
  return std::all_of(margins.each.begin(), margins.each.begin() + margins.count,
                     [](const Margin& margin) { return margin.margin_rad >= -1e-9; });
}

/// Calls `see` with every possible pair of angles, the third one 0; with a reach cone any
/// direction and rotation. No joint takes three angles to their ends at once.
template <typename See>
void ForEachPair(const AnatomicalJoint& joint, See see) {
  const auto count = static_cast<int>(joint.angle_names().size());
  const auto steps = static_cast<int>(360.0 / kStep_deg);
  for (int zero = 0; zero < 3; ++zero) {
    for (int i = 0; i <= steps; ++i) {
      for (int k = 0; k <= steps; ++k) {
        AnatomicalAngles angles = AnatomicalAngles::Zero();
        angles[(zero + 1) % 3] = (-180.0 + kStep_deg * i) * kDegree;
        angles[(zero + 2) % 3] = (-180.0 + kStep_deg * k) * kDegree;
        for (int n = count; n < 3; ++n) angles[n] = 0.0;
        if (!joint.reach().empty()) angles[0] = std::abs(angles[0]);
        if (IsPossible(joint, angles)) see(angles);
      }
    }
  }
}

const Limb& LimbAt(const BodyModel& model, int limb) {
  return model.limbs()[static_cast<std::size_t>(limb)];
}

/// The last limb's angles with which it alone makes the joint's, the others at rest.
VectorXd AnglesAlone(const BodyModel& model, const ModelJoint& joint,
                     const AnatomicalAngles& angles) {
  Matrix3d between = Matrix3d::Identity();
  for (int i = LimbAt(model, joint.limb).parent; i != joint.parent; i = LimbAt(model, i).parent) {
    between = LimbAt(model, i).rest_in_parent.rotation.toRotationMatrix() * between;
  }
  return JointAngles(LimbAt(model, joint.limb),
                     between.transpose() * joint.joint.Orientation(angles));
}

double ShareOf(const Limb& limb, const ModelJoint& joint) {
  for (const JointPlan& plan : ShippedRanges().joints) {
    if (plan.joint != joint.joint.joint()) continue;
    for (const LimbShare& share : plan.limbs) {
      const auto at = limb.name.rfind(share.limb);
      if (at != std::string::npos && at + share.limb.size() == limb.name.size()) {
        return share.share;
      }
    }
  }
  return 0.0;
}

class Envelopes : public testing::TestWithParam<std::string> {};

TEST_P(Envelopes, HoldEveryPossiblePairOfAnglesAndHardlyMore) {
  const BodyModel model = ShippedBody(GetParam());
  const RangeOfMotion ranges(model, ShippedRanges(), ShippedRows());
  for (const ModelJoint& joint : ranges.joints()) {
    const Limb& limb = LimbAt(model, joint.limb);
    const auto count = static_cast<Eigen::Index>(limb.dofs.size());
    if (count == 0) continue;
    VectorXd least = VectorXd::Constant(count, 10.0), most = -least;
    ForEachPair(joint.joint, [&](const AnatomicalAngles& angles) {
      const VectorXd alone = AnglesAlone(model, joint, angles);
      least = least.cwiseMin(alone);
      most = most.cwiseMax(alone);
    });
    const bool is_alone = LimbAt(model, joint.limb).parent == joint.parent;
    const double share = is_alone ? 1.0 : ShareOf(limb, joint);
    for (Eigen::Index k = 0; k < count; ++k) {
      const auto& dof = limb.dofs[static_cast<std::size_t>(k)];
      EXPECT_LE(dof.angle_min_rad, share * least[k] + 0.01) << limb.name << " " << dof.name;
      EXPECT_GE(dof.angle_max_rad, share * most[k] - 0.01) << limb.name << " " << dof.name;
      // What the grid skips, and a stretched hinge that goes the other way.
      EXPECT_GE(dof.angle_min_rad, share * least[k] - 12.0 * kDegree) << limb.name << dof.name;
      EXPECT_LE(dof.angle_max_rad, share * most[k] + 8.0 * kDegree) << limb.name << dof.name;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(OfTheShipped, Envelopes,
                         testing::Values("upper_body", "whole_body", "whole_body_detailed",
                                         "clothed_body", "right_arm"));

TEST(Envelopes, OfTheLimbsOfASpineAreAlike) {
  const BodyModel model = ShippedBody("whole_body_detailed");
  for (const auto& [one, other] : {std::pair{"abdomen", "chest"}, std::pair{"neck", "head"}}) {
    const auto& first = LimbAt(model, *model.Find(one)).dofs;
    const auto& second = LimbAt(model, *model.Find(other)).dofs;
    for (std::size_t k = 0; k < first.size(); ++k) {
      EXPECT_EQ(first[k].angle_min_rad, second[k].angle_min_rad);
      EXPECT_EQ(first[k].angle_max_rad, second[k].angle_max_rad);
    }
  }
}

}  // namespace
}  // namespace deixis::range_of_motion
