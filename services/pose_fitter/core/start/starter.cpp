#include "services/pose_fitter/core/start/starter.h"

#include "common/config/config.h"
#include "services/pose_fitter/core/start/start_poses.h"

namespace deixis::pose_fitter {
namespace {

FitSettings FirstFit(const StarterConfig& config, FitSettings fit) {
  fit.articulated.iterations = config.iterations;
  fit.articulated.first_scale_m = config.first_scale_m;
  fit.articulated.first_reach_m = config.first_reach_m;
  fit.articulated.most_rest_rad = config.rest_rad;
  fit.articulated.upright_rad = config.upright_rad;
  fit.limb_icp.reach_m = config.first_reach_m;
  return fit;
}

}  // namespace

void StarterConfig::Validate() const {
  config::Faults faults;
  faults.Require(iterations >= 1 && iterations <= 1000, "iterations", "must be 1..1000");
  faults.Require(first_scale_m > 0.0, "first_scale_m", "must be positive");
  faults.Require(first_reach_m > 0.0, "first_reach_m", "must be positive");
  faults.Require(rest_rad > 0.0, "rest_rad", "must be positive");
  faults.Require(upright_rad > 0.0, "upright_rad", "must be positive");
  faults.Require(gate_m > 0.0, "gate_m", "must be positive");
  faults.Require(head_m > 0.0, "head_m", "must be positive");
  faults.Require(worst_score > 0.0, "worst_score", "must be positive");
  faults.Require(least_trunk >= 0.0 && least_trunk <= 1.0, "least_trunk", "must be 0..1");
  faults.Require(facing_away >= 0.0, "facing_away", "must not be negative");
  faults.ThrowIfAny();
}

double FacingPenalty(const StarterConfig& config, const body_model::BodyPose& pose) {
  const Eigen::Vector3d forward = pose.frame_from_root.rotation * Eigen::Vector3d::UnitX();
  const Eigen::Vector3d from_camera = pose.frame_from_root.translation_m.normalized();
  return config.facing_away * 0.5 * (1.0 + forward.dot(from_camera));
}

Starter::Starter(const StarterConfig& config, const BodyEvidenceConfig& evidence,
                 const FitSettings& fit)
    : config_(config),
      gate_m_(evidence.gate_m),
      first_fit_(FirstFit(config, fit)),
      second_fit_(fit),
      evidence_(evidence) {}

std::vector<Hypothesis> Starter::Find(const DepthView& view, const PeopleRegions& regions,
                                      const PersonRegion& region,
                                      const body_model::BodyModel& model) {
  body_model::Kinematics kinematics(model);
  const auto first = MakePoseMethod(first_fit_, model);
  const auto second = MakePoseMethod(second_fit_, model);
  std::optional<Hypothesis> facing, turned;
  const Eigen::Vector3d top_m = TopOf(view, regions.labels, region, regions.floor, config_.head_m);
  for (const body_model::BodyPose& guess : StartPoses(model, top_m, regions.floor)) {
    Hypothesis start;
    start.pose = guess;
    evidence_.Gather(view, kinematics, {&guess}, regions.floor, {}, config_.gate_m);
    first->Fit(evidence_, regions.floor, guess, std::nullopt, start.pose);
    evidence_.Gather(view, kinematics, {&start.pose}, regions.floor, {}, gate_m_);
    start.result = second->Fit(evidence_, regions.floor, guess, std::nullopt, start.pose);
    start.information = second->information();
    start.rates_rad_per_s.setZero(model.angle_count());
    start.mean_score = start.result.score + FacingPenalty(config_, start.pose);
    if (start.mean_score > config_.worst_score || start.result.trunk_seen < config_.least_trunk) {
      continue;
    }
    const bool faces = FacingPenalty(config_, start.pose) <= 0.5 * config_.facing_away;
    std::optional<Hypothesis>& best = faces ? facing : turned;
    if (!best || start.mean_score < best->mean_score) best = std::move(start);
  }
  std::vector<Hypothesis> starts;
  for (auto* best : {&facing, &turned}) {
    if (*best) starts.push_back(std::move(**best));
  }
  return starts;
}

}  // namespace deixis::pose_fitter
