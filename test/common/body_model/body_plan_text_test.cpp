// Plans as text, and the spreads of their lengths.
#include <gmock/gmock.h>

#include <filesystem>
#include <fstream>

#include "common/anthropometry/person_estimate.h"
#include "common/body_model/body_plan.h"
#include "test/common/body_model/body_samples.h"

namespace deixis::body_model {
namespace {

Sizes SizesOfSomebody() {
  const Person person = FourPeople().front();
  const std::string file = DEIXIS_SOURCE_DIR "/config/kinematics/population.yaml";
  return anthropometry::SizesOf(anthropometry::Populations::Load(file), person.sex,
                                person.stature_m);
}

const std::string kModels = DEIXIS_SOURCE_DIR "/config/body_models/";

BodyPlan ReadBack(const std::string& text) {
  const auto file = std::filesystem::path(testing::TempDir()) / "body_plan_text_test.yaml";
  std::ofstream(file) << text;
  return LoadBodyPlan(file);
}

TEST(BodyPlanText, IsReadBackAsTheSameBody) {
  for (const char* name : {"whole_body_detailed", "clothed_body", "right_arm"}) {
    const BodyPlan plan = LoadBodyPlan(kModels + name + ".yaml");
    const Sizes sizes = SizesOfSomebody();
    EXPECT_EQ(Build(ReadBack(ToYaml(plan)), sizes).id(), Build(plan, sizes).id()) << name;
  }
}

TEST(BodyPlanText, KeepsSpreads) {
  BodyPlan plan = LoadBodyPlan(kModels + "whole_body_detailed.yaml");
  plan.limbs[1].length = {{"kph", 0.1, 0.0, 0.0123}, {"", 1.0, 0.02, 0.003}};
  const BodyPlan read = ReadBack(ToYaml(plan));
  ASSERT_EQ(read.limbs[1].length.size(), 2u);
  EXPECT_EQ(read.limbs[1].length[0].spread, 0.0123);
  EXPECT_EQ(read.limbs[1].length[1].metres, 0.02);
  EXPECT_EQ(read.limbs[1].length[1].spread, 0.003);
}

TEST(BodyPlanText, RefusesSpreadsBelowZero) {
  BodyPlan plan = LoadBodyPlan(kModels + "whole_body_detailed.yaml");
  plan.limbs[1].length = {{"kph", 0.1, 0.0, -0.01}};
  EXPECT_THROW(ReadBack(ToYaml(plan)), config::ConfigError);
}

TEST(BodyPlan, LetsSpreadsChangeNobody) {
  BodyPlan plan = LoadBodyPlan(kModels + "clothed_body.yaml");
  const Sizes sizes = SizesOfSomebody();
  const auto before = Build(plan, sizes).id();
  for (LimbPlan& limb : plan.limbs) {
    ForEachLength(limb, [](const char*, LengthPlan& length) {
      for (Term& term : length) term.spread = 0.5;
    });
  }
  EXPECT_EQ(Build(plan, sizes).id(), before);
}

}  // namespace
}  // namespace deixis::body_model
