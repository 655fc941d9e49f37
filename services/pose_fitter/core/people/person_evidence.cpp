#include "services/pose_fitter/core/people/person_evidence.h"

#include <algorithm>
#include <cmath>

namespace deixis::pose_fitter {
namespace {

constexpr double kTrunk_m = 0.15;
constexpr double kLimb_m = 0.06;      // Shorter rows are no limb.
constexpr double kLeastBulge = 0.05;  // Of the width.
constexpr double kLargestBulge = 0.35;
constexpr double kHeadHeight_m = 0.2;
constexpr double kLowestPart_m = 0.15;
constexpr int kBelow_px = 3;
constexpr float kFarther_m = 0.25F;

enum class Roundness { kBroken, kStraight, kRound, kOther };

/// How far the middle of a run stands out towards the camera, against its width.
Roundness RoundnessOf(const DepthView& depth, const SurfaceRun& run) {
  const int length = run.end_px - run.begin_px;
  const auto z = [&](int tenths) {
    return static_cast<double>(depth.z_m(run.begin_px + tenths * (length - 1) / 10, run.row_px));
  };
  const double width_m = length * z(5) / depth.camera().focal_px.x();
  if (width_m < kLimb_m) return Roundness::kBroken;
  const double bulge = (0.5 * (z(1) + z(9)) - (z(4) + z(5) + z(6)) / 3.0) / width_m;
  if (std::abs(bulge) < kLeastBulge) return Roundness::kStraight;
  return bulge > 0.0 && bulge < kLargestBulge ? Roundness::kRound : Roundness::kOther;
}

bool Hangs(const DepthView& depth, const SurfaceRun& run) {
  const int row = run.row_px + kBelow_px;
  if (row >= depth.height_px()) return false;
  const int middle = (run.begin_px + run.end_px) / 2;
  return depth.z_m(middle, row) > depth.z_m(middle, run.row_px) + kFarther_m;
}

/// 0 at `none`, 1 at `full`, straight between.
double Ramp(double value, double none, double full) {
  return std::clamp((value - none) / (full - none), 0.0, 1.0);
}

/// At least `least`, at `share` 1 all.
double AtLeast(double least, double share) { return least + (1.0 - least) * share; }

/// Who bends down or lifts the arms shows no head there, which does not speak against him much.
double HeadLikeness(const PersonEvidence& evidence) {
  if (evidence.is_cut_above) return 1.0;
  const double head =
      std::min(Ramp(evidence.head_width_m, 0.02, 0.1), Ramp(evidence.head_width_m, 0.6, 0.3));
  return AtLeast(0.4, head);
}

}  // namespace

double LikenessOf(const PersonEvidence& evidence, const SurfaceShape& shape, double top_m) {
  // Side views are narrow, and little is seen of who is partly hidden.
  const double wide = AtLeast(0.3, Ramp(evidence.wide_share, 0.2, 0.5));
  const bool is_cut = evidence.is_cut_above || evidence.is_cut_below;
  const double area = AtLeast(0.3, Ramp(shape.area_m2, 0.08, is_cut ? 0.15 : 0.28));
  return Ramp(evidence.round_share, 0.05, 0.35) * Ramp(evidence.straight_share, 0.7, 0.4) *
         Ramp(evidence.broken_share, 0.35, 0.2) * Ramp(evidence.hanging_share, 0.7, 0.3) *
         Ramp(evidence.runs_per_row, 5.5, 3.5) *
         Ramp(top_m, 0.3, evidence.is_cut_below ? 0.5 : 0.8) * HeadLikeness(evidence) * wide * area;
}

PersonEvidences::PersonEvidences() {
  evidences_.reserve(SurfacePieces::kMost);
  sums_.reserve(SurfacePieces::kMost);
}

void PersonEvidences::Gather(const DepthView& depth, const RoomFrame& room, const SurfaceRuns& runs,
                             const std::vector<int>& group_of_piece,
                             const std::vector<SurfaceShape>& shapes) {
  evidences_.assign(shapes.size(), {});
  sums_.assign(shapes.size(), {});
  for (const SurfaceRun& run : runs.runs()) {
    const int group =
        run.component < 0 ? -1 : group_of_piece[static_cast<std::size_t>(run.component)];
    if (group < 0) continue;
    const auto at = static_cast<std::size_t>(group);
    Add(depth, room, shapes[at], run, evidences_[at], sums_[at]);
  }
  for (std::size_t i = 0; i < evidences_.size(); ++i) Divide(sums_[i], evidences_[i]);
}

void PersonEvidences::Add(const DepthView& depth, const RoomFrame& room, const SurfaceShape& shape,
                          const SurfaceRun& run, PersonEvidence& evidence, Sums& sums) {
  const int length = run.end_px - run.begin_px;
  const Eigen::Vector3d point_m = depth.Point((run.begin_px + run.end_px) / 2, run.row_px);
  const double height_m = room.FromCamera(point_m).z();
  sums.pixels += length;
  ++sums.runs;
  sums.rows += run.row_px != sums.last_row_px ? 1 : 0;
  sums.last_row_px = run.row_px;
  const Roundness roundness = RoundnessOf(depth, run);
  evidence.round_share += roundness == Roundness::kRound ? length : 0;
  evidence.straight_share += roundness == Roundness::kStraight ? length : 0;
  evidence.broken_share += roundness == Roundness::kBroken ? length : 0;
  const double width_m = length * point_m.z() / depth.camera().focal_px.x();
  evidence.wide_share += width_m > kTrunk_m ? length : 0;
  evidence.is_cut_above = evidence.is_cut_above || run.row_px <= 1;
  evidence.is_cut_below = evidence.is_cut_below || run.row_px >= depth.height_px() - 2;
  const double area_m2 = width_m * point_m.z() / depth.camera().focal_px.y();
  if (shape.highest_m.z() - height_m < kHeadHeight_m) {
    evidence.head_width_m += area_m2 / kHeadHeight_m;
  }
  if (height_m - shape.lowest_m.z() < kLowestPart_m) {
    sums.lowest_pixels += length;
    sums.hanging_pixels += Hangs(depth, run) ? length : 0;
  }
}

void PersonEvidences::Divide(const Sums& sums, PersonEvidence& evidence) {
  for (double* share : {&evidence.round_share, &evidence.straight_share, &evidence.broken_share,
                        &evidence.wide_share}) {
    *share /= std::max(1.0, sums.pixels);
  }
  evidence.hanging_share = sums.hanging_pixels / std::max(1.0, sums.lowest_pixels);
  evidence.runs_per_row = static_cast<double>(sums.runs) / std::max(1, sums.rows);
}

}  // namespace deixis::pose_fitter
