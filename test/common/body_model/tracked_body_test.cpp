#include "common/body_model/tracked_body.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <random>

#include "test/common/body_model/body_samples.h"

namespace deixis::body_model {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

class PlacedBody : public testing::Test {
 protected:
  PlacedBody() { body_.pose = RandomPose(model_, random_); }

  LimbPose& Limb(const std::string& name) {
    return body_.limbs[static_cast<std::size_t>(*model_.Find(name))];
  }

  std::mt19937 random_{3};
  const BodyModel model_{"sample", ArmAndHead()};
  Kinematics kinematics_{model_};
  TrackedBody body_;
};

TEST_F(PlacedBody, HasItsLimbsWhereKinematicsSay) {
  PlaceLimbs(kinematics_, body_);
  EXPECT_EQ(body_.model_id, model_.id());
  ASSERT_EQ(body_.limbs.size(), model_.limbs().size());
  Kinematics own(model_);
  own.Update(body_.pose);
  for (int i = 0; i < model_.limb_count(); ++i) {
    const LimbPose& limb = body_.limbs[static_cast<std::size_t>(i)];
    const Vector3d point_m(0.01, -0.02, 0.2);
    EXPECT_LE((limb.frame_from_limb * point_m - own.limb(i) * point_m).norm(), 1e-12) << i;
    EXPECT_EQ(limb.proximal_m, own.proximal_m(i));
    EXPECT_EQ(limb.distal_m, own.distal_m(i));
  }
}

TEST_F(PlacedBody, HasLimbsInTheirParentsThatChainToTheFrame) {
  PlaceLimbs(kinematics_, body_);
  for (int i = 0; i < model_.limb_count(); ++i) {
    const LimbPose& limb = body_.limbs[static_cast<std::size_t>(i)];
    const int parent = model_.limbs()[static_cast<std::size_t>(i)].parent;
    const auto chained =
        parent < 0
            ? limb.parent_from_limb
            : body_.limbs[static_cast<std::size_t>(parent)].frame_from_limb * limb.parent_from_limb;
    EXPECT_LE((chained.translation_m - limb.frame_from_limb.translation_m).norm(), 1e-12) << i;
    EXPECT_LE(chained.rotation.angularDistance(limb.frame_from_limb.rotation), 1e-7) << i;
  }
}

TEST_F(PlacedBody, IsAsUncertainEverywhereAsWhereItsRootIs) {
  Matrix3d root_m2;
  root_m2 << 4, 1, 0, 1, 3, -1, 0, -1, 2;
  body_.covariance.setZero(6 + model_.angle_count(), 6 + model_.angle_count());
  body_.covariance.topLeftCorner<3, 3>() = root_m2;
  PlaceLimbs(kinematics_, body_);
  for (const LimbPose& limb : body_.limbs) {
    EXPECT_LE((limb.proximal_covariance_m2 - root_m2).norm(), 1e-12);
    EXPECT_LE((limb.distal_covariance_m2 - root_m2).norm(), 1e-12);
  }
}

TEST_F(PlacedBody, IsUncertainBeyondAJointAcrossItsAxis) {
  const int elbow = model_.first_angle(*model_.Find("lower_arm"));
  body_.covariance.setZero(6 + model_.angle_count(), 6 + model_.angle_count());
  body_.covariance(6 + elbow, 6 + elbow) = 0.04;
  PlaceLimbs(kinematics_, body_);
  const LimbPose& arm = Limb("lower_arm");
  EXPECT_LE(arm.proximal_covariance_m2.norm(), 1e-15);
  EXPECT_LE(Limb("head").distal_covariance_m2.norm(), 1e-15);
  const Vector3d moves_m =
      kinematics_.angle_axis(elbow).cross(Vector3d(arm.distal_m - arm.proximal_m));
  const Matrix3d expected_m2 = 0.04 * moves_m * moves_m.transpose();
  EXPECT_GT(expected_m2.norm(), 1e-3);
  EXPECT_LE((arm.distal_covariance_m2 - expected_m2).norm(), 1e-12);
}

TEST_F(PlacedBody, KeepsWhatItsLimbsRestOn) {
  PlaceLimbs(kinematics_, body_);
  EXPECT_EQ(Limb("hand").state, LimbState::kLost);
  Limb("hand").state = LimbState::kMeasured;
  Limb("hand").inlier_count = 40;
  PlaceLimbs(kinematics_, body_);
  EXPECT_EQ(Limb("hand").state, LimbState::kMeasured);
  EXPECT_EQ(Limb("hand").inlier_count, 40);
}

TEST_F(PlacedBody, RefusesACovarianceOfAnotherModel) {
  body_.covariance.setIdentity(6, 6);
  EXPECT_THROW(PlaceLimbs(kinematics_, body_), std::logic_error);
}

}  // namespace
}  // namespace deixis::body_model
