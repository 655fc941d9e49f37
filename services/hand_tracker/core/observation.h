#pragma once
#include <vector>

#include "services/hand_tracker/core/hand_candidates.h"
#include "services/hand_tracker/core/people.h"
#include "services/hand_tracker/core/skin_regions.h"

namespace deixis::hand_tracker {

/// What the tracks are told about one image. Full image pixels.
struct Observation {
  std::vector<HandCandidate> candidates;
  std::vector<Person> people;
  double elapsed_s = 0.0;  ///< Since the last image.
};

/// How far from a face a region may lie and still be the person's, hand lengths.
inline constexpr double kRegionReach = 10.0;

/// The candidates in `regions` (working pixels, `scale` full pixels each), person by person, those
/// without a person last. `unknown_hand_px`: length of a hand whose person is unknown, working
/// pixels.
std::vector<HandCandidate> ObserveCandidates(const std::vector<SkinRegion>& regions,
                                             const SkinPicture& picture,
                                             const std::vector<Person>& people, double scale,
                                             double unknown_hand_px);

/// Appends those of `moving`, found by motion alone, that lie where none of `candidates` does.
void AddByMotion(const std::vector<HandCandidate>& moving, std::vector<HandCandidate>& candidates);

/// The person whose face is nearest to `point`, within `reach` hand lengths of it; nullptr =
/// nobody.
const Person* NearestPerson(const std::vector<Person>& people, const Eigen::Vector2d& point,
                            double reach);

}  // namespace deixis::hand_tracker
