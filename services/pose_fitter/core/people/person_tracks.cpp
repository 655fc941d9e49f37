#include "services/pose_fitter/core/people/person_tracks.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace deixis::pose_fitter {
namespace {

constexpr double kNever = 1e6;
constexpr double kStartSpeed_m_per_s = 0.7;  // One sigma of the speed of somebody new.

}  // namespace

void PersonTracksConfig::Validate() const {
  config::Faults faults;
  faults.Require(frames_to_start > 0, "frames_to_start", "must be positive");
  faults.Require(hidden_time_s >= 0.0, "hidden_time_s", "must not be negative");
  faults.Require(gate_m > 0.0, "gate_m", "must be positive");
  faults.Require(gate_m_per_s >= 0.0, "gate_m_per_s", "must not be negative");
  faults.Require(largest_gate_m >= gate_m, "largest_gate_m", "must not be smaller than gate_m");
  faults.Require(position_sigma_m > 0.0, "position_sigma_m", "must be positive");
  faults.Require(acceleration_m_per_s2 > 0.0, "acceleration_m_per_s2", "must be positive");
  faults.Require(still_time_s > 0.0, "still_time_s", "must be positive");
  faults.ThrowIfAny();
}

/// The Hungarian method with potentials: one row after the other is given its column along the
/// cheapest chain of exchanges.
std::vector<int> CheapestPairs(const std::vector<double>& costs, int rows, int columns,
                               double never) {
  const auto cost = [&](int row, int column) {
    return costs[static_cast<std::size_t>(row * columns + column)];
  };
  std::vector<double> row_potential(static_cast<std::size_t>(rows) + 1, 0.0);
  std::vector<double> column_potential(static_cast<std::size_t>(columns) + 1, 0.0);
  std::vector<int> row_of(static_cast<std::size_t>(columns) + 1, -1);  // The last: a free start.
  std::vector<int> previous(static_cast<std::size_t>(columns) + 1, -1);
  const auto start = static_cast<std::size_t>(columns);
  for (int row = 0; row < rows; ++row) {
    std::vector<double> shortest(start + 1, std::numeric_limits<double>::infinity());
    std::vector<char> is_done(start + 1, 0);
    std::size_t column = start;
    row_of[start] = row;
    while (row_of[column] >= 0) {
      is_done[column] = 1;
      const int from = row_of[column];
      double step = std::numeric_limits<double>::infinity();
      std::size_t next = start;
      for (std::size_t c = 0; c < start; ++c) {
        if (is_done[c] != 0) continue;
        const double reduced = cost(from, static_cast<int>(c)) -
                               row_potential[static_cast<std::size_t>(from)] - column_potential[c];
        if (reduced < shortest[c]) {
          shortest[c] = reduced;
          previous[c] = static_cast<int>(column);
        }
        if (shortest[c] < step) {
          step = shortest[c];
          next = c;
        }
      }
      for (std::size_t c = 0; c <= start; ++c) {
        if (is_done[c] != 0) {
          row_potential[static_cast<std::size_t>(row_of[c])] += step;
          column_potential[c] -= step;
        } else {
          shortest[c] -= step;
        }
      }
      column = next;
    }
    while (column != start) {
      const auto before = static_cast<std::size_t>(previous[column]);
      row_of[column] = row_of[before];
      column = before;
    }
    row_of[start] = -1;
  }
  std::vector<int> pairs(static_cast<std::size_t>(rows), -1);
  for (std::size_t c = 0; c < start; ++c) {
    if (row_of[c] >= 0 && cost(row_of[c], static_cast<int>(c)) < never) {
      pairs[static_cast<std::size_t>(row_of[c])] = static_cast<int>(c);
    }
  }
  return pairs;
}

PersonTracks::PersonTracks(const PersonTracksConfig& config) : config_(config) {
  config_.Validate();
}

void PersonTracks::Reset() {
  tracks_.clear();
  states_.clear();
  has_time_ = false;
}

const PersonTrack* PersonTracks::Find(int person_id) const {
  for (const PersonTrack& track : tracks_) {
    if (track.person_id == person_id && person_id >= 0) return &track;
  }
  return nullptr;
}

const std::vector<int>& PersonTracks::Update(const std::vector<PersonSighting>& sightings,
                                             double time_s) {
  const double elapsed_s = has_time_ ? time_s - time_s_ : 0.0;
  if (elapsed_s < 0.0 || elapsed_s > config_.hidden_time_s) Reset();
  Predict(std::max(0.0, elapsed_s));
  time_s_ = time_s;
  has_time_ = true;
  Assign(sightings);
  ids_.assign(sightings.size(), -1);
  for (std::size_t i = 0; i < sightings.size(); ++i) {
    if (track_of_sighting_[i] >= 0) {
      const auto track = static_cast<std::size_t>(track_of_sighting_[i]);
      Correct(track, sightings[i]);
      ids_[i] = tracks_[track].person_id;
    } else if (sightings[i].may_start && static_cast<int>(tracks_.size()) < kMost) {
      Start(sightings[i]);
      ids_[i] = tracks_.back().person_id;
    }
  }
  Forget();
  return ids_;
}

