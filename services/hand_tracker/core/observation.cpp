#include "services/hand_tracker/core/observation.h"

#include <algorithm>
#include <iterator>
#include <limits>

#include "services/hand_tracker/core/working_image.h"

namespace deixis::hand_tracker {
namespace {

constexpr double kSmallest = 0.6;   // Hand among those of a picture, of the largest.
constexpr double kFaceReach = 1.1;  // From the face's centre, hand lengths: hair, ears, neck.

Eigen::Vector2d RegionCentre(const SkinRegion& region, double scale) {
  return ToFull(0.5 * Eigen::Vector2d(region.left + region.right, region.top + region.bottom),
                scale);
}

HandCandidate InFullPixels(const HandCandidate& candidate, double scale) {
  HandCandidate full = candidate;
  full.centre = ToFull(candidate.centre, scale);
  full.tip = ToFull(candidate.tip, scale);
  full.root = ToFull(candidate.root, scale);
  full.box = ToFull(candidate.box, scale);
  full.area_px *= scale * scale;
  full.region_length_px *= scale;
  full.root_distance_px *= scale;
  full.shoulder_distance_px *= scale;
  full.hand_length_px *= scale;
  return full;
}

/// Appends `hands`, all of one region.
void Append(const std::vector<HandCandidate>& hands, std::size_t region, double hand_length_px,
            std::vector<HandCandidate>& candidates) {
  for (const HandCandidate& hand : hands) {
    candidates.push_back(hand);
    candidates.back().region = static_cast<int>(region);
    candidates.back().hand_length_px = hand_length_px;
  }
}

/// Where no shoulder is known: an arm comes in over the picture's edge, and its other end is the
/// hand.
std::vector<HandCandidate> WithoutArmEnds(const std::vector<HandCandidate>& ends,
                                          const SkinPicture& picture) {
  const auto is_at_edge = [&picture](const HandCandidate& hand) {
    const double right = hand.box.x_px + hand.box.width_px;
    const double bottom = hand.box.y_px + hand.box.height_px;
    return hand.box.x_px < 1.0 || hand.box.y_px < 1.0 || right > picture.evidence.cols - 2.0 ||
           bottom > picture.evidence.rows - 2.0;
  };
  std::vector<HandCandidate> hands;
  std::copy_if(ends.begin(), ends.end(), std::back_inserter(hands),
               [&](const HandCandidate& hand) { return !is_at_edge(hand); });
  return hands.empty() ? ends : hands;
}

/// Candidates in the regions that are nearest to `person`, working pixels.
std::vector<HandCandidate> CandidatesOf(const Person& person,
                                        const std::vector<SkinRegion>& regions,
                                        const std::vector<const Person*>& owners,
                                        const SkinPicture& picture, double scale) {
  const double hand_length = HandLength(person) / scale;
  std::vector<Eigen::Vector2d> shoulders;
  for (const Eigen::Vector2d& shoulder : Shoulders(person)) {
    shoulders.push_back(ToWorking(shoulder, scale));
  }
  std::vector<HandCandidate> candidates;
  for (std::size_t i = 0; i < regions.size(); ++i) {
    if (owners[i] != &person) continue;
    Append(FindCandidates(regions[i], picture, hand_length, shoulders), i, hand_length, candidates);
  }
  candidates = WithoutArmPieces(candidates, hand_length, shoulders);
  for (HandCandidate& hand : candidates) {
    hand.is_at_face = DistanceFromFace(person, ToFull(hand.centre, scale)) < kFaceReach;
  }
  return candidates;
}

}  // namespace

std::vector<HandCandidate> ObserveCandidates(const std::vector<SkinRegion>& regions,
                                             const SkinPicture& picture,
                                             const std::vector<Person>& people, double scale,
                                             double unknown_hand_px) {
  std::vector<const Person*> owners;
  for (const SkinRegion& region : regions) {
    owners.push_back(NearestPerson(people, RegionCentre(region, scale), kRegionReach));
  }
  std::vector<HandCandidate> candidates;
  for (const Person& person : people) {
    for (HandCandidate hand : CandidatesOf(person, regions, owners, picture, scale)) {
      hand.person = static_cast<int>(&person - people.data());
      candidates.push_back(hand);
    }
  }
  for (std::size_t i = 0; i < regions.size(); ++i) {
    if (owners[i] != nullptr) continue;
    const double hand_length =
        std::clamp(GuessHandLength(regions[i]), kSmallest * unknown_hand_px, unknown_hand_px);
    Append(WithoutArmEnds(FindCandidates(regions[i], picture, hand_length, {}), picture), i,
           hand_length, candidates);
  }
  for (HandCandidate& candidate : candidates) candidate = InFullPixels(candidate, scale);
  return candidates;
}

void AddByMotion(const std::vector<HandCandidate>& moving, std::vector<HandCandidate>& candidates) {
  constexpr double kSamePlace = 0.4;  // Hand lengths.
  for (const HandCandidate& candidate : moving) {
    const bool is_known =
        std::any_of(candidates.begin(), candidates.end(), [&](const HandCandidate& known) {
          return (known.centre - candidate.centre).norm() < kSamePlace * candidate.hand_length_px;
        });
    if (is_known) continue;
    candidates.push_back(candidate);
    candidates.back().region = -1;
    candidates.back().is_by_motion_alone = true;
  }
}

const Person* NearestPerson(const std::vector<Person>& people, const Eigen::Vector2d& point,
                            double reach) {
  const Person* nearest = nullptr;
  double least = std::numeric_limits<double>::max();
  for (const Person& person : people) {
    if (DistanceFromFace(person, point) > reach) continue;
    const double distance = (point - scene::Centre(person.face)).norm();
    if (distance < least) {
      least = distance;
      nearest = &person;
    }
  }
  return nearest;
}

}  // namespace deixis::hand_tracker
