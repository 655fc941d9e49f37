// The closest points of limbs: many at once against one after the other, exactly and by the search
// that one would write for one point, in one run. Times are per point.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <vector>

#include "common/geometry/closest_points.h"
#include "test/benchmark/geometry/single_start_search.h"
#include "test/common/geometry/cylinder_samples.h"

namespace deixis::geometry {
namespace {

constexpr int kPointsPerLimb = 2000;
constexpr double kWithin_m = 0.03;
constexpr int kBatches = 20;  // As long as one of the slow ones, for the clock.
#ifdef DEIXIS_KERNEL_LEVEL
constexpr const char* kLevel = DEIXIS_KERNEL_LEVEL;
#else
constexpr const char* kLevel = "the processor's own";
#endif

/// One limb with points within 3 cm of its surface, as vectors and as arrays.
struct Sample {
  DegenerateCylinder limb;
  std::vector<Eigen::Vector3d> points;
  std::vector<float> x, y, z, distance, nx, ny, nz;
};

std::vector<Sample> Samples() {
  std::vector<Sample> samples;
  for (const DegenerateCylinder& limb : BodyLimbs()) {
    Sample sample;
    sample.limb = limb;
    sample.points = PointsNear(limb, kWithin_m, kPointsPerLimb);
    for (const Eigen::Vector3d& point : sample.points) {
      sample.x.push_back(static_cast<float>(point.x()));
      sample.y.push_back(static_cast<float>(point.y()));
      sample.z.push_back(static_cast<float>(point.z()));
    }
    for (auto* room : {&sample.distance, &sample.nx, &sample.ny, &sample.nz}) {
      room->resize(sample.points.size());
    }
    samples.push_back(sample);
  }
  return samples;
}

int CountOf(const std::vector<Sample>& samples) {
  return kPointsPerLimb * static_cast<int>(samples.size());
}

void FindExactly(const std::vector<Sample>& samples) {
  for (const Sample& sample : samples) {
    for (const Eigen::Vector3d& point : sample.points) {
      benchmark::DoNotOptimize(FindClosest(sample.limb, point));
    }
  }
}

void FindFromOneStart(const std::vector<Sample>& samples) {
  for (const Sample& sample : samples) {
    for (const Eigen::Vector3d& point : sample.points) {
      benchmark::DoNotOptimize(FindClosestFromOneStart(sample.limb, point));
    }
  }
}

void FindAllAtOnce(std::vector<Sample>& samples) {
  for (Sample& sample : samples) {
    FindClosestPoints(
        sample.limb, {sample.x.data(), sample.y.data(), sample.z.data(), kPointsPerLimb},
        {sample.distance.data(), sample.nx.data(), sample.ny.data(), sample.nz.data()});
    benchmark::ClobberMemory();
  }
}

double Quantile(std::vector<double> values, double share) {
  std::sort(values.begin(), values.end());
  return values.at(static_cast<std::size_t>(share * static_cast<double>(values.size() - 1)));
}

/// Errors of the distances that `found_m` gives for a point of a sample.
template <typename FoundDistance>
void CountErrors(benchmark::State& state, const std::vector<Sample>& samples,
                 const FoundDistance& found_m) {
  std::vector<double> errors_um;
  for (const Sample& sample : samples) {
    for (std::size_t i = 0; i < sample.points.size(); ++i) {
      const double exact_m = FindClosest(sample.limb, sample.points[i]).signed_distance_m;
      errors_um.push_back(1e6 * std::abs(found_m(sample, i) - exact_m));
    }
  }
  state.counters["p50_um"] = Quantile(errors_um, 0.5);
  state.counters["p99_um"] = Quantile(errors_um, 0.99);
  state.counters["max_um"] = Quantile(errors_um, 1.0);
}

void CountPoints(benchmark::State& state, int count) {
  state.counters["per_point"] = benchmark::Counter(
      count, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

void Exact(benchmark::State& state) {
  const std::vector<Sample> samples = Samples();
  for (auto _ : state) FindExactly(samples);
  CountPoints(state, CountOf(samples));
}
BENCHMARK(Exact);

void OneStart(benchmark::State& state) {
  const std::vector<Sample> samples = Samples();
  for (auto _ : state) FindFromOneStart(samples);
  CountPoints(state, CountOf(samples));
  CountErrors(state, samples, [](const Sample& sample, std::size_t i) {
    return FindClosestFromOneStart(sample.limb, sample.points[i]).signed_distance_m;
  });
}
BENCHMARK(OneStart);

void AllAtOnce(benchmark::State& state) {
  std::vector<Sample> samples = Samples();
  for (auto _ : state) FindAllAtOnce(samples);
  state.SetLabel(kLevel);
  CountPoints(state, CountOf(samples));
  CountErrors(state, samples,
              [](const Sample& sample, std::size_t i) { return sample.distance[i]; });
}
BENCHMARK(AllAtOnce);

/// Of this thread: what other programs take from the processor does not count.
double ProcessorTime_s() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

template <typename Work>
double TimeOf_s(const Work& work) {
  const double begin_s = ProcessorTime_s();
  work();
  return ProcessorTime_s() - begin_s;
}

/// How many times faster all at once are, measured in turns: the medians of the ratios, and the
/// ratios of the shortest times ("best"), which another program's load changes least.
void TimesFaster(benchmark::State& state) {
  std::vector<Sample> samples = Samples();
  std::vector<double> exact_s, start_s, batch_s, than_exact, than_start;
  for (auto _ : state) {
    exact_s.push_back(TimeOf_s([&] { FindExactly(samples); }));
    start_s.push_back(TimeOf_s([&] { FindFromOneStart(samples); }));
    batch_s.push_back(TimeOf_s([&] {
                        for (int i = 0; i < kBatches; ++i) FindAllAtOnce(samples);
                      }) /
                      kBatches);
    than_exact.push_back(exact_s.back() / batch_s.back());
    than_start.push_back(start_s.back() / batch_s.back());
  }
  const double best_s = Quantile(batch_s, 0.0);
  state.SetLabel(kLevel);
  state.counters["than_exact"] = Quantile(than_exact, 0.5);
  state.counters["than_one_start"] = Quantile(than_start, 0.5);
  state.counters["best_than_exact"] = Quantile(exact_s, 0.0) / best_s;
  state.counters["best_than_one_start"] = Quantile(start_s, 0.0) / best_s;
}
BENCHMARK(TimesFaster)->Iterations(100)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace deixis::geometry
