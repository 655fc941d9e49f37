#include "services/pose_fitter/core/start/starter.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "common/body_model/joint_angles.h"
#include "common/body_model/kinematics.h"
#include "common/config/config.h"
#include "services/pose_fitter/core/start/start_poses.h"

namespace deixis::pose_fitter {
namespace {

constexpr double kSameTop_m = 0.1;
constexpr double kSameHead_m = 0.25;    // Between the head of a pose and one that is seen.
constexpr double kHeadMargin_m = 0.25;  // Heads nearer to the picture's edge may not be told.
constexpr double kLowNoise_m = 0.015, kHighNoise_m = 0.04;
constexpr double kNoisyTrunk = 0.4, kNoisyCertainTrunk = 0.25;  // More of it where noise is high.
constexpr double kTrunkRamp = 0.15;
constexpr double kLower_m = 0.2, kBody_m = 1.5, kBeside_m = 0.5;  // Of a body below its head.

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

/// Of the head above the root, of somebody who stands.
double HeadHeight_m(const body_model::BodyModel& model) {
  const auto head = model.Find("head");
  if (!head) return 0.0;
  body_model::Kinematics kinematics(model);
  kinematics.Update(body_model::Standing(model));
  return kinematics.distal_m(*head).z();
}

/// 0 up to `none`, 1 from `full` on, straight between.
double Ramp(double value, double none, double full) {
  return std::clamp((value - none) / (full - none), 0.0, 1.0);
}

/// Whether a head there may be cut by the edge of the picture, so that it does not look like one.
bool IsNearEdge(const DepthView& view, const Eigen::Vector3d& point_m) {
  const double margin_px = kHeadMargin_m * view.camera().focal_px.x() / point_m.z();
  const Eigen::Vector2d at_px = view.camera().Project(point_m);
  return at_px.x() < margin_px || at_px.y() < margin_px ||
         at_px.x() > view.width_px() - margin_px || at_px.y() > view.height_px() - margin_px;
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
  faults.Require(worst_with_head >= worst_score, "worst_with_head",
                 "must not be less than worst_score");
  faults.Require(least_head >= 0.0 && least_head <= 1.0, "least_head", "must be 0..1");
  faults.Require(certain_head >= least_head, "certain_head", "must not be less than least_head");
  faults.Require(certain_trunk >= 0.0 && certain_trunk <= 1.0, "certain_trunk", "must be 0..1");
  faults.Require(better_body >= 0.0, "better_body", "must not be negative");
  faults.Require(facing_away >= 0.0, "facing_away", "must not be negative");
  faults.ThrowIfAny();
}

bool IsBelowHead(const Eigen::Vector3d& point_m, const Eigen::Vector3d& head_m,
                 const Eigen::Vector3d& up) {
  const Eigen::Vector3d from_m = point_m - head_m;
  const double lower_m = -up.dot(from_m);
  return lower_m > kLower_m && lower_m < kBody_m && (from_m + lower_m * up).norm() < kBeside_m;
}

void DropNobodies(std::vector<Hypothesis>& starts) {
  const auto is_nobody = [](const Hypothesis& start) {
    return start.mean_score > start.worst_score;
  };
  starts.erase(std::remove_if(starts.begin(), starts.end(), is_nobody), starts.end());
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
                    const body_model::BodyModel& model, Sought sought) {
  sought_ = sought;
  guesses_.clear();
  next_ = 0;
  is_refining_ = false;
  facing_.reset();
  turned_.reset();
  int place = 0;
  for (const Eigen::Vector3d& top_m : sought == Sought::kSomebodyNew
                                          ? TopsOf(view, regions, region)
                                          : AllTopsOf(view, regions, region)) {
    for (body_model::BodyPose& pose : StartPoses(model, top_m, regions.floor)) {
      guesses_.push_back({std::move(pose), place});
    }
    ++place;
  }
  SetModel(model);
}

void Starter::SetModel(const body_model::BodyModel& model) {
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
  start.worst_score = WorstScore(view, regions.heads, start.result.trunk_seen);
  if (sought_ == Sought::kOtherPoses) {
    start.worst_score = std::max(start.worst_score, config_.worst_score);
  }
  if (start.result.trunk_seen < config_.least_trunk) return std::nullopt;
  return start;
}

/// Where heads are seen; else where the outline may be one.
std::vector<Eigen::Vector3d> Starter::TopsOf(const DepthView& view, const PeopleRegions& regions,
                                             const PersonRegion& region) const {
  const Eigen::Vector3d up =
      regions.floor ? regions.floor->normal : Eigen::Vector3d(-Eigen::Vector3d::UnitY());
  std::vector<Eigen::Vector3d> tops;
  for (const HeadShape& head : regions.heads) {
    const auto middle = static_cast<std::size_t>(head.v_px * view.width_px() + head.u_px);
    if (head.likeness < config_.least_head || regions.labels[middle] != region.label) continue;
    const bool is_below =
        std::any_of(regions.heads.begin(), regions.heads.end(), [&](const HeadShape& other) {
          return other.likeness >= config_.least_head && IsBelowHead(head.top_m, other.top_m, up);
        });
    if (!is_below && static_cast<int>(tops.size()) < config_.heads.most) tops.push_back(head.top_m);
  }
  if (!tops.empty()) return tops;
  for (const Eigen::Vector3d& top_m : HeadTops(view, regions, region, config_.heads)) {
    if (IsNearEdge(view, top_m)) tops.push_back(top_m);
  }
  return tops;
}

/// Peaks of the outline, and heads that are none of these.
std::vector<Eigen::Vector3d> Starter::AllTopsOf(const DepthView& view, const PeopleRegions& regions,
                                                const PersonRegion& region) const {
  auto tops_m = HeadTops(view, regions, region, config_.heads);
  for (const Eigen::Vector3d& top_m : TopsOf(view, regions, region)) {
    const bool is_there = std::any_of(tops_m.begin(), tops_m.end(), [&](const auto& other_m) {
      return (other_m - top_m).norm() < kSameTop_m;
    });
    if (!is_there) tops_m.push_back(top_m);
  }
  return tops_m;
}

/// Of the pose that the second fit has: whose head is certain and whose trunk is well in view may
/// look worse otherwise, and who should have a head in the picture is nobody without it.
double Starter::WorstScore(const DepthView& view, const std::vector<HeadShape>& heads,
                           double trunk_seen) {
  const auto head = second_->kinematics().model().Find("head");
  if (!head) return config_.worst_score;
  const Eigen::Vector3d middle_m =
      0.5 * (second_->kinematics().proximal_m(*head) + second_->kinematics().distal_m(*head));
  double likeness = 0.0;
  for (const HeadShape& seen : heads) {
    const bool is_here = (seen.middle_m - middle_m).norm() < kSameHead_m;
    if (is_here) likeness = std::max(likeness, seen.likeness);
  }
  // The noisier the depth, the more of the trunk seems to be where it is by chance.
  const double noise = Ramp(view.camera().noise.Sigma_m(middle_m.z()), kLowNoise_m, kHighNoise_m);
  if (trunk_seen < config_.least_trunk + noise * kNoisyTrunk) return 0.0;
  if (likeness < config_.least_head) {
    return IsNearEdge(view, middle_m) ? config_.worst_score : 0.0;
  }
  if (likeness < config_.certain_head) return config_.worst_score;
  const double certain = config_.certain_trunk + noise * kNoisyCertainTrunk;
  return config_.worst_score + (config_.worst_with_head - config_.worst_score) *
                                   Ramp(trunk_seen, certain - kTrunkRamp, certain);
}

std::vector<Hypothesis> Starter::Wear(const DepthView& view, const PeopleRegions& regions,
                                      const std::vector<Hypothesis>& starts,
                                      const body_model::BodyModel& before,
                                      const body_model::BodyModel& model) {
  const double taller_m = HeadHeight_m(model) - HeadHeight_m(before);
  SetModel(model);
  Effort endless{std::numeric_limits<int>::max()};
  std::vector<Hypothesis> worn;
  for (const Hypothesis& start : starts) {
    body_model::BodyPose guess = start.pose;
    guess.frame_from_root.translation_m -=
        taller_m * (guess.frame_from_root.rotation * Eigen::Vector3d::UnitZ());
    if (auto found = Try(view, regions, guess, endless)) worn.push_back(std::move(*found));
  }
  return worn;
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
  auto found = TakeFound();
  DropNobodies(found);
  return found;
}

}  // namespace deixis::pose_fitter
