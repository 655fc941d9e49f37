#include "services/hand_tracker/core/hand_candidates.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "services/hand_tracker/core/region_geodesics.h"

namespace deixis::hand_tracker {
namespace {

constexpr double kShoulderReach = 0.9;  // In hand lengths: half an upper arm.

int Farthest(const std::vector<int>& distances) {
  return static_cast<int>(std::max_element(distances.begin(), distances.end()) -
                          distances.begin());
}

/// The shoulder that is nearest to the region, or nothing.
const Eigen::Vector2d* NearestShoulder(const RegionGeodesics& region,
                                       const std::vector<Eigen::Vector2d>& shoulders) {
  const Eigen::Vector2d* nearest = nullptr;
  double least = std::numeric_limits<double>::max();
  for (const Eigen::Vector2d& shoulder : shoulders) {
    const double distance =
        (region.point(region.NearestTo(shoulder)).cast<double>() - shoulder).norm();
    if (distance < least) {
      least = distance;
      nearest = &shoulder;
    }
  }
  return nearest;
}

/// Pixel from which the search for the ends starts: the one nearest to a shoulder.
int ProximalPixel(const RegionGeodesics& region, const std::vector<Eigen::Vector2d>& shoulders) {
  const Eigen::Vector2d* shoulder = NearestShoulder(region, shoulders);
  return shoulder != nullptr ? region.NearestTo(*shoulder) : 0;
}

/// An end of a region, with the distances of all its pixels from there.
struct RegionEnd {
  int tip = 0;
  std::vector<int> distances;
};

RegionEnd EndAt(const RegionGeodesics& region, int tip) {
  return {tip, region.DistancesFrom(tip)};
}

/// Twice the length of the side branch on which `pixel` lies, away from the way between two ends.
int Detour(const RegionEnd& a, const RegionEnd& b, std::size_t pixel) {
  return a.distances[pixel] + b.distances[pixel] - a.distances[static_cast<std::size_t>(b.tip)];
}

/// The pixel farthest out on a branch that none of the ways between `ends` passes; its branch must be
/// at least `least` long. -1 = there is none.
int FarthestBranch(const std::vector<RegionEnd>& ends, int n_pixels, int least) {
  int farthest = -1;
  int longest = 2 * least;
  for (int pixel = 0; pixel < n_pixels; ++pixel) {
    int detour = std::numeric_limits<int>::max();
    for (std::size_t i = 0; i < ends.size(); ++i) {
      for (std::size_t j = 0; j < i; ++j) {
        detour = std::min(detour, Detour(ends[i], ends[j], static_cast<std::size_t>(pixel)));
      }
    }
    if (detour > longest) {
      longest = detour;
      farthest = pixel;
    }
  }
  return farthest;
}

/// The ends at which hands may be. The end nearest to a shoulder is none, unless the region is no longer
/// than a hand or no shoulder is known. Arms that touch make a region with more than two ends.
std::vector<RegionEnd> FindEnds(const RegionGeodesics& region, double hand_length_px,
                                const std::vector<Eigen::Vector2d>& shoulders) {
  constexpr double kBranchLength = 0.6;  // In hand lengths; fingers are shorter.
  constexpr double kLimbLength = 1.35;   // In hand lengths: longer regions have a second end.
  constexpr std::size_t kMostEnds = 4;
  const double unit = RegionGeodesics::kStep * hand_length_px;
  const RegionEnd start = EndAt(region, ProximalPixel(region, shoulders));
  std::vector<RegionEnd> ends;
  if (shoulders.empty()) {
    ends.push_back(EndAt(region, Farthest(start.distances)));
    const int other = Farthest(ends[0].distances);
    if (ends[0].distances[static_cast<std::size_t>(other)] < kLimbLength * unit) return ends;
    ends.push_back(EndAt(region, other));
  } else {
    ends = {start, EndAt(region, Farthest(start.distances))};
  }
  while (ends.size() < kMostEnds) {
    const int branch = FarthestBranch(ends, region.size(), static_cast<int>(kBranchLength * unit));
    if (branch < 0) break;
    ends.push_back(EndAt(region, branch));
  }
  if (!shoulders.empty()) ends.erase(ends.begin());
  return ends;
}

/// The hand at the end `tip`: pixels within a hand's length of it, weighed by their evidence.
HandCandidate HandAt(const RegionGeodesics& region, int tip, const std::vector<int>& distances,
                     const SkinPicture& picture, double hand_length_px) {
  const int reach = static_cast<int>(RegionGeodesics::kStep * hand_length_px);
  HandCandidate hand;
  hand.tip = region.point(tip).cast<double>();
  Eigen::Array2i low = region.point(tip);
  Eigen::Array2i high = low;
  double mass = 0.0;
  for (int i = 0; i < region.size(); ++i) {
    if (distances[static_cast<std::size_t>(i)] > reach) continue;
    const Eigen::Vector2i point = region.point(i);
    const double weight = picture.evidence.at<std::uint8_t>(point.y(), point.x());
    hand.centre += weight * point.cast<double>();
    mass += weight;
    hand.area_px += 1.0;
    if (picture.changed.at<std::uint8_t>(point.y(), point.x()) != 0) hand.moving_share += 1.0;
    low = low.min(point.array());
    high = high.max(point.array());
  }
  hand.centre /= mass;
  hand.moving_share /= hand.area_px;
  const Eigen::Array2i size = high - low + 1;
  hand.box = {low.x() - 0.5, low.y() - 0.5, static_cast<double>(size.x()),
              static_cast<double>(size.y())};
  hand.region_area_px = region.size();
  hand.region_length_px =
      distances[static_cast<std::size_t>(Farthest(distances))] / double{RegionGeodesics::kStep};
  return hand;
}

}  // namespace

std::vector<HandCandidate> FindCandidates(const SkinRegion& region, const SkinPicture& picture,
                                          double hand_length_px,
                                          const std::vector<Eigen::Vector2d>& shoulders) {
  const RegionGeodesics geodesics(region);
  std::vector<HandCandidate> candidates;
  for (const RegionEnd& end : FindEnds(geodesics, hand_length_px, shoulders)) {
    candidates.push_back(HandAt(geodesics, end.tip, end.distances, picture, hand_length_px));
    candidates.back().is_at_shoulder =
        std::any_of(shoulders.begin(), shoulders.end(), [&](const Eigen::Vector2d& shoulder) {
          return (candidates.back().centre - shoulder).norm() < kShoulderReach * hand_length_px;
        });
  }
  return candidates;
}

double GuessHandLength(const SkinRegion& region) {
  constexpr double kLengthPerPalmRadius = 4.5;
  return kLengthPerPalmRadius * RegionGeodesics(region).WidestRadius();
}

}  // namespace deixis::hand_tracker
