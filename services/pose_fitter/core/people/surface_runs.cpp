#include "services/pose_fitter/core/people/surface_runs.h"

#include <algorithm>
#include <cstring>
#include <utility>

#include "services/pose_fitter/core/people/gate_kernels.h"

namespace deixis::pose_fitter {
namespace {

constexpr std::uint8_t kContinues = kInside | kJoinsLeft;

/// First pixel from `u` on that is inside, or `width`.
int NextInside(const std::uint8_t* links, int u, int width) {
  std::uint64_t eight = 0;
  while (u + 8 <= width && (std::memcpy(&eight, links + u, 8), eight == 0)) u += 8;
  while (u < width && (links[u] & kInside) == 0) ++u;
  return u;
}

int EndOfRun(const std::uint8_t* links, int u, int width) {
  constexpr std::uint64_t kEight = 0x0101010101010101U * kContinues;
  std::uint64_t eight = 0;
  while (u + 8 <= width && (std::memcpy(&eight, links + u, 8), (eight & kEight) == kEight)) u += 8;
  while (u < width && (links[u] & kContinues) == kContinues) ++u;
  return u;
}

bool AnyJoinsAbove(const std::uint8_t* links, int begin, int end) {
  return std::any_of(links + begin, links + end,
                     [](std::uint8_t link) { return (link & kJoinsAbove) != 0; });
}

}  // namespace

void SurfaceRuns::Start(int width_px, int height_px) {
  width_px_ = width_px;
  // Every second pixel may be a run.
  runs_.reserve(static_cast<std::size_t>((width_px + 1) / 2) * static_cast<std::size_t>(height_px));
  row_begins_.reserve(static_cast<std::size_t>(height_px) + 1);
  runs_.clear();
  row_begins_.assign(1, 0);
}

void SurfaceRuns::AddRow(const std::uint8_t* links) {
  const auto row = static_cast<int>(row_begins_.size()) - 1;
  const int above_end = static_cast<int>(runs_.size());
  int above = row > 0 ? RowBegin(row - 1) : 0;
  for (int u = NextInside(links, 0, width_px_); u < width_px_;) {
    const int end = EndOfRun(links, u + 1, width_px_);
    const auto number = static_cast<int>(runs_.size());
    runs_.push_back({row, u, end, number});
    JoinAbove(number, above, above_end, links);
    u = NextInside(links, end, width_px_);
  }
  row_begins_.push_back(static_cast<int>(runs_.size()));
}

void SurfaceRuns::JoinAbove(int run, int& above, int above_end, const std::uint8_t* links) {
  const SurfaceRun here = runs_[static_cast<std::size_t>(run)];
  const auto at = [this](int i) -> const SurfaceRun& { return runs_[static_cast<std::size_t>(i)]; };
  while (above < above_end && at(above).end_px <= here.begin_px) ++above;
  for (int other = above; other < above_end && at(other).begin_px < here.end_px; ++other) {
    if (AnyJoinsAbove(links, std::max(here.begin_px, at(other).begin_px),
                      std::min(here.end_px, at(other).end_px))) {
      Join(run, other);
    }
  }
}

int SurfaceRuns::Root(int run) {
  const auto parent = [this](int i) -> int& {
    return runs_[static_cast<std::size_t>(i)].component;
  };
  while (parent(run) != run) {
    parent(run) = parent(parent(run));
    run = parent(run);
  }
  return run;
}

void SurfaceRuns::Join(int a, int b) {
  a = Root(a);
  b = Root(b);
  if (a < b) std::swap(a, b);
  runs_[static_cast<std::size_t>(a)].component = b;
}

void SurfaceRuns::Finish() {
  for (std::size_t i = 0; i < runs_.size(); ++i) {
    runs_[i].component = Root(static_cast<int>(i));
  }
}

}  // namespace deixis::pose_fitter
