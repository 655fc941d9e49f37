#pragma once
#include <Eigen/Core>
#include <string>
#include <vector>

namespace deixis::range_of_motion {

/// Where a limb may point at: directions around a rest direction, up to a boundary whose distance
/// from it, an angle, changes linearly with the angle around it from knot to knot (a reach cone,
/// Wilhelms and Van Gelder, "Fast and easy reach-cone joint limits", 2001, in polar form).
class ReachCone {
 public:
  struct Knot {
    std::string motion;         ///< What gets there; empty = unnamed.
    Eigen::Vector3d direction;  ///< Unit, in the frame whose z is the rest direction.
  };
  /// How far a direction lies from the rest direction and how far the boundary does there.
  struct Place {
    double angle_rad = 0.0;
    double boundary_rad = 0.0;
    int knot = 0;  ///< The nearest one around the rest direction.
  };

  ReachCone() = default;
  /// Throws std::invalid_argument when a gap between neighbouring knots is half a turn or more, or
  /// a knot is the rest direction or its opposite.
  explicit ReachCone(const std::vector<Knot>& knots);

  bool empty() const { return around_rad_.empty(); }
  const std::string& motion(int knot) const { return motions_[static_cast<std::size_t>(knot)]; }
  /// Of a unit vector in the frame whose z is the rest direction.
  Place Find(const Eigen::Vector3d& direction) const;

 private:
  std::vector<double> around_rad_;  ///< Ascending, -pi..pi.
  std::vector<double> boundary_rad_;
  std::vector<std::string> motions_;
};

}  // namespace deixis::range_of_motion
