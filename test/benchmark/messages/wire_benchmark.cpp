// What the check of a message's bytes costs beside decoding it: a picture of 100 kB, and the poses
// of one and of ten people as body_poses_t. All in one run.
//   wire_benchmark --benchmark_repetitions=5 --benchmark_report_aggregates_only=true
#include <benchmark/benchmark.h>

#include <bot_core/image_t.hpp>
#include <cstdlib>
#include <deixis/body_poses_t.hpp>

#include "common/messages/wire.h"

namespace deixis::messages {
namespace {

using Block = std::vector<std::uint8_t>;

constexpr int kLimbs = 10;
constexpr int kAngles = 23;

const Block& Picture() {
  static const Block block = [] {
    bot_core::image_t message{};
    message.data.assign(100'000, 0x5A);
    message.size = 100'000;
    return EncodeWire(message);
  }();
  return block;
}

body_pose_t Pose() {
  body_pose_t pose{};
  pose.n_angles = kAngles;
  pose.angles_rad.assign(kAngles, 0.1);
  pose.rates_rad_per_s.assign(kAngles, 0.1);
  pose.n_covariance = (kAngles + 6) * (kAngles + 7) / 2;
  pose.covariance.assign(static_cast<std::size_t>(pose.n_covariance), 0.01F);
  pose.n_limbs = kLimbs;
  pose.limbs.assign(kLimbs, limb_pose_t{});
  return pose;
}

Block Poses(int people) {
  body_poses_t message{};
  message.camera = "STEREO";
  message.n_bodies = people;
  message.bodies.assign(static_cast<std::size_t>(people), Pose());
  return EncodeWire(message);
}

void Check(benchmark::State& state, const Block& block) {
  for (auto _ : state) {
    if (CheckWire({block.data(), block.size()}) != WireFault::kNone) std::abort();
  }
  state.counters["bytes"] = static_cast<double>(block.size());
}

// What there was without the check.
template <typename Message>
void Decode(benchmark::State& state, const Block& block) {
  for (auto _ : state) {
    Message message{};
    if (message.decode(block.data(), 0, static_cast<int>(block.size())) < 0) std::abort();
    benchmark::DoNotOptimize(message);
  }
  state.counters["bytes"] = static_cast<double>(block.size());
}

void CheckPicture(benchmark::State& state) { Check(state, Picture()); }
void DecodePicture(benchmark::State& state) { Decode<bot_core::image_t>(state, Picture()); }
void CheckPoses(benchmark::State& state) { Check(state, Poses(static_cast<int>(state.range()))); }
void DecodePoses(benchmark::State& state) {
  Decode<body_poses_t>(state, Poses(static_cast<int>(state.range())));
}

BENCHMARK(CheckPicture);
BENCHMARK(DecodePicture);
BENCHMARK(CheckPoses)->Arg(1)->Arg(10);
BENCHMARK(DecodePoses)->Arg(1)->Arg(10);

}  // namespace
}  // namespace deixis::messages
