#include "services/pose_fitter/core/start/starter.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "common/config/config.h"
#include "services/pose_fitter/core/start/start_poses.h"

namespace deixis::pose_fitter {
namespace {

BodyEvidenceConfig Coarse(BodyEvidenceConfig evidence, int points) {
  evidence.points = points;
  return evidence;
}

BodyFitterConfig FirstFit(const StarterConfig& config, BodyFitterConfig fit) {
  fit.iterations = config.iterations;
  fit.first_scale_m = config.first_scale_m;
  fit.first_reach_m = config.first_reach_m;
  fit.most_rest_rad = config.rest_rad;
  fit.upright_rad = config.upright_rad;
  return fit;
}

BodyFitterConfig CoarseFit(const StarterConfig& config, const BodyFitterConfig& fit) {
  BodyFitterConfig coarse = FirstFit(config, fit);
  coarse.iterations = config.coarse_iterations;
  return coarse;
}

}  // namespace

void StarterConfig::Validate() const {
  config::Faults faults;
  faults.Require(effort >= 1, "effort", "must be at least 1");
  faults.Require(coarse_points >= 100, "coarse_points", "must be at least 100");
  faults.Require(coarse_iterations >= 1 && coarse_iterations <= 1000, "coarse_iterations",
                 "must be 1..1000");
  faults.Require(kept >= 1, "kept", "must be at least 1");
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
      coarse_fit_(CoarseFit(config, fit)),
      first_fit_(FirstFit(config, fit)),
      second_fit_(fit),
      coarse_evidence_(Coarse(evidence, config.coarse_points)),
      evidence_(evidence) {}

void Starter::Begin(const DepthView& view, const PeopleRegions& regions, const PersonRegion& region,
                    const body_model::BodyModel& model) {
  guesses_.clear();
  next_ = 0;
  is_refining_ = false;
  facing_.reset();
  turned_.reset();
  int place = 0;
  for (const Eigen::Vector3d& top_m : HeadTops(view, regions, region, config_.heads)) {
    for (body_model::BodyPose& pose : StartPoses(model, top_m, regions.floor)) {
      guesses_.push_back({std::move(pose), place});
    }
    ++place;
  }
  model_ = std::make_unique<body_model::BodyModel>(model);
  coarse_.emplace(coarse_fit_, *model_);
  first_.emplace(first_fit_, *model_);
  second_.emplace(second_fit_, *model_);
}

void Starter::Advance(const DepthView& view, const PeopleRegions& regions, Effort& effort) {
  gathered_place_ = -1;
  while (IsBusy() && effort.left > 0) {
    Guess& guess = guesses_[next_++];
    if (is_refining_) {
      Refine(view, regions, guess.pose, effort);
    } else {
      TryCoarse(view, regions.floor, guess, effort);
      if (!IsBusy()) KeepBest();
    }
  }
}

// All poses below one head are judged by the same pixels: those around any of them.
void Starter::TryCoarse(const DepthView& view, const std::optional<body_model::Floor>& floor,
                        Guess& guess, Effort& effort) {
  if (gathered_place_ != guess.place) {
    std::vector<const body_model::BodyPose*> poses;
    for (const Guess& other : guesses_) {
      if (other.place == guess.place) poses.push_back(&other.pose);
    }
    coarse_evidence_.Gather(view, coarse_->kinematics(), poses, floor, {}, config_.gate_m);
    gathered_place_ = guess.place;
  }
  const body_model::BodyPose from = guess.pose;
  const FitResult& result = coarse_->Fit(coarse_evidence_, floor, from, std::nullopt, guess.pose);
  guess.score = result.score + FacingPenalty(config_, guess.pose);
  effort.Spend(config_.coarse_iterations, coarse_evidence_.points().count());
}

void Starter::KeepBest() {
  std::stable_sort(guesses_.begin(), guesses_.end(),
                   [](const Guess& a, const Guess& b) { return a.score < b.score; });
  std::vector<Guess> best;
  int kept[2] = {0, 0};
  for (Guess& guess : guesses_) {
    if (kept[Faces(guess.pose) ? 1 : 0]++ < config_.kept) best.push_back(std::move(guess));
  }
  guesses_ = std::move(best);
  next_ = 0;
  is_refining_ = true;
}

void Starter::Refine(const DepthView& view, const PeopleRegions& regions,
                     const body_model::BodyPose& guess, Effort& effort) {
  auto start = Try(view, regions, guess, effort);
  if (!start) return;
  std::optional<Hypothesis>& best = Faces(start->pose) ? facing_ : turned_;
  if (!best || start->mean_score < best->mean_score) best = std::move(start);
}

std::optional<Hypothesis> Starter::Try(const DepthView& view, const PeopleRegions& regions,
                                       const body_model::BodyPose& guess, Effort& effort) {
  const auto& floor = regions.floor;
  Hypothesis start;
  start.pose = guess;
  coarse_evidence_.Gather(view, first_->kinematics(), {&guess}, floor, {}, config_.gate_m);
  first_->Fit(coarse_evidence_, floor, guess, std::nullopt, start.pose);
  effort.Spend(config_.iterations, coarse_evidence_.points().count());
  evidence_.Gather(view, second_->kinematics(), {&start.pose}, floor, {}, gate_m_);
  start.result = second_->Fit(evidence_, floor, guess, std::nullopt, start.pose);
  effort.Spend(second_fit_.iterations, evidence_.points().count());
  start.information = second_->information();
  start.rates_rad_per_s.setZero(guess.angles_rad.size());
  start.mean_score = start.result.score + FacingPenalty(config_, start.pose);
  if (start.mean_score > config_.worst_score || start.result.trunk_seen < config_.least_trunk) {
    return std::nullopt;
  }
  return start;
}

bool Starter::Faces(const body_model::BodyPose& pose) const {
  return FacingPenalty(config_, pose) <= 0.5 * config_.facing_away;
}

std::vector<Hypothesis> Starter::TakeFound() {
  std::vector<Hypothesis> found;
  for (auto* best : {&facing_, &turned_}) {
    if (*best) found.push_back(std::move(**best));
    best->reset();
  }
  return found;
}

std::vector<Hypothesis> Starter::Find(const DepthView& view, const PeopleRegions& regions,
                                      const PersonRegion& region,
                                      const body_model::BodyModel& model) {
  Begin(view, regions, region, model);
  Effort endless{std::numeric_limits<int>::max()};
  Advance(view, regions, endless);
  return TakeFound();
}

}  // namespace deixis::pose_fitter
