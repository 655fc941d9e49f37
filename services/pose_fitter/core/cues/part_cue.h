#pragma once
#include <Eigen/Core>
#include <optional>

namespace deixis::pose_fitter {

/// Of a hand, from the wrist to the end: where a cue means that its middle is, between the wrist
/// and the knuckle of the middle finger.
constexpr double kHandShare = 0.35;

enum class Part { kHand, kFace };

/// A part of somebody that was recognised in the colour picture: it lies on a viewing ray.
struct PartCue {
  Part part = Part::kHand;
  Eigen::Vector3d ray = Eigen::Vector3d::UnitZ();  ///< As DepthCamera::Ray.
  double sigma = 0.01;               ///< Spread across the ray at distance 1, one sigma.
  double right_probability = 0.5;    ///< Of a hand: that it is a right one.
  double trust = 1.0;                ///< Share of its weight that it has, 0..1.
  bool is_measured = true;           ///< An own region of the picture shows it.
  std::optional<double> distance_m;  ///< Measured there, along the optical axis.
};

}  // namespace deixis::pose_fitter
