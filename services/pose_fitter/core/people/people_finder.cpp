#include "services/pose_fitter/core/people/people_finder.h"

#include <algorithm>
#include <stdexcept>

#include "services/pose_fitter/core/depth/sound_depth.h"

namespace deixis::pose_fitter {

static_assert(SurfacePieces::kMost < 256, "labels are bytes");

namespace {

constexpr double kHeightSigmas = 1.5;  // Noise of the floor that is cut off with it.
constexpr double kAnyHeight_m = 100.0;
constexpr double kLiftedArms_m = 0.8;  // Above the middle of a head,
constexpr double kBelowHead_m = 1.9;   // and feet below it.
constexpr double kSeedShare = 0.3;     // Of a piece that must be expected to be somebody's.
constexpr int kLevelRows = 60;  // Rows of a picture, over how far apart level pixels are compared.
constexpr int kTopBins = 140;   // Centimetres: nothing higher is sat or lain on.

}  // namespace

void PeopleFinderConfig::Validate() const {
  config::Faults faults;
  faults.Require(near_m > 0.0, "near_m", "must be positive");
  faults.Require(far_m > near_m, "far_m", "must be larger than near_m");
  faults.Require(highest_m > lowest_m, "highest_m", "must be larger than lowest_m");
  faults.Require(join_fixed_m >= 0.0, "join_fixed_m", "must not be negative");
  faults.Require(join_sigmas > 0.0, "join_sigmas", "must be positive");
  faults.Require(join_slope > 0.0, "join_slope", "must be positive");
  faults.Require(least_piece_m2 > 0.0, "least_piece_m2", "must be positive");
  faults.Require(least_top_m2 > 0.0, "least_top_m2", "must be positive");
  faults.Require(top_thickness_m > 0.0, "top_thickness_m", "must be positive");
  faults.Require(seed_reach_m >= 0.0, "seed_reach_m", "must not be negative");
  faults.Require(least_likeness >= 0.0 && least_likeness <= 1.0, "least_likeness",
                 "must lie between 0 and 1");
  faults.Require(least_head >= 0.0 && least_head <= 1.0, "least_head", "must lie between 0 and 1");
  faults.Require(head_reach_m > 0.0, "head_reach_m", "must be positive");
  faults.Require(head_depth_m > 0.0, "head_depth_m", "must be positive");
  faults.ThrowIfAny();
}

PeopleFinder::PeopleFinder(const PeopleFinderConfig& config)
    : config_(config), heads_(config.heads) {
  regions_.heads.reserve(static_cast<std::size_t>(config.heads.most));
  config_.Validate();
  config_.shape.Validate();
}

const PeopleRegions& PeopleFinder::Find(const DepthView& depth,
                                        const std::vector<std::uint8_t>& is_sound,
                                        const std::optional<body_model::Floor>& floor,
                                        const std::vector<std::uint8_t>& seeds) {
  if (!seeds.empty() && seeds.size() != depth.z_m().size()) {
    throw std::logic_error("people finder: the seeds are not of the depth's size");
  }
  territory_.Update(seeds, depth.width_px(), depth.height_px(), SeedReach_px(depth, seeds));
  has_floor_ = floor.has_value();
  room_ =
      RoomFrameOf(floor ? floor->normal : -Eigen::Vector3d::UnitY(), floor ? floor->offset_m : 0.0);
  regions_.floor = floor;
  SetGate(depth.camera());
  FindTops(depth);
  Link(depth, is_sound);
  pieces_.Find(depth, room_, config_.least_piece_m2, config_.shape.largest_area_m2, is_level_,
               runs_);
  Group(depth);
  Write(depth);
  AddHeads(depth, is_sound);
  return regions_;
}

/// At the mean distance of where people are expected.
int PeopleFinder::SeedReach_px(const DepthView& depth,
                               const std::vector<std::uint8_t>& seeds) const {
  double sum_m = 0.0;
  int count = 0;
  for (std::size_t i = 0; i < seeds.size(); ++i) {
    const float z = depth.z_m()[i];
    if (seeds[i] == 0 || z <= 0.0F) continue;
    sum_m += static_cast<double>(z);
    ++count;
  }
  return count == 0
             ? 0
             : static_cast<int>(config_.seed_reach_m * depth.camera().focal_px.x() * count / sum_m);
}

void PeopleFinder::SetGate(const DepthCamera& camera) {
  const Eigen::Vector3d up = room_.room_from_camera.row(2).transpose();
  gate_.near_m = static_cast<float>(config_.near_m);
  gate_.far_m = static_cast<float>(config_.far_m);
  gate_.lean_per_px = static_cast<float>(up.x() / camera.focal_px.x());
  gate_.camera_height_m = static_cast<float>(room_.camera_height_m);
  gate_.lowest_m = static_cast<float>(has_floor_ ? config_.lowest_m : -kAnyHeight_m);
  gate_.highest_m = static_cast<float>(has_floor_ ? config_.highest_m : kAnyHeight_m);
  gate_.noise_per_square_m = static_cast<float>(kHeightSigmas * camera.noise.per_square_m);
  gate_.step = StepLimitOf(camera, config_.join_sigmas, config_.join_slope);
  gate_.step.fixed_m += static_cast<float>(config_.join_fixed_m);
}

RowGate PeopleFinder::GateOf(const DepthCamera& camera, int row) const {
  RowGate gate = gate_;
  gate.lean =
      static_cast<float>(room_.room_from_camera.row(2).dot(camera.Ray(0.0, row).transpose()));
  return gate;
}

/// Heights at which much lies level.
void PeopleFinder::FindTops(const DepthView& depth) {
  const DepthCamera& camera = depth.camera();
  const int distance_px = std::max(2, camera.height_px / kLevelRows);
  is_level_.assign(depth.z_m().size(), 0);
  level_area_.assign(kTopBins, 0.0F);
  const double lean_per_row = room_.room_from_camera(2, 1) / camera.focal_px.y();
  for (int v = distance_px; v < camera.height_px - distance_px; ++v) {
    const auto width = static_cast<std::ptrdiff_t>(camera.width_px);
    const float* row_m = depth.z_m().data() + v * width;
    const RowGate gate = GateOf(camera, v);
    std::uint8_t* is_level = is_level_.data() + v * width;
    MarkLevelRow(row_m - distance_px * width, row_m, row_m + distance_px * width, camera.width_px,
                 gate, static_cast<float>(lean_per_row),
                 static_cast<float>(1.0 / camera.focal_px.y()), distance_px, is_level);
    AddLevelArea(row_m, is_level, camera.width_px, gate, level_area_.data(), kTopBins);
  }
  ChooseTops(camera);
}

/// The largest sums of neighbouring centimetres, until no top is large enough.
void PeopleFinder::ChooseTops(const DepthCamera& camera) {
  tops_ = {};
  tops_.tolerance_m = static_cast<float>(config_.top_thickness_m);
  const double least = config_.least_top_m2 * camera.focal_px.prod();
  while (tops_.count < Tops::kMost) {
    int best = 1;
    float best_area = 0.0F;
    for (int bin = 1; bin + 1 < kTopBins; ++bin) {
      const auto at = static_cast<std::size_t>(bin);
      const float area = level_area_[at - 1] + level_area_[at] + level_area_[at + 1];
      if (area > best_area) {
        best_area = area;
        best = bin;
      }
    }
    if (static_cast<double>(best_area) < least) return;
    tops_.height_m[tops_.count++] = 0.01F * (static_cast<float>(best) + 0.5F);
    std::fill_n(level_area_.begin() + best - 1, 3, 0.0F);
  }
}

void PeopleFinder::Link(const DepthView& depth, const std::vector<std::uint8_t>& is_sound) {
  const DepthCamera& camera = depth.camera();
  const auto width = static_cast<std::size_t>(camera.width_px);
  links_.assign(width, 0);
  is_inside_.assign(2 * width, 0);
  runs_.Start(camera.width_px, camera.height_px);
  for (int v = 0; v < camera.height_px; ++v) {
    const std::size_t row = static_cast<std::size_t>(v) * width;
    const float* row_m = depth.z_m().data() + row;
    std::uint8_t* is_inside = is_inside_.data() + (v % 2) * camera.width_px;
    const std::uint8_t* above_inside = is_inside_.data() + ((v + 1) % 2) * camera.width_px;
    GateRow(row_m, is_sound.data() + row, camera.width_px, GateOf(camera, v), tops_,
            is_level_.data() + row, is_inside);
    LinkRow(v > 0 ? row_m - width : row_m, row_m, above_inside, is_inside, camera.width_px,
            gate_.step, links_.data());
    if (!territory_.is_empty()) territory_.Cut(v, links_.data());
    runs_.AddRow(links_.data());
  }
  runs_.Finish();
}

void PeopleFinder::Group(const DepthView& depth) {
  groups_.Form(config_.shape, pieces_, territory_.OwnersOf(runs_, pieces_.count(), kSeedShare),
               has_floor_ ? std::optional(0.0) : std::nullopt);
  evidences_.Gather(depth, room_, runs_, groups_.group_of_core(), groups_.cores());
}

void PeopleFinder::Rank() {
  ranked_.clear();
  ranked_.reserve(SurfacePieces::kMost);
  for (int i = 0; i < groups_.count(); ++i) {
    if (Likeness(i) >= config_.least_likeness) ranked_.push_back(i);
  }
  std::sort(ranked_.begin(), ranked_.end(), [this](int a, int b) {
    return std::pair(-Likeness(a), a) < std::pair(-Likeness(b), b);
  });
}

double PeopleFinder::Likeness(int group) const {
  if (groups_.OwnerOf(group) != 0) return 1.0;
  const SurfaceShape& core = groups_.cores()[static_cast<std::size_t>(group)];
  return LikenessOf(evidences_.of(group), core, core.highest_m.z() - Ground(group));
}

double PeopleFinder::Ground(int group) const {
  return has_floor_ ? 0.0 : groups_.shape(group).lowest_m.z();
}

PersonRegion PeopleFinder::RegionOf(int group) const {
  const SurfaceShape& shape = groups_.shape(group);
  PersonRegion region;
  region.area_m2 = shape.area_m2;
  region.centroid_m = room_.room_from_camera.transpose() *
                      (shape.Mean() - Eigen::Vector3d(0.0, 0.0, room_.camera_height_m));
  region.top_m = shape.highest_m.z() - Ground(group);
  region.bottom_m = shape.lowest_m.z() - Ground(group);
  region.likeness = Likeness(group);
  region.seed = groups_.OwnerOf(group);
  return region;
}

void PeopleFinder::Write(const DepthView& depth) {
  Rank();
  regions_.regions.clear();
  regions_.regions.reserve(SurfacePieces::kMost);
  label_of_group_.reserve(SurfacePieces::kMost);
  label_of_group_.assign(static_cast<std::size_t>(groups_.count()), 0);
  for (const int group : ranked_) {
    regions_.regions.push_back(RegionOf(group));
    const auto label = static_cast<int>(regions_.regions.size());
    regions_.regions.back().label = label;
    label_of_group_[static_cast<std::size_t>(group)] = static_cast<std::uint8_t>(label);
  }
  regions_.labels.assign(depth.z_m().size(), 0);
  for (const SurfaceRun& run : runs_.runs()) {
    const int group = run.component < 0 ? -1 : groups_.GroupOf(run.component);
    const std::uint8_t label =
        group < 0 ? std::uint8_t{0} : label_of_group_[static_cast<std::size_t>(group)];
    if (label == 0) continue;
    PersonRegion& region = regions_.regions[label - 1U];
    region.pixel_count += run.end_px - run.begin_px;
    region.box_px |= cv::Rect(run.begin_px, run.row_px, run.end_px - run.begin_px, 1);
    auto* row = regions_.labels.data() + run.row_px * static_cast<std::ptrdiff_t>(depth.width_px());
    std::fill(row + run.begin_px, row + run.end_px, label);
  }
}

/// Heads that no region has: their bodies are one surface with something else, or look unlike
/// people from the shoulders down.
void PeopleFinder::AddHeads(const DepthView& depth, const std::vector<std::uint8_t>& is_sound) {
  const Eigen::Vector3d up = room_.room_from_camera.row(2).transpose();
  regions_.heads = heads_.Find(depth, is_sound, up, config_.near_m, config_.far_m);
  const int width = depth.width_px();
  for (const HeadShape& head : regions_.heads) {
    const auto middle = static_cast<std::size_t>(head.v_px * width + head.u_px);
    if (head.likeness < config_.least_head) break;
    if (regions_.labels[middle] != 0 || regions_.regions.size() >= SurfacePieces::kMost) continue;
    const double height_m = room_.FromCamera(head.middle_m).z();
    const HeadReach reach{config_.head_reach_m, config_.head_depth_m, kLiftedArms_m,
                          has_floor_ ? height_m - config_.lowest_m : kBelowHead_m, gate_.step};
    if (has_floor_ && (height_m < config_.shape.lowest_top_m || height_m > config_.highest_m)) {
      continue;
    }
    AddRegion(depth, head, head_region_.Find(depth, is_sound, regions_.labels, head, up, reach));
  }
}

void PeopleFinder::AddRegion(const DepthView& depth, const HeadShape& head,
                             const std::vector<int>& pixels) {
  PersonRegion region;
  region.label = static_cast<int>(regions_.regions.size()) + 1;
  region.pixel_count = static_cast<int>(pixels.size());
  region.likeness = config_.least_likeness;
  double low_m = kAnyHeight_m;
  for (const int pixel : pixels) {
    const int u = pixel % depth.width_px(), v = pixel / depth.width_px();
    regions_.labels[static_cast<std::size_t>(pixel)] = static_cast<std::uint8_t>(region.label);
    const Eigen::Vector3d point_m = depth.Point(u, v);
    region.centroid_m += point_m / region.pixel_count;
    region.area_m2 += point_m.z() * point_m.z() / depth.camera().focal_px.prod();
    const double height_m = room_.FromCamera(point_m).z();
    low_m = std::min(low_m, height_m);
    region.box_px |= cv::Rect(u, v, 1, 1);
  }
  const double ground_m = has_floor_ ? 0.0 : low_m;
  region.top_m = room_.FromCamera(head.top_m).z() - ground_m;
  region.bottom_m = low_m - ground_m;
  regions_.regions.push_back(region);
}

}  // namespace deixis::pose_fitter
