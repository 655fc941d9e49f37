#pragma once
#include <optional>
#include <vector>

#include "services/pose_fitter/core/people/people_finder.h"
#include "services/pose_fitter/evaluation/people_sequence.h"

namespace deixis::pose_fitter {

/// How well people were found in the frames of one sequence, or of all.
struct PeopleScore {
  /// Compares what was found in `frame`, which has its truth. `is_sound`: see SoundDepth.
  void AddFrame(const PeopleFrame& frame, const PeopleRegions& found,
                const std::vector<std::uint8_t>& is_sound);
  void AddTime(double ms) { times_ms.push_back(ms); }
  void Add(const PeopleScore& other);

  int frames = 0;
  int people = 0;         ///< Of which at least kLeastPixels were measured, over all frames.
  int found_people = 0;   ///< Half of whose pixels one region holds.
  int false_regions = 0;  ///< Less than half of which is a person.
  std::int64_t person_pixels = 0;   ///< Measured within kNear_m of the truth.
  std::int64_t found_pixels = 0;    ///< Of these: in some region.
  std::int64_t unsound_pixels = 0;  ///< Of these: not trusted.
  std::int64_t region_pixels = 0;
  std::int64_t wrong_pixels = 0;  ///< Of these: no person there.
  int floors = 0;                 ///< Frames in which a floor was found.
  std::vector<double> tilts_deg;  ///< Between the floor's normal and the true one.
  std::vector<double> heights_m;  ///< Error of the camera's height.
  std::vector<double> times_ms;

  static constexpr int kLeastPixels = 200;
  static constexpr double kNear_m = 0.15;
};

/// The `share` quantile; nothing of nothing.
std::optional<double> Quantile(std::vector<double> values, double share);

}  // namespace deixis::pose_fitter
