#include "common/body_model/body_model.h"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>

#include "common/config/config.h"
#include "test/common/body_model/body_samples.h"

namespace deixis::body_model {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;

TEST(BodyModel, KnowsItsTreeAndItsAngles) {
  const BodyModel model("sample", ArmAndHead());
  EXPECT_EQ(model.limb_count(), 5);
  EXPECT_EQ(model.angle_count(), 7);
  EXPECT_EQ(model.first_angle(3), 5);
  EXPECT_THAT(model.children(0), ElementsAre(1, 4));
  EXPECT_EQ(model.Find("hand"), 3);
  EXPECT_EQ(model.Find("tail"), std::nullopt);
}

TEST(BodyModel, IdFollowsTheContentAndNothingElse) {
  const BodyModel model("sample", ArmAndHead());
  EXPECT_NE(model.id(), 0);
  EXPECT_EQ(model.id(), BodyModel("sample", ArmAndHead()).id());
  EXPECT_NE(model.id(), BodyModel("other", ArmAndHead()).id());
  const auto changed = [](const std::function<void(std::vector<Limb>&)>& change) {
    std::vector<Limb> limbs = ArmAndHead();
    change(limbs);
    return BodyModel("sample", limbs).id();
  };
  EXPECT_NE(model.id(), changed([](auto& limbs) { limbs[4].shape.b1_m += 1e-9; }));
  EXPECT_NE(model.id(), changed([](auto& limbs) { limbs[1].dofs[2].angle_max_rad += 1e-9; }));
  EXPECT_NE(model.id(),
            changed([](auto& limbs) { limbs[1].rest_in_parent.translation_m.z() = 0; }));
  EXPECT_NE(model.id(), changed([](auto& limbs) { limbs[2].shape.centre1_m.y() = 1e-9; }));
}

TEST(BodyModel, RestsWithinItsEnvelope) {
  std::vector<Limb> limbs = ArmAndHead();
  limbs[2].dofs[0].angle_min_rad = 0.3;
  const BodyPose pose = RestPose(BodyModel("sample", limbs));
  EXPECT_EQ(pose.angles_rad[3], 0.3);
  EXPECT_EQ(pose.angles_rad[0], 0.0);
}

/// One way to break a body, and what is said about it.
struct Fault {
  std::function<void(std::vector<Limb>&)> break_it;
  std::string says;
};

TEST(BodyModel, RefusesWhatIsNoBodyAndNamesTheLimb) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const std::vector<Fault> faults{
      {[](auto& limbs) { limbs.clear(); }, "at least one limb"},
      {[](auto& limbs) { limbs[0].parent = 1; }, "'trunk': is the first one"},
      {[](auto& limbs) { limbs[2].parent = -1; }, "'lower_arm': parent must be"},
      {[](auto& limbs) { limbs[2].parent = 2; }, "'lower_arm': parent must be"},
      {[](auto& limbs) { limbs[4].name = "hand"; }, "'hand': occurs twice"},
      {[](auto& limbs) { limbs[4].name = ""; }, "limb 4 has no name"},
      {[](auto& limbs) { limbs[1].shape.a0_m = 0.0; }, "'upper_arm': proximal.a is 0.0"},
      {[](auto& limbs) { limbs[1].shape.length_m = -0.3; }, "'upper_arm': length is -0.3"},
      {[](auto& limbs) { limbs[1].shape.length_m = 3.1; }, "'upper_arm': length is 3.1"},
      {[nan](auto& limbs) { limbs[1].shape.b1_m = nan; }, "'upper_arm': distal.b is nan"},
      {[nan](auto& limbs) { limbs[1].shape.centre1_m.x() = nan; }, "distal must lie"},
      {[](auto& limbs) { limbs[1].rest_in_parent.translation_m.z() = 4.0; }, "origin must lie"},
      {[](auto& limbs) { limbs[1].rest_in_parent.rotation.w() = 3.0; }, "rest must be a rotation"},
      {[](auto& limbs) { limbs[2].dofs[0].axis.y() = 2.0; }, "flexion axis must be a unit"},
      {[](auto& limbs) {
         limbs[1].dofs[0].axis = {0, 0, 1};
       },
       "abduction axis must be perp"},
      {[](auto& limbs) {
         limbs[1].dofs[2].axis = {1, 0, 0};
       },
       "rotation axis must be z"},
      {[](auto& limbs) { limbs[1].dofs[2].angle_min_rad = 2.0; }, "rotation has a minimum above"},
      {[nan](auto& limbs) { limbs[1].dofs[2].angle_max_rad = nan; }, "rotation must lie between"},
      {[](auto& limbs) { limbs[1].dofs[1].name = "abduction"; }, "abduction occurs twice"},
      {[](auto& limbs) { limbs[1].dofs[0].kind = DofKind::kHinge; }, "mixes swings and hinges"},
      {[](auto& limbs) { limbs[1].dofs[0].speed_max_rad_per_s = -1.0; }, "speed must be 0"},
      {[](auto& limbs) { limbs[0].dofs = limbs[2].dofs; }, "'trunk': is the base limb"},
  };
  for (const Fault& fault : faults) {
    std::vector<Limb> limbs = ArmAndHead();
    fault.break_it(limbs);
    EXPECT_THAT([&] { BodyModel("sample", limbs); },
                testing::ThrowsMessage<config::ConfigError>(HasSubstr(fault.says)))
        << fault.says;
  }
}

}  // namespace
}  // namespace deixis::body_model
