// The same body in the same points from the same start, 60 mm off: our fit, the limb-by-limb ICP of
// the source, PCL's ICP of each limb given which points are truly its own, and Ceres. `error_mm` is
// the mean error of joints and ends of limbs afterwards. Then our fit by points and by limbs. One
// thread.
#include <benchmark/benchmark.h>

#include <cmath>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "services/pose_fitter/core/fitting/body_fitter.h"
#include "services/pose_fitter/core/limb_icp/limb_icp.h"
#include "test/benchmark/pose_fitter/ceres_fit.h"
#include "test/benchmark/pose_fitter/pcl_icp.h"
#include "test/services/pose_fitter/synthetic_body.h"

namespace deixis::pose_fitter {
namespace {

using body_model::BodyPose;

constexpr double kStart_m = 0.06, kNoise_m = 0.003;
constexpr int kSurfacePoints = 1500;  // Of a limb, for PCL.

/// A body and about so many points of it.
struct Scene {
  body_model::BodyModel model;
  BodyPose truth = test::Gesturing(model);
  BodyPose start = test::Disturbed(model, truth, kStart_m);
  test::BodyPicture picture;
  DepthView view;
  BodyEvidence evidence{BodyEvidenceConfig{0.12, 0.04, 1000000, 0.3}};

  Scene(const std::string& plan, int points) : model(test::BodyOf(plan)) {
    constexpr int kTrial_px = 200;
    const int trial = test::PointsOf(test::Look(model, truth, kTrial_px)).count();
    picture = test::Look(model, truth,
                         static_cast<int>(kTrial_px * std::sqrt(1.0 * points / trial)), kNoise_m);
    view.Update(picture.camera, picture.depth_mm);
    body_model::Kinematics kinematics(model);
    evidence.Gather(view, kinematics, {&truth}, std::nullopt, {}, 0.12);
  }
};

const Scene& SceneOf(const std::string& plan, std::int64_t points) {
  static std::map<std::pair<std::string, std::int64_t>, std::unique_ptr<Scene>> scenes;
  auto& scene = scenes[{plan, points}];
  if (!scene) scene = std::make_unique<Scene>(plan, static_cast<int>(points));
  return *scene;
}

void Tell(benchmark::State& state, const Scene& scene, double error_m) {
  state.counters["error_mm"] = 1000.0 * error_m;
  state.counters["points"] = scene.evidence.points().count();
}

void FitOurs(benchmark::State& state, const std::string& plan) {
  const Scene& scene = SceneOf(plan, state.range(0));
  BodyFitter fitter({}, scene.model);
  BodyPose pose;
  for (auto _ : state) {
    pose = scene.start;
    fitter.Fit(scene.evidence, std::nullopt, scene.start, 1.0, pose);
  }
  Tell(state, scene, test::JointError_m(scene.model, scene.truth, pose));
  state.counters["limbs"] = scene.model.limb_count();
  state.SetComplexityN(scene.evidence.points().count());
}

void FitLimbIcp(benchmark::State& state) {
  const Scene& scene = SceneOf("whole_body", state.range(0));
  LimbIcp fitter({}, scene.model);
  BodyPose pose;
  for (auto _ : state) {
    pose = scene.start;
    fitter.Fit(scene.evidence.points(), pose);
  }
  Tell(state, scene, test::JointError_m(scene.model, scene.truth, pose));
  state.counters["cycles"] = fitter.cycles();
}

void FitCeres(benchmark::State& state) {
  const Scene& scene = SceneOf("whole_body", state.range(0));
  BodyPose pose;
  for (auto _ : state) {
    pose = scene.start;
    FitByCeres(scene.model, scene.evidence.points(), BodyFitterConfig{}.iterations, pose);
  }
  Tell(state, scene, test::JointError_m(scene.model, scene.truth, pose));
}

void Append(const Eigen::Vector3d& point_m, std::vector<float>& points) {
  for (const double value : point_m) points.push_back(static_cast<float>(value));
}

/// Each limb where it is thought to be, and the points that are truly its own.
std::vector<PclLimb> LimbsFor(const Scene& scene, const body_model::Kinematics& start) {
  body_model::Kinematics truth(scene.model);
  truth.Update(scene.truth);
  LimbMatches matches(scene.model);
  const BodyPoints& points = scene.evidence.points();
  matches.Find(points, truth, {});
  std::vector<PclLimb> limbs(static_cast<std::size_t>(scene.model.limb_count()));
  for (std::size_t k = 0; k < limbs.size(); ++k) {
    for (int i = 0; i < kSurfacePoints; ++i) {
      const auto place = SidePoint(scene.model.limbs()[k].shape, 2.0 * M_PI * (i % 50) / 50.0,
                                   (i / 50 + 0.5) / (kSurfacePoints / 50));
      Append(start.limb(static_cast<int>(k)) * place, limbs[k].surface_m);
    }
  }
  for (std::size_t i = 0; i < points.x_m.size(); ++i) {
    if (matches.winners()[i] < 0) continue;
    auto& own = limbs[static_cast<std::size_t>(matches.winners()[i])].measured_m;
    own.insert(own.end(), {points.x_m[i], points.y_m[i], points.z_m[i]});
  }
  return limbs;
}

void FitPcl(benchmark::State& state) {
  const Scene& scene = SceneOf("whole_body", state.range(0));
  body_model::Kinematics start(scene.model), truth(scene.model);
  start.Update(scene.start);
  truth.Update(scene.truth);
  const std::vector<PclLimb> limbs = LimbsFor(scene, start);
  std::vector<std::array<float, 16>> motions;
  for (auto _ : state) motions = FitLimbsByPcl(limbs, 20);
  double sum_m = 0.0;
  for (int limb = 0; limb < scene.model.limb_count(); ++limb) {
    Eigen::Isometry3d motion;
    for (int i = 0; i < 16; ++i) {
      motion.matrix()(i / 4, i % 4) =
          static_cast<double>(motions[static_cast<std::size_t>(limb)][static_cast<std::size_t>(i)]);
    }
    sum_m += 0.5 * (motion * start.proximal_m(limb) - truth.proximal_m(limb)).norm() +
             0.5 * (motion * start.distal_m(limb) - truth.distal_m(limb)).norm();
  }
  Tell(state, scene, sum_m / scene.model.limb_count());
}

void AtSizes(benchmark::internal::Benchmark* fit) {
  fit->Arg(5000)->Arg(10000)->Arg(20000)->Unit(benchmark::kMillisecond);
}

BENCHMARK_CAPTURE(FitOurs, whole_body, "whole_body")->Apply(AtSizes);
BENCHMARK(FitLimbIcp)->Apply(AtSizes);
BENCHMARK(FitPcl)->Apply(AtSizes);
BENCHMARK(FitCeres)->Apply(AtSizes);

BENCHMARK_CAPTURE(FitOurs, by_points, "clothed_body")
    ->Arg(250)
    ->Arg(500)
    ->Arg(1000)
    ->Arg(2000)
    ->Arg(5000)
    ->Arg(10000)
    ->Arg(20000)
    ->Unit(benchmark::kMillisecond)
    ->Complexity(benchmark::oN);
BENCHMARK_CAPTURE(FitOurs, limbs_6, "upper_body")->Arg(5000)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(FitOurs, limbs_10, "whole_body")->Arg(5000)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(FitOurs, limbs_19, "whole_body_detailed")
    ->Arg(5000)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(FitOurs, limbs_24, "clothed_body")->Arg(5000)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace deixis::pose_fitter
