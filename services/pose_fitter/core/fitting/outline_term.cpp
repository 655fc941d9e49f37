#include "services/pose_fitter/core/fitting/outline_term.h"

#include <algorithm>
#include <cmath>

#include "common/config/config.h"

namespace deixis::pose_fitter {
namespace {

using Eigen::Vector3d;

constexpr int kHeights = 5;
constexpr int kAngles = 8;
constexpr double kRobust_m = 0.06;  // Larger distances count less and less.
constexpr double kFreeRobust_m = 0.1;
constexpr double kNearest_m = 0.2;
constexpr double kOutlineSamples = 6.0;  // A sample stands for so many points ...
constexpr double kFreeSamples = 3.0;
constexpr double kSeenWithin_m = 0.06;

double Robust(double distance_m, double scale_m) {
  return scale_m * scale_m / (scale_m * scale_m + distance_m * distance_m);
}

struct Pixel {
  int u = 0, v = 0;
  bool is_inside = false;
};

Pixel PixelOf(const DepthCamera& camera, const Vector3d& point_m) {
  if (point_m.z() < kNearest_m) return {};
  const double inverse_z = 1.0 / point_m.z();
  const double u_px = camera.focal_px.x() * point_m.x() * inverse_z + camera.centre_px.x();
  const double v_px = camera.focal_px.y() * point_m.y() * inverse_z + camera.centre_px.y();
  if (!(u_px > 2.0 && v_px > 2.0 && u_px < camera.width_px - 3.0 &&
        v_px < camera.height_px - 3.0)) {
    return {};
  }
  return {static_cast<int>(u_px + 0.5), static_cast<int>(v_px + 0.5), true};
}

}  // namespace

void OutlineConfig::Validate() const {
  config::Faults faults;
  faults.Require(outline_weight >= 0.0, "outline_weight", "must not be negative");
  faults.Require(outline_sigma_m > 0.0, "outline_sigma_m", "must be positive");
  faults.Require(free_weight >= 0.0, "free_weight", "must not be negative");
  faults.Require(free_sigma_m > 0.0, "free_sigma_m", "must be positive");
  faults.Require(most_m > 0.0, "most_m", "must be positive");
  faults.ThrowIfAny();
}

OutlineTerm::OutlineTerm(const OutlineConfig& config, const body_model::BodyModel& model)
    : config_(config) {
  for (int limb = 0; limb < model.limb_count(); ++limb) {
    first_of_limb_.push_back(static_cast<int>(samples_.size()));
    const auto& shape = model.limbs()[static_cast<std::size_t>(limb)].shape;
    for (int height = 0; height < kHeights; ++height) {
      for (int angle = 0; angle < kAngles; ++angle) {
        const double phi_rad = 2.0 * M_PI * angle / kAngles;
        const double share = (height + 0.5) / kHeights;
        samples_.push_back(
            {limb, SidePoint(shape, phi_rad, share), SideNormal(shape, phi_rad, share)});
      }
    }
  }
  first_of_limb_.push_back(static_cast<int>(samples_.size()));
}

double OutlineTerm::AddTo(const BodyEvidence& evidence, const body_model::Kinematics& kinematics,
                          double weight, LimbEquations& equations) const {
  const DepthView& view = evidence.view();
  const DepthCamera& camera = view.camera();
  double cost = 0.0;
  for (const Sample& sample : samples_) {
    const auto& frame = kinematics.limb(sample.limb);
    const Vector3d point_m = frame * sample.point_m;
    const Pixel at = PixelOf(camera, point_m);
    if (!at.is_inside) continue;
    const auto z_m = static_cast<double>(view.z_m(at.u, at.v));
    const double clearance_px = static_cast<double>(evidence.Clearance_px(at.u, at.v));
    if (clearance_px > 0.5) {
      if (z_m < point_m.z() + config_.free_margin_m) continue;
      const Eigen::Vector2d gradient(
          0.5 * static_cast<double>(evidence.Clearance_px(at.u + 1, at.v) -
                                    evidence.Clearance_px(at.u - 1, at.v)),
          0.5 * static_cast<double>(evidence.Clearance_px(at.u, at.v + 1) -
                                    evidence.Clearance_px(at.u, at.v - 1)));
      const double steepness = gradient.norm();
      if (steepness < 0.3) continue;
      const Vector3d towards(-gradient.x() / steepness, -gradient.y() / steepness, 0.0);
      const double distance_m =
          std::min(clearance_px * point_m.z() / camera.focal_px.x(), config_.most_m);
      const double w = weight * config_.outline_weight * kOutlineSamples *
                       Robust(distance_m, kRobust_m) /
                       (config_.outline_sigma_m * config_.outline_sigma_m);
      equations.Pull(sample.limb, point_m, towards, distance_m, w);
      cost += w * distance_m * distance_m;
    } else if (evidence.IsBody(at.u, at.v) && z_m > 0.0 &&
               (frame.linear() * sample.normal).dot(point_m) < 0.0) {
      const double distance_m =
          z_m - point_m.z() - config_.free_margin_m - 2.5 * camera.noise.Sigma_m(z_m);
      if (distance_m <= 0.0) continue;
      const double w = weight * config_.free_weight * kFreeSamples *
                       Robust(distance_m, kFreeRobust_m) /
                       (config_.free_sigma_m * config_.free_sigma_m);
      equations.Pull(sample.limb, point_m, Vector3d::UnitZ(), std::min(distance_m, 0.2), w);
      cost += w * distance_m * distance_m;
    }
  }
  return cost;
}

LimbView OutlineTerm::Look(const BodyEvidence& evidence, const body_model::Kinematics& kinematics,
                           int limb) const {
  const DepthView& depth = evidence.view();
  const auto& frame = kinematics.limb(limb);
  LimbView view;
  const auto k = static_cast<std::size_t>(limb);
  for (int i = first_of_limb_[k]; i < first_of_limb_[k + 1]; ++i) {
    const Sample& sample = samples_[static_cast<std::size_t>(i)];
    const Vector3d point_m = frame * sample.point_m;
    if ((frame.linear() * sample.normal).dot(point_m) >= 0.0) continue;
    ++view.samples;
    const Pixel at = PixelOf(depth.camera(), point_m);
    if (!at.is_inside) {
      ++view.outside;
      continue;
    }
    const auto z_m = static_cast<double>(depth.z_m(at.u, at.v));
    if (z_m <= 0.0) continue;
    const double near_m = kSeenWithin_m + 2.0 * depth.camera().noise.Sigma_m(point_m.z());
    if (z_m < point_m.z() - near_m) {
      ++view.hidden;
    } else if (z_m > point_m.z() + near_m) {
      ++view.free;
    } else {
      // What lies just behind a piece of the room is hidden by it.
      ++(evidence.IsRoom(at.u, at.v) ? view.hidden : view.seen);
    }
  }
  return view;
}

}  // namespace deixis::pose_fitter
