// Time per image and hand of the recogniser: CONDENSATION against a naive version of itself in the
// same run (the ratio is what counts, machines differ), and the segmental method. `end_mean` is the
// mean end probability over the sequence, which both versions must agree on within their
// Monte-Carlo error.
//   condensation_benchmark --benchmark_repetitions=5 --benchmark_report_aggregates_only=true
#include <benchmark/benchmark.h>

#include "services/gesture_recogniser/core/condensation.h"
#include "services/gesture_recogniser/core/segmental.h"
#include "test/benchmark/gesture_recogniser/naive_condensation.h"
#include "test/services/gesture_recogniser/gesture_scene.h"

namespace deixis::gesture_recogniser {
namespace {

constexpr double kStep_s = 1.0 / 15.0;
constexpr int kImages = 90;

/// The motion up to every image: a hand that rests, points, holds and returns.
const std::vector<Motion>& Motions() {
  static const std::vector<Motion> motions = [] {
    std::vector<Motion> all;
    MotionHistory history{MotionConfig{}};
    const PointingScene scene;
    for (int i = 0; i < kImages; ++i) {
      history.Add({At(i * kStep_s), scene.Hand(i * kStep_s), 1.0, true});
      all.push_back(history.Sample(kTestPxPerM));
    }
    return all;
  }();
  return motions;
}

std::size_t Window(const Motion& motion, std::size_t window) {
  return std::min(window, motion.size() > 1 ? motion.size() - 1 : 1);
}

void Report(benchmark::State& state, double end_sum) {
  const auto images = static_cast<double>(state.iterations()) * kImages;
  state.counters["per_image"] =
      benchmark::Counter(images, benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
  state.counters["end_mean"] = end_sum / images;
}

void BM_Naive(benchmark::State& state) {
  NaiveCondensation condensation(TestModels(), static_cast<int>(state.range(0)));
  double end_sum = 0.0;
  for (auto _ : state) {
    for (const Motion& motion : Motions()) {
      const auto count =
          static_cast<std::ptrdiff_t>(Window(motion, static_cast<std::size_t>(state.range(1))));
      end_sum +=
          condensation.Step({motion.speed_m_per_s.begin(), motion.speed_m_per_s.begin() + count},
                            {motion.turn_rad.begin(), motion.turn_rad.begin() + count}, kStep_s);
    }
  }
  Report(state, end_sum);
}

void BM_Condensation(benchmark::State& state) {
  CondensationConfig config;
  config.samples = static_cast<int>(state.range(0));
  config.window_s = static_cast<double>(state.range(1)) * kStep_s;
  config.context = ContextUse::kNone;
  Condensation condensation(config, TestModels(), 0);
  double end_sum = 0.0;
  for (auto _ : state) {
    for (const Motion& motion : Motions()) {
      end_sum += condensation.Observe(motion, {}, scene::Side::kLeft).end_probability;
    }
  }
  Report(state, end_sum);
}

void BM_Segmental(benchmark::State& state) {
  Segmental segmental({}, TestModels(), kStep_s);
  Surroundings surroundings;
  for (int i = 0; i < state.range(0); ++i) {
    surroundings.targets.push_back({i, "thing", {0.3 * i, 0.5, 0.1, 0.1}});
  }
  double end_sum = 0.0;
  for (auto _ : state) {
    for (const Motion& motion : Motions()) {
      end_sum += segmental.Observe(motion, surroundings, scene::Side::kLeft).end_probability;
    }
  }
  Report(state, end_sum);
}

BENCHMARK(BM_Naive)->Args({1000, 10})->Args({1000, 15})->Args({100000, 10});
BENCHMARK(BM_Condensation)->Args({1000, 10})->Args({1000, 15})->Args({100000, 10});
BENCHMARK(BM_Segmental)->Arg(6);

}  // namespace
}  // namespace deixis::gesture_recogniser