/// Constant velocity; that of somebody hidden fades, since people stop and turn.
void PersonTracks::Predict(double elapsed_s) {
  const double pushed = config_.acceleration_m_per_s2 * config_.acceleration_m_per_s2 * elapsed_s;
  for (std::size_t i = 0; i < tracks_.size(); ++i) {
    PersonTrack& track = tracks_[i];
    State& state = states_[i];
    track.position_m += elapsed_s * track.velocity_m_per_s;
    if (track.hidden_s > 0.0) {
      track.velocity_m_per_s *= std::exp(-elapsed_s / config_.still_time_s);
    }
    track.hidden_s += elapsed_s;
    state.variance_position_m2 +=
        elapsed_s * (2.0 * state.covariance + elapsed_s * state.variance_velocity) +
        pushed * elapsed_s * elapsed_s / 3.0;
    state.covariance += elapsed_s * state.variance_velocity + pushed * elapsed_s / 2.0;
    state.variance_velocity += pushed;
  }
}

double PersonTracks::Cost(const PersonTrack& track, const PersonSighting& sighting) const {
  const double distance_m = (track.position_m - sighting.position_m).norm();
  if (sighting.known_id >= 0) return sighting.known_id == track.person_id ? 0.0 : kNever;
  const double gate_m =
      std::min(config_.largest_gate_m, config_.gate_m + config_.gate_m_per_s * track.hidden_s);
  return distance_m < gate_m ? distance_m : kNever;
}

void PersonTracks::Assign(const std::vector<PersonSighting>& sightings) {
  track_of_sighting_.assign(sightings.size(), -1);
  const int rows = static_cast<int>(std::min<std::size_t>(sightings.size(), kMost));
  const auto tracks = static_cast<int>(tracks_.size());
  const int columns = tracks + rows;  // As many again, at the price of no pair.
  costs_.assign(static_cast<std::size_t>(rows * columns), kNever);
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < tracks; ++column) {
      costs_[static_cast<std::size_t>(row * columns + column)] =
          Cost(tracks_[static_cast<std::size_t>(column)], sightings[static_cast<std::size_t>(row)]);
    }
  }
  const auto pairs = CheapestPairs(costs_, rows, columns, kNever);
  std::copy(pairs.begin(), pairs.end(), track_of_sighting_.begin());
}

void PersonTracks::Correct(std::size_t index, const PersonSighting& sighting) {
  PersonTrack& track = tracks_[index];
  State& state = states_[index];
  const double noise = config_.position_sigma_m * config_.position_sigma_m;
  const double total = state.variance_position_m2 + noise;
  const double gain = state.variance_position_m2 / total;
  const double velocity_gain = state.covariance / total;
  const Eigen::Vector3d error_m = sighting.position_m - track.position_m;
  track.position_m += gain * error_m;
  track.velocity_m_per_s += velocity_gain * error_m;
  track.hidden_s = 0.0;
  state.variance_velocity -= velocity_gain * state.covariance;
  state.variance_position_m2 *= 1.0 - gain;
  state.covariance *= 1.0 - gain;
  ++state.seen;
  if (track.person_id < 0 && state.seen >= config_.frames_to_start) track.person_id = next_id_++;
}

void PersonTracks::Start(const PersonSighting& sighting) {
  PersonTrack track;
  track.position_m = sighting.position_m;
  State state;
  state.variance_position_m2 = config_.position_sigma_m * config_.position_sigma_m;
  state.variance_velocity = kStartSpeed_m_per_s * kStartSpeed_m_per_s;
  state.seen = 1;
  if (state.seen >= config_.frames_to_start) track.person_id = next_id_++;
  tracks_.push_back(track);
  states_.push_back(state);
}

/// Those gone for long, and those that were no one: missed before they had a number.
void PersonTracks::Forget() {
  std::size_t kept = 0;
  for (std::size_t i = 0; i < tracks_.size(); ++i) {
    const PersonTrack& track = tracks_[i];
    const bool is_gone =
        track.person_id < 0 ? track.hidden_s > 0.0 : track.hidden_s > config_.hidden_time_s;
    if (is_gone) continue;
    tracks_[kept] = tracks_[i];
    states_[kept++] = states_[i];
  }
  tracks_.resize(kept);
  states_.resize(kept);
}

}  // namespace deixis::pose_fitter
