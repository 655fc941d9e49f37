#include "services/pose_fitter/core/bodies/limb_search.h"

#include <algorithm>
#include <utility>

#include "common/body_model/joint_angles.h"
#include "common/config/config.h"

namespace deixis::pose_fitter {
namespace {

using body_model::BodyPose;
using Eigen::Vector3d;

constexpr int kLeastPoints = 8;            // A limb with fewer is not seen.
constexpr double kHandThickness_m = 0.02;  // Half of it: from what is seen to its middle.
constexpr double kTip_m = 0.08;            // From the end of a hand or foot to its middle.
constexpr double kElbowReach = 1.3;        // Upper arms: what ends farther away is no elbow.
constexpr double kLegs = 3.0;              // They are held in unusual ways less often than arms.
constexpr double kLeastSide = 0.1;         // Probability from which on a hand may be of this side.

BodyEvidenceConfig Few(BodyEvidenceConfig evidence, int points) {
  evidence.points = points;
  return evidence;
}

BodyFitterConfig Quick(BodyFitterConfig fit, int iterations) {
  fit.iterations = iterations;
  return fit;
}

}  // namespace

void LimbSearchConfig::Validate() const {
  config::Faults faults;
  faults.Require(period_s >= 0.0, "period_s", "must not be negative");
  faults.Require(better >= 0.0, "better", "must not be negative");
  faults.Require(cue_share >= 0.0, "cue_share", "must not be negative");
  faults.Require(strain_share >= 0.0, "strain_share", "must not be negative");
  faults.Require(cue_m > 0.0, "cue_m", "must be positive");
  faults.Require(points >= 100, "points", "must be at least 100");
  faults.Require(iterations >= 1 && iterations <= 1000, "iterations", "must be 1..1000");
  faults.Require(tried >= 1 && tried <= 100, "tried", "must be 1..100");
  faults.ThrowIfAny();
}

LimbSearch::LimbSearch(const LimbSearchConfig& config, const BodyEvidenceConfig& evidence,
                       const BodyFitterConfig& fit, const body_model::BodyModel& model)
    : config_(config),
      model_(&model),
      kinematics_(model),
      quick_(Quick(fit, config.iterations), model),
      whole_(fit, model),
      few_(Few(evidence, config.points)),
      around_(evidence),
      gate_m_(evidence.gate_m),
      loose_(config.loose),
      rest_(body_model::Standing(model)) {
  for (const Chain chain : kChains) {
    if (const auto limbs = LimbsOf(model, chain)) chains_.push_back(*limbs);
  }
}

bool LimbSearch::IsDoubtful(const Hypothesis& now, const ChainLimbs& limbs) const {
  for (const int limb : {limbs.lower, limbs.end}) {
    if (limb < 0) continue;
    const LimbEvidence& evidence = now.result.limbs[static_cast<std::size_t>(limb)];
    const LimbView& view = evidence.view;
    if (4 * view.free > view.samples) return true;
    // Legs are often behind furniture or below the picture.
    const bool is_covered = 2 * (view.hidden + view.outside) > view.samples;
    if (evidence.inlier_count < kLeastPoints && (IsArm(limbs.chain) || !is_covered)) return true;
  }
  return false;
}

// Hands recognised where the body does not have this one.
bool LimbSearch::AddHands(const std::vector<PartCue>& cues, const ChainLimbs& limbs,
                          const Hypothesis& now) {
  if (!IsArm(limbs.chain) || limbs.end < 0) return false;
  const Vector3d hand_m = (1.0 - kHandShare) * kinematics_.proximal_m(limbs.end) +
                          kHandShare * kinematics_.distal_m(limbs.end);
  bool is_elsewhere = false;
  for (const PartCue& cue : cues) {
    if (cue.part != Part::kHand || !cue.is_measured || !cue.distance_m) continue;
    const double right = cue.right_probability;
    if ((IsRight(limbs.chain) ? right : 1.0 - right) < kLeastSide) continue;
    const Vector3d place_m = (*cue.distance_m + kHandThickness_m) * cue.ray;
    if ((place_m - hand_m).norm() < config_.cue_m) continue;
    is_elsewhere = true;
    Add(ReachingPoses(*model_, limbs, now.pose, place_m));
  }
  return is_elsewhere;
}

// The far point of what hangs on the body is the end of a hand, an elbow, or a foot.
bool LimbSearch::AddLooseEnds(const BodyEvidence& evidence, const ImageContext& context,
                              const ChainLimbs& limbs, const Hypothesis& now) {
  const Vector3d from_m = kinematics_.proximal_m(limbs.upper);
  const auto& ends_m =
      loose_.Find(evidence, from_m, limbs.upper_m + limbs.lower_m + kTip_m, context);
  for (const Vector3d& end_m : ends_m) {
    const double away_m = (end_m - from_m).norm();
    const Vector3d towards = (end_m - from_m) / std::max(away_m, 1e-3);
    Add(ReachingPoses(*model_, limbs, now.pose, end_m - kTip_m * towards));
    if (IsArm(limbs.chain) && away_m < kElbowReach * limbs.upper_m) {
      Add(ElbowPoses(*model_, limbs, now.pose, end_m));
    }
  }
  return !ends_m.empty();
}

void LimbSearch::Add(std::vector<BodyPose> poses) {
  for (BodyPose& pose : poses) places_.push_back(std::move(pose));
}

double LimbSearch::ScoreOf(const FitResult& result, const BodyPose& pose) const {
  return result.score + config_.cue_share * result.cue_cost + config_.strain_share * Strain(pose);
}

// Squares of how far the angles of arms and legs are from standing upright, in halves of their
// ranges.
double LimbSearch::Strain(const BodyPose& pose) const {
  double strain = 0.0;
  for (const ChainLimbs& limbs : chains_) {
    for (const int limb : {limbs.upper, limbs.lower}) {
      int angle = model_->first_angle(limb);
      for (const auto& dof : model_->limbs()[static_cast<std::size_t>(limb)].dofs) {
        const double half_rad = std::max(0.1, 0.5 * (dof.angle_max_rad - dof.angle_min_rad));
        const double off = (pose.angles_rad[angle] - rest_.angles_rad[angle]) / half_rad;
        strain += (IsArm(limbs.chain) ? 1.0 : kLegs) * off * off;
        ++angle;
      }
    }
  }
  return strain;
}

// All places are judged by the same pixels: those around any of them.
void LimbSearch::Gather(const DepthView& view, const std::optional<body_model::Floor>& floor,
                        const ImageContext& context, const Hypothesis& now, BodyEvidence& around) {
  std::vector<const BodyPose*> poses{&now.pose};
  for (const BodyPose& place : places_) poses.push_back(&place);
  around.Gather(view, kinematics_, poses, floor, context, gate_m_);
}

// Keeps the few places that seem best after a short fit to few points.
void LimbSearch::Shortlist(const std::optional<body_model::Floor>& floor) {
  std::vector<std::pair<double, std::size_t>> scores;
  for (std::size_t i = 0; i < places_.size(); ++i) {
    const BodyPose place = places_[i];
    const FitResult& result = quick_.Fit(few_, floor, place, std::nullopt, places_[i]);
    scores.emplace_back(ScoreOf(result, places_[i]), i);
  }
  std::sort(scores.begin(), scores.end());
  scores.resize(std::min(scores.size(), static_cast<std::size_t>(config_.tried)));
  std::vector<BodyPose> kept;
  for (const auto& [score, i] : scores) kept.push_back(std::move(places_[i]));
  places_ = std::move(kept);
}

Hypothesis LimbSearch::Fitted(const std::optional<body_model::Floor>& floor, const Hypothesis& now,
                              const BodyPose& place) {
  Hypothesis other = now;
  other.pose = place;
  other.result = whole_.Fit(around_, floor, place, std::nullopt, other.pose);
  other.information = whole_.information();
  return other;
}

std::optional<Hypothesis> LimbSearch::BestOf(const std::optional<body_model::Floor>& floor,
                                             const Hypothesis& now) {
  // Another place must be better than this one, too, with the same freedom to move.
  double least = ScoreOf(whole_.Judge(around_, now.pose), now.pose) - config_.better;
  std::optional<Hypothesis> found;
  Hypothesis same = Fitted(floor, now, now.pose);
  if (ScoreOf(same.result, same.pose) < least) found = same;
  least = std::min(least, ScoreOf(same.result, same.pose) - config_.better);
  for (const BodyPose& place : places_) {
    Hypothesis other = Fitted(floor, now, place);
    const double score = ScoreOf(other.result, other.pose);
    if (score > least) continue;
    least = score;
    found = std::move(other);
  }
  if (found) found->rates_rad_per_s.setZero();
  return found;
}

bool LimbSearch::FindPlaces(const BodyEvidence& evidence,
                            const std::optional<body_model::Floor>& floor,
                            const ImageContext& context, const ChainLimbs& limbs,
                            const Hypothesis& now) {
  places_.clear();
  const bool is_doubtful = IsDoubtful(now, limbs);
  const bool is_recognised = AddHands(evidence.cues(), limbs, now);
  const bool hangs = AddLooseEnds(evidence, context, limbs, now);
  if (!is_doubtful && !is_recognised && !hangs) return false;
  const Vector3d up = floor ? floor->normal : Vector3d(-Vector3d::UnitY());
  Add(UsualPoses(*model_, limbs, now.pose, up));
  return true;
}

std::optional<Hypothesis> LimbSearch::Find(const BodyEvidence& evidence,
                                           const std::optional<body_model::Floor>& floor,
                                           const ImageContext& context, double seconds,
                                           const Hypothesis& now) {
  since_s_ += seconds;
  if (!places_.empty()) return Decide(evidence, floor, context, now);
  if (since_s_ < config_.period_s) return std::nullopt;
  since_s_ = 0.0;
  kinematics_.Update(now.pose);
  for (std::size_t i = 0; i < chains_.size(); ++i) {
    const ChainLimbs& limbs = chains_[(next_ + i) % chains_.size()];
    if (!FindPlaces(evidence, floor, context, limbs, now)) continue;
    next_ = (next_ + i + 1) % chains_.size();
    Gather(evidence.view(), floor, context, now, few_);
    Shortlist(floor);
    return std::nullopt;
  }
  places_.clear();
  return std::nullopt;
}

// In the image after that of the shortlist, so that none has both to do.
std::optional<Hypothesis> LimbSearch::Decide(const BodyEvidence& evidence,
                                             const std::optional<body_model::Floor>& floor,
                                             const ImageContext& context, const Hypothesis& now) {
  for (BodyPose& place : places_) place.frame_from_root = now.pose.frame_from_root;
  Gather(evidence.view(), floor, context, now, around_);
  auto found = BestOf(floor, now);
  places_.clear();
  return found;
}

}  // namespace deixis::pose_fitter
