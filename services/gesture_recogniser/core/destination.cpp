#include "services/gesture_recogniser/core/destination.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "common/filtering/log_probability.h"

namespace deixis::gesture_recogniser {

using filtering::kImpossible;
using filtering::kTwoPi;
using filtering::LogAdd;
using filtering::LogNormal;
using filtering::LogPlaneNormal;

namespace {

constexpr double kUpperArm_m = 0.28;           // Shoulder to elbow.
constexpr double kForearm_m = 0.31;            // Elbow to the hand's centre.
constexpr double kShoulderBelowFace_m = 0.08;  // Image plane, a person who faces the camera.
constexpr double kShoulderAside_m = 0.13;
// Log-odds against a return to rest by a way that leads away from it.
constexpr double kLeavesRest_log_odds = 6.0;
// A way shorter than this share of its sigma counts as so long: its direction is any.
constexpr double kShortestWay_sigmas = 0.2;
constexpr double kRootOfTwoPi = 2.5;  // Rounded: integral of a normal density of height 1.

/// Area of the ring that a normal density of spread `sigma` at distance `gap` around a box covers.
double LogRing(const scene::Box& box_m, double gap_m) {
  return std::log(2.0 * (box_m.width_px + box_m.height_px) + kTwoPi * gap_m);
}

/// Log-density of a direction that may be any.
const double kAnyDirection = -std::log(kTwoPi);

double AngleBetween(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  return std::abs(std::atan2(a.x() * b.y() - a.y() * b.x(), a.dot(b)));
}

}  // namespace

Eigen::Vector2d ForearmDirection(const Eigen::Vector2d& shoulder_m, const Eigen::Vector2d& hand_m,
                                 double sag) {
  const Eigen::Vector2d arm = hand_m - shoulder_m;
  const double length = arm.norm();
  if (length < 1e-6) return Eigen::Vector2d::Zero();
  // Angle at the hand of the triangle shoulder, elbow, hand.
  const double cosine = (kForearm_m * kForearm_m + length * length - kUpperArm_m * kUpperArm_m) /
                        (2.0 * kForearm_m * length);
  const double bend = sag * std::acos(std::clamp(cosine, -1.0, 1.0)) * std::abs(arm.x()) / length;
  // The elbow hangs below the line, so that the forearm points above it; image y is down.
  return Eigen::Rotation2Dd(arm.x() > 0.0 ? -bend : bend) * arm;
}

Eigen::Vector2d ShoulderFromFace(const scene::Box& face_m, scene::Side side) {
  Eigen::Vector2d shoulder = scene::Centre(face_m);
  shoulder.y() = face_m.y_px + face_m.height_px + kShoulderBelowFace_m;
  if (side == scene::Side::kLeft) shoulder.x() += kShoulderAside_m;
  if (side == scene::Side::kRight) shoulder.x() -= kShoulderAside_m;
  return shoulder;
}

void DestinationConfig::Validate() const {
  config::Faults faults;
  faults.Require(elsewhere_weight > 0.0, "elsewhere_weight", "must be positive");
  faults.Require(rest_weight > 0.0, "rest_weight", "must be positive");
  faults.Require(face_weight > 0.0, "face_weight", "must be positive");
  faults.Require(reach_m2 > 0.0, "reach_m2", "must be positive");
  faults.Require(rest_spread_m > 0.0, "rest_spread_m", "must be positive");
  faults.Require(face_spread_m > 0.0, "face_spread_m", "must be positive");
  faults.Require(gap_extra_m >= 0.0, "gap_extra_m", "must not be negative");
  faults.Require(stray_share > 0.0 && stray_share < 1.0, "stray_share", "must lie in (0, 1)");
  faults.Require(rest_return_m >= 0.0, "rest_return_m", "must not be negative");
  faults.Require(elbow_sag >= 0.0 && elbow_sag <= 1.0, "elbow_sag", "must lie in [0, 1]");
  faults.Require(arrival_s > 0.0 && arrival_s <= 10.0, "arrival_s", "must lie in (0, 10]");
  faults.ThrowIfAny();
}

Destinations::Destinations(const DestinationConfig& config, const TargetStatistics& statistics)
    : config_(config), statistics_(statistics) {}

DestinationDensities Destinations::Judge(const Arrival& arrival, const Surroundings& surroundings,
                                         const std::optional<Eigen::Vector2d>& rest_m,
                                         scene::Side side) const {
  const auto& face_m = surroundings.face_m;
  const auto targets = std::max<std::size_t>(surroundings.targets.size(), 1);
  Approach approach{arrival, WaySigma(arrival), std::log(1.0 / static_cast<double>(targets)), {}};
  if (config_.use_posture && face_m) {
    approach.forearm =
        ForearmDirection(ShoulderFromFace(*face_m, side), arrival.position_m, config_.elbow_sag);
  }
  DestinationDensities densities;
  for (const Target& target : surroundings.targets) {
    densities.target.push_back(LogTarget(approach, target.box_m));
  }
  densities.elsewhere = std::log(config_.elsewhere_weight / config_.reach_m2) + kAnyDirection;
  densities.rest = rest_m ? LogRest(arrival, *rest_m) + kAnyDirection : kImpossible;
  densities.face = face_m ? LogFace(arrival, *face_m) + kAnyDirection : kImpossible;
  return densities;
}

double Destinations::LogTarget(const Approach& approach, const scene::Box& box_m) const {
  const Eigen::Vector2d direction = scene::Centre(box_m) - approach.arrival.position_m;
  double density = approach.log_share + LogGap(box_m, approach.arrival) +
                   LogDirection(direction, approach.way_sigma_rad, approach.arrival.way_m);
  if (approach.forearm) {
    density +=
        LogDirection(direction, statistics_.posture_spread_rad, *approach.forearm) - kAnyDirection;
  }
  return density;
}

double Destinations::WaySigma(const Arrival& arrival) const {
  const double length_m = std::max(arrival.way_m.norm(), kShortestWay_sigmas * arrival.way_sigma_m);
  return std::hypot(statistics_.direction_spread_rad, std::atan2(arrival.way_sigma_m, length_m));
}

double Destinations::LogGap(const scene::Box& box_m, const Arrival& arrival) const {
  const double spread = std::hypot(statistics_.gap_spread_m, config_.gap_extra_m, arrival.sigma_m);
  const double gap = scene::DistanceTo(box_m, arrival.position_m);
  return LogNormal(gap - statistics_.gap_m, spread) - LogRing(box_m, statistics_.gap_m);
}

double Destinations::LogDirection(const Eigen::Vector2d& direction, double sigma_rad,
                                  const Eigen::Vector2d& way) const {
  const double angle = AngleBetween(direction, way);
  return LogAdd(std::log(1.0 - config_.stray_share) + LogNormal(angle, sigma_rad),
                std::log(config_.stray_share / kTwoPi));
}

double Destinations::LogRest(const Arrival& arrival, const Eigen::Vector2d& rest_m) const {
  const double distance = (arrival.position_m - rest_m).norm();
  const double spread = std::hypot(config_.rest_spread_m, arrival.sigma_m);
  // What starts at rest does not return to it by going away from it.
  const bool returns = arrival.nearest_rest_m >= distance + config_.rest_return_m;
  return std::log(config_.rest_weight) + LogPlaneNormal(distance, spread) -
         (returns ? 0.0 : kLeavesRest_log_odds);
}

double Destinations::LogFace(const Arrival& arrival, const scene::Box& face_m) const {
  const double spread = std::hypot(config_.face_spread_m, arrival.sigma_m);
  const double distance = scene::DistanceTo(face_m, arrival.position_m);
  const double area = face_m.width_px * face_m.height_px +
                      kRootOfTwoPi * (face_m.width_px + face_m.height_px) * spread +
                      0.5 * kTwoPi * spread * spread;
  return std::log(config_.face_weight / area) - 0.5 * distance * distance / (spread * spread);
}

}  // namespace deixis::gesture_recogniser
