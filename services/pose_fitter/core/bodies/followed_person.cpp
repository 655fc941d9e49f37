#include "services/pose_fitter/core/bodies/followed_person.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "common/config/config.h"
#include "services/pose_fitter/core/cues/cue_owner.h"

namespace deixis::pose_fitter {
namespace {

using body_model::BodyPose;
using body_model::LimbState;

constexpr int kLessons = 4;           // The last lesson has so many times the first one's images.
constexpr double kLimbsOwn_m = 0.05;  // What is so near to a limb is its own.
// A limb rests on its own data that has so many points, so near on average, and of whose surface
// that faces the camera so much is seen.
constexpr int kMeasuredPoints = 8;
constexpr double kMeasuredWithin_m = 0.035;
constexpr double kMeasuredShare = 0.35;
// Spread of places in people of one stature, of the distance to the root.
constexpr double kProportions = 0.05;
constexpr double kDoubted = 0.6;  // Share of a limb that counts as unseen when it is not measured.

LimbState StateOf(const LimbEvidence& evidence) {
  const LimbView& view = evidence.view;
  if (evidence.inlier_count >= kMeasuredPoints && evidence.residual_m < kMeasuredWithin_m &&
      view.seen >= kMeasuredShare * view.samples) {
    return LimbState::kMeasured;
  }
  if (2 * (view.hidden + view.outside) > view.samples) return LimbState::kHidden;
  return 2 * view.free > view.samples ? LimbState::kLost : LimbState::kInferred;
}

}  // namespace

void FollowConfig::Validate() const {
  config::Faults faults;
  faults.Require(velocity_share >= 0.0 && velocity_share <= 1.0, "velocity_share", "must be 0..1");
  faults.Require(settle_s > 0.0, "settle_s", "must be positive");
  faults.Require(doubtful_score > 0.0, "doubtful_score", "must be positive");
  faults.Require(proven_score > 0.0, "proven_score", "must be positive");
  faults.Require(lost_score > 0.0, "lost_score", "must be positive");
  faults.Require(turned_about >= 0.0, "turned_about", "must not be negative");
  faults.Require(least_points >= 10, "least_points", "must be at least 10");
  faults.Require(position_sigma_m >= 0.0, "position_sigma_m", "must not be negative");
  faults.Require(unseen_rad >= 0.0, "unseen_rad", "must not be negative");
  faults.Require(covariance_factor > 0.0, "covariance_factor", "must be positive");
  faults.Require(shape_frames >= 0 && shape_frames <= 1000, "shape_frames", "must be 0..1000");
  faults.Require(shape_period_s >= 0.0, "shape_period_s", "must not be negative");
  faults.Require(shape_work >= 1, "shape_work", "must be at least 1");
  faults.Require(shape_points >= 10, "shape_points", "must be at least 10");
  faults.ThrowIfAny();
}

FollowedPerson::FollowedPerson(const FollowSettings& settings, const PersonBody& body,
                               const body_model::BodyPlan& plan, std::vector<Hypothesis> starts)
    : settings_(settings),
      plan_(&plan),
      estimate_(body.estimate),
      first_model_(std::make_unique<body_model::BodyModel>(body.model)),
      model_(std::make_unique<body_model::BodyModel>(body.model)),
      kinematics_(std::make_unique<body_model::Kinematics>(*model_)),
      fitter_(MakePoseMethod(settings.fit, *model_)),
      evidence_(settings.evidence),
      hypotheses_(std::move(starts)),
      next_lesson_(settings.follow.shape_frames) {
  Choose();
  MakeLimbSearch();
}

void FollowedPerson::MakeLimbSearch() {
  search_ = std::make_unique<LimbSearch>(settings_.limbs, settings_.evidence,
                                         settings_.fit.articulated, *model_);
}

void FollowedPerson::Look(const DepthView& view, const std::optional<body_model::Floor>& floor) {
  std::vector<const BodyPose*> poses;
  for (const Hypothesis& hypothesis : hypotheses_) poses.push_back(&hypothesis.pose);
  evidence_.Gather(view, *kinematics_, poses, floor, {}, settings_.evidence.gate_m);
}

void FollowedPerson::MarkLimbs(std::vector<std::uint8_t>& pixels) const {
  evidence_.MarkNear(*kinematics_, kLimbsOwn_m, pixels);
}

double FollowedPerson::Reaches(const PartCue& cue) {
  kinematics_->Update(best().pose);
  return pose_fitter::Reaches(cue, *kinematics_);
}

void FollowedPerson::Follow(const DepthView& view, const std::optional<body_model::Floor>& floor,
                            const ImageContext& context, double seconds) {
  std::vector<BodyPose> predicted;
  for (const Hypothesis& hypothesis : hypotheses_) {
    predicted.push_back(Predict(hypothesis, seconds, settings_.follow.velocity_share));
  }
  std::vector<const BodyPose*> poses;
  for (const BodyPose& pose : predicted) poses.push_back(&pose);
  evidence_.Gather(view, *kinematics_, poses, floor, context, settings_.evidence.gate_m);
  if (evidence_.points().count() < settings_.follow.least_points) {
    unseen_s_ += seconds;
    return;
  }
  unseen_s_ = 0.0;
  for (std::size_t i = 0; i < predicted.size(); ++i) {
    Fit(floor, predicted[i], seconds, hypotheses_[i]);
  }
  Remember(seconds);
  LearnShape();
  Choose();
  if (settings_.fit.method != FitMethod::kArticulated) return;
  auto better = search_->Find(evidence_, floor, context, seconds, best());
  if (better) hypotheses_.front() = std::move(*better);
}

void FollowedPerson::Fit(const std::optional<body_model::Floor>& floor, const BodyPose& predicted,
                         double seconds, Hypothesis& hypothesis) {
  BodyPose pose = predicted;
  hypothesis.result = fitter_->Fit(evidence_, floor, predicted, seconds, pose);
  hypothesis.information = fitter_->information();
  Move(pose, seconds, hypothesis);
  const double score = hypothesis.result.score + FacingPenalty(settings_.start, pose) +
                       settings_.limbs.cue_share * hypothesis.result.cue_cost + hypothesis.handicap;
  const double share = std::min(1.0, seconds / (0.5 * settings_.follow.settle_s));
  hypothesis.mean_score += share * (score - hypothesis.mean_score);
}

// With time, all but the best go.
void FollowedPerson::Choose() {
  std::stable_sort(
      hypotheses_.begin(), hypotheses_.end(),
      [](const Hypothesis& a, const Hypothesis& b) { return a.mean_score < b.mean_score; });
  while (hypotheses_.size() > 1 && hypotheses_.back().age_s >= settings_.follow.settle_s) {
    hypotheses_.pop_back();
  }
  if (hypotheses_.size() == 1) hypotheses_.front().handicap = 0.0;
  if (best().mean_score < settings_.follow.proven_score) is_proven_ = true;
}

void FollowedPerson::AddRivals(std::vector<Hypothesis> rivals) {
  const body_model::BodyPose now = best().pose;
  for (Hypothesis& rival : rivals) {
    // Front and back look much alike to depth, and nobody turns about between two images.
    if (IsTurnedAbout(rival.pose, now)) rival.handicap = settings_.follow.turned_about;
    rival.mean_score += rival.handicap;
    if (rival.mean_score < best().mean_score) hypotheses_.push_back(std::move(rival));
  }
}

bool FollowedPerson::IsDoubtful() const {
  return hypotheses_.size() == 1 && best().mean_score > settings_.follow.doubtful_score;
}

bool FollowedPerson::IsNobody() const {
  return best().age_s > 2.0 * settings_.follow.settle_s &&
         best().mean_score >
             (is_proven_ || has_head_ ? settings_.follow.lost_score : settings_.start.worst_score);
}

std::optional<Eigen::Vector3d> FollowedPerson::HeadMiddle_m() {
  const auto head = model_->Find("head");
  if (!head) return std::nullopt;
  kinematics_->Update(best().pose);
  return 0.5 * (kinematics_->proximal_m(*head) + kinematics_->distal_m(*head));
}

// Images for the person's shape: such without doubt, apart from each other.
void FollowedPerson::Remember(double seconds) {
  since_frame_s_ += seconds;
  const int most = lesson_ ? 2 * next_lesson_ : next_lesson_;
  if (static_cast<int>(frames_.size()) >= most || hypotheses_.size() > 1 ||
      best().age_s < settings_.follow.settle_s ||
      best().result.score > settings_.follow.shape_score ||
      since_frame_s_ < settings_.follow.shape_period_s) {
    return;
  }
  since_frame_s_ = 0.0;
  const BodyPoints& points = evidence_.points();
  const int step = std::max(1, points.count() / settings_.follow.shape_points);
  ShapeFrame& frame = frames_.emplace_back();
  frame.pose = best().pose;
  for (int i = 0; i < points.count(); i += step) {
    const auto k = static_cast<std::size_t>(i);
    if (fitter_->winners()[k] < 0) continue;
    frame.points.push_back(
        {Eigen::Vector3f(points.x_m[k], points.y_m[k], points.z_m[k]).cast<double>(),
         static_cast<double>(points.sigma_z_m[k]), fitter_->winners()[k]});
  }
}

// A little in each image.
void FollowedPerson::LearnShape() {
  if (!lesson_ && next_lesson_ > 0 && static_cast<int>(frames_.size()) >= next_lesson_) {
    lesson_ = std::make_unique<ShapeCalibration>(ShapeParameters(*first_model_, *plan_, estimate_),
                                                 frames_, settings_.shape);
  }
  if (!lesson_) return;
  lesson_->Advance(settings_.follow.shape_work);
  if (!lesson_->IsOver()) return;
  if (lesson_->result().shape) Wear(*lesson_->result().shape);
  lesson_.reset();
  next_lesson_ *= 2;
  if (next_lesson_ > kLessons * settings_.follow.shape_frames) {
    next_lesson_ = 0;
    frames_.clear();
  }
}

// Angles mean the same in the new body.
void FollowedPerson::Wear(const CalibratedShape& shape) {
  model_ = std::make_unique<body_model::BodyModel>(shape.model);
  kinematics_ = std::make_unique<body_model::Kinematics>(*model_);
  fitter_ = MakePoseMethod(settings_.fit, *model_);
  MakeLimbSearch();
}

// A fit believes in the few points of a limb that is mostly out of sight, which may be another's.
void FollowedPerson::AddUnseen(Eigen::MatrixXd& covariance) const {
  for (int limb = 1; limb < model_->limb_count(); ++limb) {
    const LimbEvidence& evidence = best().result.limbs[static_cast<std::size_t>(limb)];
    const LimbView& view = evidence.view;
    double unseen = view.samples > 0 ? 1.0 - static_cast<double>(view.seen) / view.samples : 1.0;
    if (StateOf(evidence) != LimbState::kMeasured) unseen = std::max(unseen, kDoubted);
    const double sigma_rad = settings_.follow.unseen_rad * unseen;
    const auto count =
        static_cast<Eigen::Index>(model_->limbs()[static_cast<std::size_t>(limb)].dofs.size());
    covariance.diagonal().segment(6 + model_->first_angle(limb), count).array() +=
        sigma_rad * sigma_rad;
  }
}

// Where a limb that is not measured is follows from lengths, which are as uncertain as stature and
// proportions are.
void FollowedPerson::AddSize(body_model::TrackedBody& body) const {
  if (body.covariance.size() == 0) return;
  const double share =
      std::hypot(estimate_.Spread_m("kph") / estimate_.Length_m("kph"), kProportions);
  const Eigen::Vector3d root_m = body.pose.frame_from_root.translation_m;
  const auto add = [&](const Eigen::Vector3d& point_m, Eigen::Matrix3d& covariance_m2) {
    const Eigen::Vector3d off_m = share * (point_m - root_m);
    covariance_m2 += off_m * off_m.transpose();
  };
  for (body_model::LimbPose& limb : body.limbs) {
    if (limb.state == LimbState::kMeasured) continue;
    add(limb.proximal_m, limb.proximal_covariance_m2);
    add(limb.distal_m, limb.distal_covariance_m2);
  }
}

Eigen::MatrixXd FollowedPerson::CovarianceOf(const Eigen::MatrixXd& information) const {
  if (settings_.fit.method == FitMethod::kLimbIcp) return {};
  const auto size = information.rows();
  Eigen::MatrixXd covariance = settings_.follow.covariance_factor *
                               information.ldlt().solve(Eigen::MatrixXd::Identity(size, size));
  AddUnseen(covariance);
  const double variance_m2 = settings_.follow.position_sigma_m * settings_.follow.position_sigma_m;
  covariance.diagonal().head<3>().array() += variance_m2;
  return covariance;
}

body_model::TrackedBody FollowedPerson::Describe() {
  const Hypothesis& now = best();
  body_model::TrackedBody body;
  body.person_id = id;
  body.state = unseen_s_ > 0.0 ? body_model::BodyState::kLost : body_model::BodyState::kTracked;
  body.pose = now.pose;
  body.root_velocity_m_per_s = now.velocity_m_per_s;
  body.root_rate_rad_per_s = now.turn_rate_rad_per_s;
  body.rates_rad_per_s = now.rates_rad_per_s;
  body.covariance = CovarianceOf(now.information);
  body_model::PlaceLimbs(*kinematics_, body);
  for (std::size_t limb = 0; limb < body.limbs.size(); ++limb) {
    const LimbEvidence& evidence = now.result.limbs[limb];
    body.limbs[limb].inlier_count = evidence.inlier_count;
    body.limbs[limb].residual_m = evidence.residual_m;
    body.limbs[limb].state = unseen_s_ > 0.0 ? LimbState::kLost : StateOf(evidence);
  }
  AddSize(body);
  return body;
}

body_model::PersonModel FollowedPerson::DescribeModel(Timestamp time) const {
  body_model::PersonModel description{time, *model_};
  description.person_id = id;
  description.female_probability = estimate_.female_probability;
  description.stature_m = estimate_.Length_m("kph");
  const double sigma_m = estimate_.Spread_m("kph");
  description.stature_variance_m2 = sigma_m * sigma_m;
  description.is_frozen = next_lesson_ == 0;
  return description;
}

}  // namespace deixis::pose_fitter
