#include "services/pose_fitter/evaluation/people_score.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace deixis::pose_fitter {
namespace {

constexpr int kMostPeople = 3;  // Nobody and two people.
constexpr std::size_t kMostRegions = 256;

template <typename T>
void Append(std::vector<T>& to, const std::vector<T>& from) {
  to.insert(to.end(), from.begin(), from.end());
}

}  // namespace

void PeopleScore::AddFrame(const PeopleFrame& frame, const PeopleRegions& found,
                           const std::vector<std::uint8_t>& is_sound) {
  std::array<std::array<int, kMostRegions>, kMostPeople> overlap{};
  std::array<int, kMostPeople> sizes{};
  const auto total = static_cast<int>(frame.depth_mm.total());
  for (int i = 0; i < total; ++i) {
    const auto at = static_cast<std::size_t>(i);
    const int who = std::min<int>(frame.person.at<std::uint8_t>(i), kMostPeople - 1);
    const std::uint8_t label = found.labels[at];
    ++overlap[static_cast<std::size_t>(who)][label];
    region_pixels += label != 0;
    wrong_pixels += label != 0 && who == 0;
    const double off_m =
        0.001 * std::abs(frame.depth_mm.at<std::uint16_t>(i) - frame.true_mm.at<std::uint16_t>(i));
    if (who == 0 || frame.depth_mm.at<std::uint16_t>(i) == 0 || off_m > kNear_m) continue;
    ++sizes[static_cast<std::size_t>(who)];
    ++person_pixels;
    found_pixels += label != 0;
    unsound_pixels += is_sound[at] == 0;
  }
  ++frames;
  for (std::size_t who = 1; who < kMostPeople; ++who) {
    if (sizes[who] < kLeastPixels) continue;
    ++people;
    found_people += std::any_of(overlap[who].begin() + 1, overlap[who].end(),
                                [&](int shared) { return 2 * shared > sizes[who]; });
  }
  for (const PersonRegion& region : found.regions) {
    const auto label = static_cast<std::size_t>(region.label);
    const int person = overlap[1][label] + overlap[2][label];
    false_regions += 2 * person < region.pixel_count;
  }
  if (!found.floor) return;
  ++floors;
  const Eigen::Vector3d& normal = found.floor->normal;
  tilts_deg.push_back(
      180.0 / M_PI *
      std::atan2(normal.cross(frame.floor.normal).norm(), normal.dot(frame.floor.normal)));
  heights_m.push_back(std::abs(found.floor->offset_m - frame.floor.offset_m));
}

void PeopleScore::Add(const PeopleScore& other) {
  frames += other.frames;
  people += other.people;
  found_people += other.found_people;
  false_regions += other.false_regions;
  person_pixels += other.person_pixels;
  found_pixels += other.found_pixels;
  unsound_pixels += other.unsound_pixels;
  region_pixels += other.region_pixels;
  wrong_pixels += other.wrong_pixels;
  floors += other.floors;
  Append(tilts_deg, other.tilts_deg);
  Append(heights_m, other.heights_m);
  Append(times_ms, other.times_ms);
}

std::optional<double> Quantile(std::vector<double> values, double share) {
  if (values.empty()) return std::nullopt;
  const auto at = static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1) + 0.5);
  std::nth_element(values.begin(), values.begin() + at, values.end());
  return values[static_cast<std::size_t>(at)];
}

}  // namespace deixis::pose_fitter
