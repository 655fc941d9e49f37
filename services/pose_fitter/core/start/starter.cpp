#include "services/pose_fitter/core/start/starter.h"

#include "common/config/config.h"
#include "services/pose_fitter/core/start/start_poses.h"

namespace deixis::pose_fitter {
namespace {

BodyFitterConfig FirstFit(const StarterConfig& config, BodyFitterConfig fit) {
  fit.iterations = config.iterations;
  fit.first_scale_m = config.first_scale_m;
  fit.first_reach_m = config.first_reach_m;
  fit.most_rest_rad = config.rest_rad;
  fit.upright_rad = config.upright_rad;
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
                 const BodyFitterConfig& fit)
    : config_(config),
      gate_m_(evidence.gate_m),
      first_fit_(FirstFit(config, fit)),
      second_fit_(fit),
      evidence_(evidence) {}

std::vector<Hypothesis> Starter::Find(const DepthView& view, const PeopleRegions& regions,
                                      const PersonRegion& region,
                                      const body_model::BodyModel& model) {
  first_.emplace(first_fit_, model);
  second_.emplace(second_fit_, model);
  std::optional<Hypothesis> facing, turned;
  for (const Eigen::Vector3d& top_m : HeadTops(view, regions, region, config_.heads)) {
    for (const body_model::BodyPose& guess : StartPoses(model, top_m, regions.floor)) {
      auto start = Try(view, regions.floor, guess);
      if (!start) continue;
      const bool faces = FacingPenalty(config_, start->pose) <= 0.5 * config_.facing_away;
      std::optional<Hypothesis>& best = faces ? facing : turned;
      if (!best || start->mean_score < best->mean_score) best = std::move(start);
    }
  }
  std::vector<Hypothesis> starts;
  for (auto* best : {&facing, &turned}) {
    if (*best) starts.push_back(std::move(**best));
  }
  return starts;
}

std::optional<Hypothesis> Starter::Try(const DepthView& view,
                                       const std::optional<body_model::Floor>& floor,
                                       const body_model::BodyPose& guess) {
  Hypothesis start;
  start.pose = guess;
  evidence_.Gather(view, first_->kinematics(), {&guess}, floor, {}, config_.gate_m);
  first_->Fit(evidence_, floor, guess, std::nullopt, start.pose);
  evidence_.Gather(view, second_->kinematics(), {&start.pose}, floor, {}, gate_m_);
  start.result = second_->Fit(evidence_, floor, guess, std::nullopt, start.pose);
  start.information = second_->information();
  start.rates_rad_per_s.setZero(guess.angles_rad.size());
  start.mean_score = start.result.score + FacingPenalty(config_, start.pose);
  if (start.mean_score > config_.worst_score || start.result.trunk_seen < config_.least_trunk) {
    return std::nullopt;
  }
  return start;
}

}  // namespace deixis::pose_fitter
