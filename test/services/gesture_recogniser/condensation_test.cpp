#include "services/gesture_recogniser/core/condensation.h"

#include <gmock/gmock.h>

#include <cmath>
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

/// Weights of samples whose log-density runs from about 0 down to -79.
TEST(WeighByMotion, ExponentiatesAsExactlyAsItSays) {
  GestureModel model = TestModels()[0];
  for (ModelPoint& point : model.points) {
    point.speed_m_per_s = 1.0;
    point.speed_spread_m_per_s = 0.4;
    point.turn_spread_rad = 0.4;
  }
  const ModelTable table({model});
  const ModelTable::Point& point = table.Points(0)[0];
  const float still = 0.0F;
  SampleSet samples;
  samples.Resize(2000);
  for (std::size_t n = 0; n < samples.size(); ++n) {
    samples.amplitude[n] = 5.05F * static_cast<float>(n) / static_cast<float>(samples.size());
  }
  WeighByMotion(table, {&still, &still, 1, 1.0F / 15.0F}, samples);
  for (std::size_t n = 0; n < samples.size(); ++n) {
    const float speed = samples.amplitude[n] * point.scaled_speed;
    const double exact = std::exp(static_cast<double>(point.log_norm - 0.5F * speed * speed));
    EXPECT_NEAR(static_cast<double>(samples.weight[n]) / exact, 1.0, 1e-4) << n;
  }
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
