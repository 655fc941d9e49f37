#include "services/gesture_recogniser/core/condensation.h"

#include <gmock/gmock.h>

#include <numeric>

#include "services/gesture_recogniser/core/decision.h"
#include "test/services/gesture_recogniser/gesture_scene.h"

namespace deixis::gesture_recogniser {
namespace {

Target TargetAt(int id, const Eigen::Vector2d& centre_m) {
  return {id, "thing", {centre_m.x() - 0.05, centre_m.y() - 0.05, 0.1, 0.1}};
}

/// Runs a stroke along +x from 0 to 0.4 m; `inspect` sees every assessment.
template <typename Inspect>
void RunStroke(Condensation& condensation, const Surroundings& surroundings, Inspect inspect) {
  MotionHistory history{MotionConfig{}};
  for (double time_s = 0.0; time_s < 2.0; time_s += 1.0 / 15.0) {
    history.Add({At(time_s), OnWay({0.0, 0.0}, {0.4, 0.0}, time_s, 1.0), 0.001, true});
    inspect(condensation.Observe(history.Sample(1.0), surroundings, scene::Side::kRight));
  }
}

TEST(Condensation, FindsTheEndOfAStroke) {
  CondensationConfig config;
  config.context = ContextUse::kNone;
  Condensation condensation(config, TestModels(), 0);
  double highest = 0.0;
  int decisions = 0;
  RunStroke(condensation, {}, [&](const Assessment& assessment) {
    highest = std::max(highest, assessment.end_probability);
    decisions += assessment.decision.has_value();
  });
  EXPECT_GT(highest, 0.3);
  EXPECT_EQ(decisions, 1);
}

TEST(Condensation, WeightsSumToOneAndScalesStayWithinTheirBounds) {
  Condensation condensation({}, TestModels(), 0);
  RunStroke(condensation, {}, [&](const Assessment&) {
    const SampleSet& samples = condensation.samples();
    EXPECT_NEAR(std::accumulate(samples.weight.begin(), samples.weight.end(), 0.0), 1.0, 1e-3);
    for (const float scale : samples.amplitude) {
      ASSERT_GE(scale, 0.65F);
      ASSERT_LE(scale, 1.35F);
    }
    for (const float rate : samples.rate) {
      ASSERT_GE(rate, 0.65F);
      ASSERT_LE(rate, 1.35F);
    }
  });
}

TEST(Condensation, NamesTheObjectAheadNotTheOneBeside) {
  CondensationConfig config;
  Condensation condensation(config, TestModels(), 0);
  Surroundings surroundings;
  surroundings.targets = {TargetAt(5, {0.3, 0.35}), TargetAt(6, {0.65, 0.0})};
  int named = -1;
  RunStroke(condensation, surroundings, [&](const Assessment& assessment) {
    if (assessment.decision) named = assessment.decision->target;
  });
  EXPECT_EQ(named, 1);
}

TEST(Condensation, IsNotRecognisedWithoutAnObjectThatIsRequired) {
  Condensation condensation({}, TestModels(), 0);
  int decisions = 0;
  RunStroke(condensation, {},
            [&](const Assessment& assessment) { decisions += assessment.decision.has_value(); });
  EXPECT_EQ(decisions, 0);
}

TEST(Condensation, IsRecognisedWithoutAnObjectThatIsOptional) {
  auto models = TestModels();
  models[0].context = ContextNeed::kOptional;
  CondensationConfig config;
  Condensation condensation(config, models, 0);
  std::vector<Decision> decisions;
  RunStroke(condensation, {}, [&](const Assessment& assessment) {
    if (assessment.decision) decisions.push_back(*assessment.decision);
  });
  ASSERT_EQ(decisions.size(), 1U);
  EXPECT_EQ(decisions[0].outcome, scene::GestureOutcome::kNoObject);
}

TEST(Condensation, KeepsBindingsWhenTheListOfObjectsChanges) {
  Condensation condensation({}, TestModels(), 0);
  Surroundings surroundings;
  surroundings.targets = {TargetAt(6, {0.65, 0.0})};
  int frame = 0;
  int named = -1;
  MotionHistory history{MotionConfig{}};
  for (double time_s = 0.0; time_s < 2.0; time_s += 1.0 / 15.0, ++frame) {
    if (frame % 2 == 0)
      surroundings.targets.insert(surroundings.targets.begin(), TargetAt(2, {-2, 0}));
    if (frame % 2 == 1) surroundings.targets.erase(surroundings.targets.begin());
    history.Add({At(time_s), OnWay({0.0, 0.0}, {0.4, 0.0}, time_s, 1.0), 0.001, true});
    const auto& assessment =
        condensation.Observe(history.Sample(1.0), surroundings, scene::Side::kRight);
    if (assessment.decision) {
      named = surroundings.targets[static_cast<std::size_t>(assessment.decision->target)].id;
    }
  }
  EXPECT_EQ(named, 6);
}

TEST(DecideByWeight, NeedsMoreThanTheShareOfTheEndProbability) {
  EXPECT_FALSE(DecideByWeight(0.5, {0.1, 0.14}, 0.3, ContextNeed::kRequired));
  const auto decision = DecideByWeight(0.5, {0.1, 0.16}, 0.3, ContextNeed::kRequired);
  ASSERT_TRUE(decision);
  EXPECT_EQ(decision->target, 1);
}

TEST(DecideByWeight, OptionalContextIsRecognisedWithoutObject) {
  const auto decision = DecideByWeight(0.5, {0.1}, 0.3, ContextNeed::kOptional);
  ASSERT_TRUE(decision);
  EXPECT_EQ(decision->outcome, scene::GestureOutcome::kNoObject);
  EXPECT_EQ(decision->target, -1);
}

}  // namespace
}  // namespace deixis::gesture_recogniser
