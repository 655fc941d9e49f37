// The closest point of a limb: many at once against one after the other, in one run. Times are per
// point.
#include <benchmark/benchmark.h>

#include <vector>

#include "common/geometry/closest_points.h"
#include "test/common/geometry/cylinder_samples.h"

namespace deixis::geometry {
namespace {

constexpr int kPoints = 10000;
const DegenerateCylinder kForearm{0.045, 0.04, 0.03, 0.025, 0.26};

std::vector<Eigen::Vector3d> Points() { return PointsNear(kForearm, 0.03, kPoints); }

void CountPoints(benchmark::State& state) {
  state.counters["per_point"] = benchmark::Counter(
      kPoints, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

void OneByOne(benchmark::State& state) {
  const std::vector<Eigen::Vector3d> points = Points();
  for (auto _ : state) {
    for (const Eigen::Vector3d& point : points) {
      benchmark::DoNotOptimize(FindClosest(kForearm, point));
    }
  }
  CountPoints(state);
}
BENCHMARK(OneByOne);

void AllAtOnce(benchmark::State& state) {
  std::vector<float> x, y, z;
  for (const Eigen::Vector3d& point : Points()) {
    x.push_back(static_cast<float>(point.x()));
    y.push_back(static_cast<float>(point.y()));
    z.push_back(static_cast<float>(point.z()));
  }
  std::vector<float> distance(kPoints), nx(kPoints), ny(kPoints), nz(kPoints);
  for (auto _ : state) {
    FindClosestPoints(kForearm, {x.data(), y.data(), z.data(), kPoints},
                      {distance.data(), nx.data(), ny.data(), nz.data()});
    benchmark::ClobberMemory();
  }
  CountPoints(state);
}
BENCHMARK(AllAtOnce);

}  // namespace
}  // namespace deixis::geometry
