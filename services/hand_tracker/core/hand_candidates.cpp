#include "services/hand_tracker/core/hand_candidates.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "services/hand_tracker/core/region_geodesics.h"

namespace deixis::hand_tracker {
namespace {

constexpr double kShoulderReach = 0.9;  // In hand lengths: half an upper arm.

int Farthest(const std::vector<int>& distances) {
  return static_cast<int>(std::max_element(distances.begin(), distances.end()) - distances.begin());
}

/// Index of the shoulder that is nearest to the region; -1 = none is known.
int NearestShoulder(const RegionGeodesics& region, const std::vector<Eigen::Vector2d>& shoulders) {
  int nearest = -1;
  double least = std::numeric_limits<double>::max();
  for (std::size_t i = 0; i < shoulders.size(); ++i) {
    const Eigen::Vector2d closest = region.point(region.NearestTo(shoulders[i])).cast<double>();
    const double distance = (closest - shoulders[i]).norm();
    if (distance < least) {
      least = distance;
      nearest = static_cast<int>(i);
    }
  }
  return nearest;
}

/// Pixel from which the search for the ends starts: the one nearest to a shoulder.
int ProximalPixel(const RegionGeodesics& region, const std::vector<Eigen::Vector2d>& shoulders) {
  const int shoulder = NearestShoulder(region, shoulders);
  return shoulder >= 0 ? region.NearestTo(shoulders[static_cast<std::size_t>(shoulder)]) : 0;
}

/// An end of a region, with the distances of all its pixels from there.
struct RegionEnd {
  int tip = 0;
  std::vector<int> distances;
};

RegionEnd EndAt(const RegionGeodesics& region, int tip) { return {tip, region.DistancesFrom(tip)}; }

/// Twice the length of the side branch on which `pixel` lies, away from the way between two ends.
int Detour(const RegionEnd& a, const RegionEnd& b, std::size_t pixel) {
  return a.distances[pixel] + b.distances[pixel] - a.distances[static_cast<std::size_t>(b.tip)];
}

/// The pixel farthest out on a branch that none of the ways between `ends` passes; its branch must
/// be at least `least` long. -1 = there is none.
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

/// The ends at which hands may be. The `root`, nearest to a shoulder, is none where one is known.
/// Arms that touch make a region with more than two ends.
std::vector<RegionEnd> FindEnds(const RegionGeodesics& region, int root, double hand_length_px,
                                bool knows_shoulder) {
  constexpr double kBranchLength = 0.6;  // In hand lengths; fingers are shorter.
  constexpr double kLimbLength = 1.35;   // In hand lengths: longer regions have a second end.
  constexpr std::size_t kMostEnds = 4;
  const double unit = RegionGeodesics::kStep * hand_length_px;
  const RegionEnd start = EndAt(region, root);
  std::vector<RegionEnd> ends;
  if (!knows_shoulder) {
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
  if (knows_shoulder) ends.erase(ends.begin());
  return ends;
}

bool IsFresh(const SkinPicture& picture, const Eigen::Vector2i& point) {
  return !picture.fresh.empty() && picture.fresh.at<std::uint8_t>(point.y(), point.x()) != 0;
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
    if (IsFresh(picture, point)) hand.fresh_share += 1.0;
    low = low.min(point.array());
    high = high.max(point.array());
  }
  hand.centre /= mass;
  hand.moving_share /= hand.area_px;
  hand.fresh_share /= hand.area_px;
  const Eigen::Array2i size = high - low + 1;
  hand.box = {low.x() - 0.5, low.y() - 0.5, static_cast<double>(size.x()),
              static_cast<double>(size.y())};
  hand.region_length_px =
      distances[static_cast<std::size_t>(Farthest(distances))] / double{RegionGeodesics::kStep};
  return hand;
}

/// A bare leg or a table that a hand touches makes the region longer than any arm: it is then cut
/// off where the fingers of a stretched arm would end.
SkinRegion WithinArmsReach(const SkinRegion& region, double hand_length_px,
                           const std::vector<Eigen::Vector2d>& shoulders) {
  constexpr double kFingertip = 3.4;  // From the shoulder, hand lengths.
  constexpr double kTooFar = 4.6;
  SkinRegion within;
  double farthest = 0.0;
  for (const Run& run : region.runs) {
    for (int x = run.first; x <= run.last; ++x) {
      double nearest = std::numeric_limits<double>::max();
      for (const Eigen::Vector2d& shoulder : shoulders) {
        nearest = std::min(nearest, (Eigen::Vector2d(x, run.row) - shoulder).norm());
      }
      farthest = std::max(farthest, nearest);
      if (nearest < kFingertip * hand_length_px) AddRun({run.row, x, x}, within);
    }
  }
  const bool has_leg = !shoulders.empty() && farthest > kTooFar * hand_length_px;
  return has_leg && within.area_px > 0 ? within : region;
}

/// The middle of the area lies nearer to the fingers than the hand's centre (0.4 wrist + 0.6 middle
/// knuckle), where a sleeve ends the region at the wrist; a bare arm makes up for it.
Eigen::Vector2d TowardsPalm(const HandCandidate& hand, double hand_length_px) {
  constexpr double kShift = 0.08;        // In hand lengths.
  constexpr double kSleeveLength = 1.4;  // Of the region, above which it is a bare arm.
  constexpr double kFade = 0.3;
  const Eigen::Vector2d along = hand.tip - hand.root;
  if (along.norm() < 0.4 * hand_length_px) return hand.centre;
  const double length = hand.region_length_px / hand_length_px;
  const double share = std::clamp((kSleeveLength - length) / kFade, 0.0, 1.0);
  return hand.centre - share * kShift * hand_length_px * along.normalized();
}

/// Whether the arm of which `piece` is a longish part goes on in the region of `next`: that begins
/// close to the piece's end, lies in its direction and leads farther away from the shoulder.
bool GoesOnIn(const HandCandidate& piece, const HandCandidate& next, double hand_length_px,
              const std::vector<Eigen::Vector2d>& shoulders) {
  constexpr double kLeastLength = 0.9;  // In hand lengths, like the gap.
  constexpr double kLargestGap = 0.8;
  if (piece.region == next.region || piece.shoulder < 0 ||
      piece.region_length_px < kLeastLength * hand_length_px) {
    return false;
  }
  const Eigen::Vector2d& shoulder = shoulders[static_cast<std::size_t>(piece.shoulder)];
  return (next.root - piece.tip).norm() < kLargestGap * hand_length_px &&
         (next.tip - shoulder).norm() > (piece.tip - shoulder).norm() &&
         (next.centre - piece.centre).dot(piece.tip - piece.root) > 0.0;
}

}  // namespace

std::vector<HandCandidate> FindCandidates(const SkinRegion& region, const SkinPicture& picture,
                                          double hand_length_px,
                                          const std::vector<Eigen::Vector2d>& shoulders) {
  const SkinRegion arm = WithinArmsReach(region, hand_length_px, shoulders);
  const RegionGeodesics geodesics(arm);
  const int shoulder = NearestShoulder(geodesics, shoulders);
  const int root = ProximalPixel(geodesics, shoulders);
  std::vector<HandCandidate> candidates;
  for (const RegionEnd& end : FindEnds(geodesics, root, hand_length_px, shoulder >= 0)) {
    HandCandidate hand = HandAt(geodesics, end.tip, end.distances, picture, hand_length_px);
    hand.root = geodesics.point(root).cast<double>();
    hand.shoulder = shoulder;
    if (shoulder >= 0) {
      hand.centre = TowardsPalm(hand, hand_length_px);
      const Eigen::Vector2d& place = shoulders[static_cast<std::size_t>(shoulder)];
      hand.shoulder_distance_px = (hand.centre - place).norm();
      hand.root_distance_px = (hand.root - place).norm();
    }
    hand.is_at_shoulder =
        std::any_of(shoulders.begin(), shoulders.end(), [&](const Eigen::Vector2d& place) {
          return (hand.centre - place).norm() < kShoulderReach * hand_length_px;
        });
    candidates.push_back(hand);
  }
  return candidates;
}

std::vector<HandCandidate> WithoutArmPieces(const std::vector<HandCandidate>& candidates,
                                            double hand_length_px,
                                            const std::vector<Eigen::Vector2d>& shoulders) {
  std::vector<HandCandidate> hands;
  for (const HandCandidate& piece : candidates) {
    const bool goes_on =
        std::any_of(candidates.begin(), candidates.end(), [&](const HandCandidate& next) {
          return GoesOnIn(piece, next, hand_length_px, shoulders);
        });
    if (!goes_on) hands.push_back(piece);
  }
  return hands;
}

double GuessHandLength(const SkinRegion& region) {
  constexpr double kLengthPerPalmRadius = 4.5;
  return kLengthPerPalmRadius * RegionGeodesics(region).WidestRadius();
}

}  // namespace deixis::hand_tracker
