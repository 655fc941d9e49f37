#pragma once
#include <Eigen/Core>
#include <optional>
#include <vector>

#include "common/config/config.h"

namespace deixis::pose_fitter {

struct PersonTracksConfig {
  int frames_to_start = 1;     ///< In a row, before somebody gets a number.
  double hidden_time_s = 2.0;  ///< Somebody not seen for so long is gone.
  double gate_m = 0.35;        ///< Someone in view is found again within this,
  double gate_m_per_s = 0.8;   ///< and so much further per second out of view.
  double largest_gate_m = 1.5;
  double position_sigma_m = 0.05;      ///< Noise of a measured position.
  double acceleration_m_per_s2 = 2.0;  ///< One sigma of what people's speed changes by.
  double still_time_s = 0.5;           ///< Time in which the speed of someone hidden fades.

  template <typename Visitor>
  void Visit(Visitor& v) {
    v("frames_to_start", frames_to_start);
    v("hidden_time_s", hidden_time_s);
    v("gate_m", gate_m);
    v("gate_m_per_s", gate_m_per_s);
    v("largest_gate_m", largest_gate_m);
    v("position_sigma_m", position_sigma_m);
    v("acceleration_m_per_s2", acceleration_m_per_s2);
    v("still_time_s", still_time_s);
  }
  void Validate() const;
};

/// Where somebody may be: the centre of a region, or the root of a fitted body.
struct PersonSighting {
  Eigen::Vector3d position_m = Eigen::Vector3d::Zero();
  /// Who it is, where something surer than the position tells (the seed of its region): that
  /// person's number; -1 = not known.
  int known_id = -1;
  bool may_start = true;  ///< Whether it is sure enough to become somebody new.
};

/// Somebody who is followed.
struct PersonTrack {
  int person_id = -1;                                    ///< -1 until seen often enough.
  Eigen::Vector3d position_m = Eigen::Vector3d::Zero();  ///< At the last update, in its frame.
  Eigen::Vector3d velocity_m_per_s = Eigen::Vector3d::Zero();
  double hidden_s = 0.0;  ///< Since last seen.
};

/// Keeps people's numbers while they walk, cross and hide each other. Positions are in any frame
/// that stands still, or moves little from image to image. Sightings are given to tracks so that
/// the sum of distances is smallest (Kuhn 1955).
class PersonTracks {
 public:
  static constexpr int kMost = 32;  ///< Tracks, and sightings that are heeded.

  explicit PersonTracks(const PersonTracksConfig& config = {});

  /// `time_s` increases; a step back forgets everybody, a step of more than `hidden_time_s` too.
  /// Returns the number of each sighting's person, -1 = nobody's yet. Valid until the next call.
  const std::vector<int>& Update(const std::vector<PersonSighting>& sightings, double time_s);

  const std::vector<PersonTrack>& tracks() const { return tracks_; }
  const PersonTrack* Find(int person_id) const;  ///< nullptr: nobody of that number.
  void Reset();  ///< Forgets everybody. Numbers are never given twice.

 private:
  struct State {
    double variance_position_m2 = 0.0;
    double variance_velocity = 0.0;
    double covariance = 0.0;
    int seen = 0;
  };

  void Predict(double elapsed_s);
  void Assign(const std::vector<PersonSighting>& sightings);
  double Cost(const PersonTrack& track, const PersonSighting& sighting) const;
  void Correct(std::size_t track, const PersonSighting& sighting);
  void Start(const PersonSighting& sighting);
  void Forget();

  PersonTracksConfig config_;
  int next_id_ = 0;
  double time_s_ = 0.0;
  bool has_time_ = false;
  std::vector<PersonTrack> tracks_;
  std::vector<State> states_;
  std::vector<int> track_of_sighting_;
  std::vector<int> ids_;
  std::vector<double> costs_;
};

/// Which column each row of a matrix is given, so that the sum of costs is smallest; `costs` are
/// `rows` x `columns`, row by row, rows <= columns. A cost of `never` or more is no pair: -1.
/// Takes O(rows^2 columns).
std::vector<int> CheapestPairs(const std::vector<double>& costs, int rows, int columns,
                               double never);

}  // namespace deixis::pose_fitter
