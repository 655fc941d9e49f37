#include "services/hand_tracker/core/skin_regions.h"

#include <algorithm>
#include <numeric>

namespace deixis::hand_tracker {
namespace {

struct FoundRun {
  Run run;
  bool is_strong = false;
};

/// Sets of runs that touch, by union-find over their indices; the smallest index is the root.
class Unions {
 public:
  explicit Unions(std::size_t size) : parent_(size) {
    std::iota(parent_.begin(), parent_.end(), std::size_t{0});
  }
  std::size_t Root(std::size_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  void Join(std::size_t a, std::size_t b) {
    const std::size_t root_a = Root(a);
    const std::size_t root_b = Root(b);
    parent_[std::max(root_a, root_b)] = std::min(root_a, root_b);
  }

 private:
  std::vector<std::size_t> parent_;
};

void FindRunsOfRow(const std::uint8_t* evidence, int row, int width,
                   const HysteresisThresholds& thresholds, std::vector<FoundRun>& runs) {
  int x = 0;
  while (x < width) {
    while (x < width && evidence[x] < thresholds.low) ++x;
    if (x == width) return;
    FoundRun found{{row, x, x}, false};
    int strongest = 0;
    for (; x < width && evidence[x] >= thresholds.low; ++x) {
      strongest = std::max(strongest, static_cast<int>(evidence[x]));
    }
    found.run.last = x - 1;
    found.is_strong = strongest >= thresholds.high;
    runs.push_back(found);
  }
}

/// Joins the runs [middle, end) with those of the row above, [begin, middle).
void JoinRows(const std::vector<FoundRun>& runs, std::size_t begin, std::size_t middle,
              std::size_t end, Unions& unions) {
  std::size_t above = begin;
  for (std::size_t here = middle; here < end; ++here) {
    const Run& run = runs[here].run;
    while (above < middle && runs[above].run.last < run.first - 1) ++above;
    for (std::size_t i = above; i < middle && runs[i].run.first <= run.last + 1; ++i) {
      unions.Join(here, i);
    }
  }
}

std::vector<FoundRun> FindRuns(const cv::Mat& evidence, const HysteresisThresholds& thresholds,
                               std::vector<std::size_t>& row_begins) {
  std::vector<FoundRun> runs;
  for (int y = 0; y < evidence.rows; ++y) {
    row_begins.push_back(runs.size());
    FindRunsOfRow(evidence.ptr<std::uint8_t>(y), y, evidence.cols, thresholds, runs);
  }
  row_begins.push_back(runs.size());
  return runs;
}

std::vector<SkinRegion> CollectRegions(const std::vector<FoundRun>& runs, Unions& unions,
                                       int least_area_px) {
  std::vector<SkinRegion> regions;
  std::vector<bool> is_strong;
  std::vector<std::size_t> region_of_root(runs.size());
  for (std::size_t i = 0; i < runs.size(); ++i) {
    const std::size_t root = unions.Root(i);
    if (root == i) {
      region_of_root[i] = regions.size();
      regions.emplace_back();
      is_strong.push_back(false);
    }
    const std::size_t region = region_of_root[root];
    AddRun(runs[i].run, regions[region]);
    is_strong[region] = is_strong[region] || runs[i].is_strong;
  }
  std::vector<SkinRegion> kept;
  for (std::size_t i = 0; i < regions.size(); ++i) {
    if (is_strong[i] && regions[i].area_px >= least_area_px) kept.push_back(std::move(regions[i]));
  }
  return kept;
}

}  // namespace

void AddRun(const Run& run, SkinRegion& region) {
  if (region.runs.empty()) {
    region.left = run.first;
    region.top = run.row;
    region.right = run.last;
  }
  region.left = std::min(region.left, run.first);
  region.right = std::max(region.right, run.last);
  region.bottom = run.row;
  region.area_px += run.last - run.first + 1;
  region.runs.push_back(run);
}

std::vector<SkinRegion> FindRegions(const cv::Mat& evidence, const HysteresisThresholds& thresholds,
                                    int least_area_px) {
  std::vector<std::size_t> row_begins;
  const std::vector<FoundRun> runs = FindRuns(evidence, thresholds, row_begins);
  Unions unions(runs.size());
  for (std::size_t row = 1; row + 1 < row_begins.size(); ++row) {
    JoinRows(runs, row_begins[row - 1], row_begins[row], row_begins[row + 1], unions);
  }
  return CollectRegions(runs, unions, least_area_px);
}

}  // namespace deixis::hand_tracker
