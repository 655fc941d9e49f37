#include "services/pose_fitter/trainer/clothed_plan.h"

#include <gtest/gtest.h>

#include "common/body_model/joint_angles.h"
#include "common/body_model/kinematics.h"
#include "test/services/pose_fitter/trainer/standing_person.h"

namespace deixis::pose_fitter {
namespace {

using body_model::BodyModel;

Eigen::Vector3d Joint(const BodyModel& model, const std::string& limb) {
  body_model::Kinematics kinematics(model);
  kinematics.Update(body_model::Standing(model));
  return kinematics.proximal_m(model.Find(limb).value());
}

TEST(ClothedPlan, PutsTheJointsWhereTheUprightPersonHasThem) {
  const BodyModel somebody = Build(StartPlan(), TallSizes());
  const Lengths lengths = JointTree(StandingPerson(somebody), 0);
  const BodyModel made = Build(WithLengths(StartPlan(), lengths), TallSizes());
  for (const char* limb : {"abdomen", "neck", "right_upper_arm", "left_lower_arm", "right_hand",
                           "right_thigh", "left_shank", "left_foot"}) {
    const Eigen::Vector3d from_hips = Joint(made, limb) - Joint(made, "right_thigh");
    const Eigen::Vector3d wanted = Joint(somebody, limb) - Joint(somebody, "right_thigh");
    EXPECT_LT((from_hips - wanted).norm(), 1e-6) << limb;
  }
  EXPECT_LT((Joint(made, "head") - Joint(made, "neck") -
             (Joint(somebody, "head") - Joint(somebody, "neck")))
                .norm(),
            1e-6);
}

TEST(ClothedPlan, TakesLengthsForThoseOfThePlan) {
  const auto changed = WithLengths(StartPlan(), {{"thigh.length", 0.456}});
  const BodyModel made = Build(changed, TallSizes());
  const auto thigh = static_cast<std::size_t>(made.Find("left_thigh").value());
  EXPECT_EQ(made.limbs()[thigh].shape.length_m, 0.456);
}

TEST(ClothedPlan, KeepsAllAnglesOfTheDetailedBody) {
  const auto detailed =
      body_model::LoadBodyPlan(DEIXIS_SOURCE_DIR "/config/body_models/whole_body_detailed.yaml");
  const BodyModel before = Build(detailed, TallSizes());
  const BodyModel clothed = Build(StartPlan(), TallSizes());
  EXPECT_EQ(clothed.angle_count(), before.angle_count());
  for (const body_model::Limb& limb : before.limbs()) {
    const auto index = static_cast<std::size_t>(clothed.Find(limb.name).value());
    EXPECT_EQ(clothed.limbs()[index].dofs.size(), limb.dofs.size()) << limb.name;
  }
}

}  // namespace
}  // namespace deixis::pose_fitter
