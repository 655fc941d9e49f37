#include "services/pose_fitter/core/shape/shape_parameters.h"

#include <gtest/gtest.h>

#include "test/services/pose_fitter/shape/seen_person.h"

namespace deixis::pose_fitter {
namespace {

using body_model::BodyModel;
using Eigen::VectorXd;

const body_model::Limb& LimbOf(const BodyModel& model, const std::string& name) {
  return model.limbs()[static_cast<std::size_t>(model.Find(name).value())];
}

TEST(ShapeParameters, ChangeNothingWithZeros) {
  const ShapeParameters parameters = ClothedPerson(1.7, 0.01);
  EXPECT_EQ(parameters.Apply(VectorXd::Zero(parameters.count())).id(), parameters.model().id());
}

TEST(ShapeParameters, MoveTheJointsWithTheLimbsLengths) {
  const ShapeParameters parameters = ClothedPerson(1.7, 0.01);
  VectorXd values = VectorXd::Zero(parameters.count());
  values[parameters.Find("thigh_length")] = 0.1;
  const BodyModel longer = parameters.Apply(values);
  const double before_m = LimbOf(parameters.model(), "left_thigh").shape.length_m;
  EXPECT_NEAR(LimbOf(longer, "left_thigh").shape.length_m, 1.1 * before_m, 1e-9);
  EXPECT_NEAR(LimbOf(longer, "left_shank").rest_in_parent.translation_m.z(), 1.1 * before_m, 1e-9);
  EXPECT_EQ(LimbOf(longer, "left_thigh").shape.a0_m,
            LimbOf(parameters.model(), "left_thigh").shape.a0_m);
}

TEST(ShapeParameters, LetAllGrowWithTheStature) {
  const ShapeParameters parameters = ClothedPerson(1.7, 0.01);
  VectorXd values = VectorXd::Zero(parameters.count());
  values[parameters.Find("stature")] = 0.05;
  const BodyModel taller = parameters.Apply(values);
  for (int i = 0; i < taller.limb_count(); ++i) {
    const auto& limb = taller.limbs()[static_cast<std::size_t>(i)];
    const auto& before = parameters.model().limbs()[static_cast<std::size_t>(i)];
    EXPECT_NEAR(limb.shape.length_m, 1.05 * before.shape.length_m, 1e-9) << limb.name;
    EXPECT_NEAR(limb.shape.b1_m, 1.05 * before.shape.b1_m, 1e-9) << limb.name;
    EXPECT_TRUE(limb.rest_in_parent.translation_m.isApprox(
                    1.05 * before.rest_in_parent.translation_m, 1e-9) ||
                limb.rest_in_parent.translation_m.norm() < 1e-9)
        << limb.name;
  }
}

TEST(ShapeParameters, AreAsSureOfTheStatureAsTheEstimate) {
  const ShapeParameters known = ClothedPerson(1.7, 0.005), guessed = ClothedPerson(1.7, 0.05);
  EXPECT_NEAR(known.all()[0].sigma, 0.005 / 1.7, 5e-4);
  EXPECT_GT(guessed.all()[0].sigma, 4.0 * known.all()[0].sigma);
}

TEST(ShapeParameters, HaveSpreadsOfThePlanAndOfMeasures) {
  const ShapeParameters parameters = ClothedPerson(1.7, 0.01);
  for (const ShapeParameter& parameter : parameters.all()) {
    EXPECT_GT(parameter.sigma, 0.0) << parameter.name;
    EXPECT_LT(parameter.sigma, parameter.is_offset ? 0.05 : 0.25) << parameter.name;
  }
  EXPECT_GT(parameters.all()[static_cast<std::size_t>(parameters.Find("trunk_depth"))].sigma,
            parameters.all()[static_cast<std::size_t>(parameters.Find("upper_arm_length"))].sigma);
}

}  // namespace
}  // namespace deixis::pose_fitter
