// Finding people and the floor in a depth image, and the usual way with PCL beside it on the same
// image in the same run. `recall` is the share of the people's pixels that each way finds: PCL's
// voxels stand for all pixels within 2 cm. One thread.
#include <benchmark/benchmark.h>

#include <opencv2/core.hpp>
#include <unordered_set>

#include "services/pose_fitter/core/depth/sound_depth.h"
#include "services/pose_fitter/core/floor/floor_tracker.h"
#include "services/pose_fitter/core/people/people_finder.h"
#include "test/benchmark/pose_fitter/pcl_people.h"
#include "test/services/pose_fitter/synthetic_room.h"

namespace deixis::pose_fitter {
namespace {

constexpr double kFar_m = 6.0;

/// Two people, one of them behind a table, and a cupboard.
const test::Picture& PictureOf(const benchmark::State& state) {
  static std::map<int, test::Picture> pictures;
  const auto width = static_cast<int>(state.range(0));
  auto& picture = pictures[width];
  if (!picture.depth_mm.empty()) return picture;
  test::Room room;
  room.AddStanding(-0.5, 2.2, 1);
  room.AddStanding(0.6, 3.0, 2);
  room.AddTable(0.7, 2.0, 0.5, 0.3, 0.7);
  room.Add(test::Box{{-1.6, 3.4, 0.0}, {-1.0, 3.9, 1.8}});
  return picture = test::Look(room, width, 0.002);
}

/// Whole of what one image takes.
struct Finding {
  DepthView view;
  SoundDepth sound;
  FloorTracker floor;
  PeopleFinder people;
  double time_s = 0.0;

  const PeopleRegions& Find(const test::Picture& picture) {
    view.Update(picture.camera, picture.depth_mm);
    const auto& is_sound = sound.Find(view);
    time_s += 1.0 / 30.0;
    return people.Find(view, is_sound, floor.Update(view, is_sound, time_s));
  }
};

void FindPeople(benchmark::State& state) {
  const test::Picture& picture = PictureOf(state);
  Finding finding;
  for (auto _ : state) benchmark::DoNotOptimize(finding.Find(picture).regions.data());
  int all = 0, found = 0;
  for (int i = 0; i < static_cast<int>(picture.owner.total()); ++i) {
    if (picture.owner.at<std::uint8_t>(i) == 0) continue;
    ++all;
    found += finding.people.regions().labels[static_cast<std::size_t>(i)] != 0;
  }
  state.counters["recall"] = 1.0 * found / all;
}
BENCHMARK(FindPeople)->Arg(320)->Arg(640)->Unit(benchmark::kMillisecond);

/// Parts of the above.
void TakeDepth(benchmark::State& state) {
  const test::Picture& picture = PictureOf(state);
  DepthView view;
  for (auto _ : state) {
    view.Update(picture.camera, picture.depth_mm);
    benchmark::DoNotOptimize(view.z_m().data());
  }
}
BENCHMARK(TakeDepth)->Arg(320)->Arg(640)->Unit(benchmark::kMillisecond);

void FindSoundDepth(benchmark::State& state) {
  Finding finding;
  finding.Find(PictureOf(state));
  for (auto _ : state) benchmark::DoNotOptimize(finding.sound.Find(finding.view).data());
}
BENCHMARK(FindSoundDepth)->Arg(320)->Arg(640)->Unit(benchmark::kMillisecond);

void FollowFloor(benchmark::State& state) {
  Finding finding;
  finding.Find(PictureOf(state));
  const auto& is_sound = finding.sound.Find(finding.view);
  for (auto _ : state) {
    finding.time_s += 1.0 / 30.0;
    benchmark::DoNotOptimize(finding.floor.Update(finding.view, is_sound, finding.time_s));
  }
}
BENCHMARK(FollowFloor)->Arg(320)->Arg(640)->Unit(benchmark::kMillisecond);

void FindRegions(benchmark::State& state) {
  Finding finding;
  finding.Find(PictureOf(state));
  const auto& is_sound = finding.sound.Find(finding.view);
  for (auto _ : state) {
    benchmark::DoNotOptimize(finding.people.Find(finding.view, is_sound, finding.floor.floor()));
  }
}
BENCHMARK(FindRegions)->Arg(320)->Arg(640)->Unit(benchmark::kMillisecond);

std::int64_t VoxelOf(const Eigen::Vector3d& point_m) {
  const Eigen::Array3d index = (point_m.array() / 0.02).floor() + 4096.0;
  return (static_cast<std::int64_t>(index.x()) << 32) +
         (static_cast<std::int64_t>(index.y()) << 16) + static_cast<std::int64_t>(index.z());
}

double RecallOf(const std::vector<float>& points, const test::Picture& picture,
                const DepthView& view) {
  std::unordered_set<std::int64_t> voxels;
  for (std::size_t i = 0; i < points.size(); i += 3) {
    const Eigen::Vector3d point_m = Eigen::Map<const Eigen::Vector3f>(&points[i]).cast<double>();
    for (int near = 0; near < 27; ++near) {
      const Eigen::Vector3d step(near % 3 - 1, near / 3 % 3 - 1, near / 9 - 1);
      voxels.insert(VoxelOf(point_m + 0.02 * step));
    }
  }
  int all = 0, found = 0;
  for (int v = 0; v < view.height_px(); ++v) {
    for (int u = 0; u < view.width_px(); ++u) {
      if (picture.owner.at<std::uint8_t>(v, u) == 0) continue;
      ++all;
      found += static_cast<int>(voxels.count(VoxelOf(view.Point(u, v))));
    }
  }
  return 1.0 * found / all;
}

void FindPeopleByPcl(benchmark::State& state) {
  const test::Picture& picture = PictureOf(state);
  DepthView view;
  view.Update(picture.camera, picture.depth_mm);
  std::vector<float> points;
  for (auto _ : state) points = FindPeopleByPcl(view, kFar_m);
  state.counters["recall"] = RecallOf(points, picture, view);
}
BENCHMARK(FindPeopleByPcl)->Arg(320)->Arg(640)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace deixis::pose_fitter
