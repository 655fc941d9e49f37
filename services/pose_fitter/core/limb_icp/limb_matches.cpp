#include "services/pose_fitter/core/limb_icp/limb_matches.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "common/geometry/closest_points.h"

namespace deixis::pose_fitter {

using Eigen::Vector3d;

LimbMatches::LimbMatches(const body_model::BodyModel& model) {
  const auto count = static_cast<std::size_t>(model.limb_count());
  balls_.resize(count);
  seen_.resize(count);
  near_.reserve(count);
  pairs_.resize(count);
}

void LimbMatches::Find(const BodyPoints& points, const body_model::Kinematics& kinematics,
                       const MatchSettings& settings) {
  std::fill(pairs_.begin(), pairs_.end(), PairSums{});
  winners_.assign(static_cast<std::size_t>(points.count()), -1);
  Place(kinematics);
  const auto reach = static_cast<float>(settings.reach_m);
  for (const PointBlock& block : points.blocks) {
    near_.clear();
    for (std::size_t k = 0; k < balls_.size(); ++k) {
      const float apart_m = (balls_[k].centre_m - block.centre_m).norm();
      if (apart_m > balls_[k].radius_m + block.radius_m + reach) continue;
      near_.push_back(k);
      Measure(points, block, kinematics, k);
    }
    Share(block, settings);
  }
}

void LimbMatches::Place(const body_model::Kinematics& kinematics) {
  for (std::size_t k = 0; k < balls_.size(); ++k) {
    const auto& shape = kinematics.model().limbs()[k].shape;
    const Eigen::Vector2d centre_m = 0.5 * (shape.centre0_m + shape.centre1_m);
    const Vector3d middle_m(centre_m.x(), centre_m.y(), 0.5 * shape.length_m);
    balls_[k].centre_m = (kinematics.limb(static_cast<int>(k)) * middle_m).cast<float>();
    const double thick_m = std::max({shape.a0_m, shape.b0_m, shape.a1_m, shape.b1_m}) +
                           0.5 * (shape.centre1_m - shape.centre0_m).norm();
    balls_[k].radius_m = static_cast<float>(std::hypot(0.5 * shape.length_m, thick_m));
  }
}

void LimbMatches::Measure(const BodyPoints& points, const PointBlock& block,
                          const body_model::Kinematics& kinematics, std::size_t limb) {
  LimbBlock& seen = seen_[limb];
  const Eigen::Isometry3f limb_from_camera =
      kinematics.limb(static_cast<int>(limb)).inverse().cast<float>();
  for (int i = 0; i < block.count; ++i) {
    const auto k = static_cast<std::size_t>(block.first + i);
    const Eigen::Vector3f point_m =
        limb_from_camera * Eigen::Vector3f(points.x_m[k], points.y_m[k], points.z_m[k]);
    seen.x_m[i] = point_m.x();
    seen.y_m[i] = point_m.y();
    seen.z_m[i] = point_m.z();
  }
  geometry::FindClosestPoints(kinematics.model().limbs()[limb].shape,
                              {seen.x_m, seen.y_m, seen.z_m, block.count},
                              {seen.distance_m, seen.normal_x, seen.normal_y, seen.normal_z});
}

void LimbMatches::Share(const PointBlock& block, const MatchSettings& settings) {
  for (int i = 0; i < block.count; ++i) {
    double least_m = std::numeric_limits<double>::infinity();
    for (const std::size_t limb : near_) {
      const double distance_m = std::abs(static_cast<double>(seen_[limb].distance_m[i]));
      if (!(distance_m < least_m) || distance_m > settings.reach_m) continue;
      least_m = distance_m;
      winners_[static_cast<std::size_t>(block.first + i)] = static_cast<int>(limb);
    }
    for (const std::size_t limb : near_) {
      const LimbBlock& seen = seen_[limb];
      const auto distance_m = static_cast<double>(seen.distance_m[i]);
      if (!(std::abs(distance_m) <= std::min(least_m + settings.equal_m, settings.reach_m))) {
        continue;
      }
      const Vector3d point_m =
          Eigen::Vector3f(seen.x_m[i], seen.y_m[i], seen.z_m[i]).cast<double>();
      const Vector3d normal =
          Eigen::Vector3f(seen.normal_x[i], seen.normal_y[i], seen.normal_z[i]).cast<double>();
      pairs_[limb].Add(point_m - distance_m * normal, point_m);
    }
  }
}

}  // namespace deixis::pose_fitter
