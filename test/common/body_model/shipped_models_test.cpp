// The models of config/body_models, with the sizes of people of config/kinematics.
#include <gmock/gmock.h>

#include <array>
#include <cmath>
#include <tuple>

#include "common/body_model/joint_angles.h"
#include "common/body_model/kinematics.h"
#include "test/common/body_model/body_samples.h"

namespace deixis::body_model {
namespace {

using Eigen::Vector3d;

class ShippedModels : public testing::TestWithParam<Person> {};

/// Both with the limbs of a detailed body.
class DetailedModels : public testing::TestWithParam<std::tuple<Person, const char*>> {
 protected:
  BodyModel Model() const { return Shipped(std::get<1>(GetParam()), std::get<0>(GetParam())); }
};

TEST_P(ShippedModels, HaveTheLimbsAndAnglesOfTheirSources) {
  EXPECT_EQ(Shipped("upper_body", GetParam()).limb_count(), 6);
  EXPECT_EQ(Shipped("whole_body", GetParam()).limb_count(), 10);
  EXPECT_EQ(Shipped("whole_body_detailed", GetParam()).limb_count(), 19);
  const BodyModel clothed = Shipped("clothed_body", GetParam());
  EXPECT_EQ(clothed.limb_count(), 24);
  EXPECT_EQ(clothed.angle_count(), Shipped("whole_body_detailed", GetParam()).angle_count());
  const BodyModel arm = Shipped("right_arm", GetParam());
  EXPECT_EQ(6 + arm.angle_count(), 10);
  EXPECT_TRUE(arm.limbs()[static_cast<std::size_t>(*arm.Find("right_hand"))].dofs.empty());
  EXPECT_TRUE(arm.limbs()[static_cast<std::size_t>(*arm.Find("head"))].dofs.empty());
}

TEST_P(DetailedModels, StandUprightWithHangingArms) {
  const BodyModel model = Model();
  Kinematics kinematics(model);
  kinematics.Update(Standing(model));
  for (const char* limb : {"right_upper_arm", "left_lower_arm", "right_thigh", "left_shank"}) {
    const Vector3d along = kinematics.limb(*model.Find(limb)).linear().col(2);
    EXPECT_LE((along + Vector3d::UnitZ()).norm(), 1e-9) << limb;
  }
}

TEST_P(ShippedModels, AreAsTallAsThePerson) {
  const BodyModel model = Shipped("whole_body_detailed", GetParam());
  Kinematics kinematics(model);
  kinematics.Update(Standing(model));
  const int foot = *model.Find("right_foot"), head = *model.Find("head");
  const auto& sole = model.limbs()[static_cast<std::size_t>(foot)].shape;
  const Vector3d under_foot =
      kinematics.limb(foot) * Vector3d(sole.centre0_m.x() - sole.a0_m, 0.0, 0.0);
  EXPECT_NEAR(kinematics.distal_m(head).z() - under_foot.z(), GetParam().stature_m, 0.03);
}

TEST_P(ShippedModels, AreAsTallAsThePersonInShoesAndHairToo) {
  const BodyModel model = Shipped("clothed_body", GetParam());
  Kinematics kinematics(model);
  kinematics.Update(Standing(model));
  const int foot = *model.Find("right_foot"), top = *model.Find("skull_cap");
  const auto& sole = model.limbs()[static_cast<std::size_t>(foot)].shape;
  const Vector3d under_foot =
      kinematics.limb(foot) * Vector3d(sole.centre0_m.x() - sole.a0_m, 0.0, 0.0);
  EXPECT_NEAR(kinematics.distal_m(top).z() - under_foot.z(), GetParam().stature_m, 0.06);
}

TEST_P(ShippedModels, SpreadTheirArmsAsFarAsPeopleDo) {
  const BodyModel model = Shipped("whole_body_detailed", GetParam());
  BodyPose pose = RestPose(model);
  PointLimb(model, *model.Find("right_upper_arm"), -Vector3d::UnitY(), pose);
  PointLimb(model, *model.Find("left_upper_arm"), Vector3d::UnitY(), pose);
  Kinematics kinematics(model);
  kinematics.Update(pose);
  const double span_m = (kinematics.distal_m(*model.Find("right_hand")) -
                         kinematics.distal_m(*model.Find("left_hand")))
                            .norm();
  EXPECT_NEAR(span_m, GetParam().stature_m, 0.05);
}

TEST_P(DetailedModels, AreMirrorImages) {
  const BodyModel model = Model();
  Kinematics kinematics(model);
  kinematics.Update(Standing(model));
  for (const char* limb :
       {"clavicle", "upper_arm", "lower_arm", "hand", "thigh", "shank", "foot"}) {
    const Vector3d right = kinematics.distal_m(*model.Find(std::string("right_") + limb));
    const Vector3d left = kinematics.distal_m(*model.Find(std::string("left_") + limb));
    EXPECT_LE((right - Vector3d(left.x(), -left.y(), left.z())).norm(), 1e-9) << limb;
  }
}

TEST_P(DetailedModels, BendAsPeopleDoWhenTheirAnglesGrow) {
  const BodyModel model = Model();
  const auto moved = [&](const std::string& limb, int dof, const std::string& end) {
    BodyPose pose = Standing(model);
    Kinematics kinematics(model);
    kinematics.Update(pose);
    const Vector3d before = kinematics.distal_m(*model.Find(end));
    pose.angles_rad[model.first_angle(*model.Find(limb)) + dof] += 0.5;
    kinematics.Update(pose);
    return Vector3d(kinematics.distal_m(*model.Find(end)) - before);
  };
  EXPECT_GT(moved("chest", 1, "head").x(), 0.1);                  // Flexion bends forward.
  EXPECT_LT(moved("chest", 0, "head").y(), -0.1);                 // Lateral: to the right.
  EXPECT_GT(moved("right_lower_arm", 0, "right_hand").x(), 0.1);  // The elbow, forward.
  EXPECT_GT(moved("left_lower_arm", 0, "left_hand").x(), 0.1);
  EXPECT_GT(moved("right_hand", 0, "right_hand").y(), 0.05);  // Palmar: to the thigh.
  EXPECT_LT(moved("left_hand", 0, "left_hand").y(), -0.05);
  EXPECT_GT(moved("right_hand", 1, "right_hand").x(), 0.05);    // Radial: to the thumb.
  EXPECT_GT(moved("right_thigh", 0, "right_shank").x(), 0.2);   // The hip, forward.
  EXPECT_LT(moved("right_thigh", 1, "right_shank").y(), -0.2);  // Abduction: outward.
  EXPECT_GT(moved("left_thigh", 1, "left_shank").y(), 0.2);
  EXPECT_LT(moved("right_shank", 0, "right_foot").x(), -0.05);         // The knee, backward.
  EXPECT_GT(moved("left_foot", 0, "left_foot").z(), 0.05);             // Toes up.
  EXPECT_GT(moved("right_clavicle", 0, "right_upper_arm").z(), 0.05);  // The shoulder, up.
  EXPECT_GT(moved("right_clavicle", 1, "right_upper_arm").x(), 0.05);  // And forward.
}

TEST_P(ShippedModels, HaveJacobiansThatAreDerivatives) {
  std::mt19937 random(8);
  for (const char* name :
       {"upper_body", "whole_body", "whole_body_detailed", "clothed_body", "right_arm"}) {
    const BodyModel model = Shipped(name, GetParam());
    for (int i = 0; i < 3; ++i) ExpectDerivatives(model, RandomPose(model, random));
  }
}

INSTANTIATE_TEST_SUITE_P(People, ShippedModels, testing::ValuesIn(FourPeople()));
INSTANTIATE_TEST_SUITE_P(People, DetailedModels,
                         testing::Combine(testing::ValuesIn(FourPeople()),
                                          testing::Values("whole_body_detailed", "clothed_body")));

}  // namespace
}  // namespace deixis::body_model
