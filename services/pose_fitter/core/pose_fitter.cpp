#include "services/pose_fitter/core/pose_fitter.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "common/anthropometry/person_estimate.h"
#include "common/anthropometry/population.h"
#include "common/config/config.h"
#include "services/pose_fitter/core/start/start_poses.h"

namespace deixis::pose_fitter {
namespace {

using body_model::BodyPose;
using Eigen::Vector3d;

body_model::Sizes SizesOfPerson(const PoseFitterConfig& config) {
  const auto populations =
      anthropometry::Populations::Load(config::FindConfig("kinematics/population.yaml"));
  std::vector<anthropometry::MeasuredLength> lengths;
  if (config.stature_m > 0.0) {
    lengths.push_back({"kph", config.stature_m, config.stature_sigma_m * config.stature_sigma_m});
  }
  return EstimatePerson(populations, lengths).Sizes_m();
}

}  // namespace

/// One of the poses that may be a person's.
struct PoseFitter::Hypothesis {
  BodyPose pose;
  Vector3d velocity_m_per_s = Vector3d::Zero();
  Vector3d turn_rate_rad_per_s = Vector3d::Zero();
  Eigen::VectorXd rates_rad_per_s;
  FitResult result;
  Eigen::MatrixXd information;
  double mean_score = 0.0;  ///< Of the last few images.
  double age_s = 0.0;
};

struct PoseFitter::Person {
  Person(const PoseFitterConfig& config, const body_model::BodyModel& model)
      : fitter(config.fit, model), evidence(config.evidence) {}
  int id = -1;
  BodyFitter fitter;
  BodyEvidence evidence;
  std::vector<Hypothesis> hypotheses;  ///< The best one first; never empty.
  double unseen_s = 0.0;
};

void StartConfig::Validate() const {
  config::Faults faults;
  faults.Require(iterations >= 1, "iterations", "must be positive");
  faults.ThrowIfAny();
}

void PoseFitterConfig::Validate() const {
  config::Faults faults;
  faults.Require(stature_m == 0.0 || (stature_m > 0.5 && stature_m < 2.6), "stature_m",
                 "must be 0 (not known) or 0.5..2.6");
  faults.ThrowIfAny();
}

PoseFitter::PoseFitter(const PoseFitterConfig& config)
    : config_(config),
      model_(body_model::LoadBody(config::FindConfig(config.body_model), SizesOfPerson(config))),
      sound_(config.sound),
      floor_tracker_(config.floor),
      finder_(config.people),
      tracks_(config.tracks),
      start_evidence_(config.evidence) {
  stature_m_ = config.stature_m;
}

PoseFitter::~PoseFitter() = default;

const body_model::BodyPoses& PoseFitter::Track(const images::DepthImage& image,
                                               const geometry::StereoCalibration& calibration) {
  view_.Update(DepthCameraOf(calibration, image.depth_mm.size()), image.depth_mm);
  const double time_s = 1e-6 * static_cast<double>(image.time.microseconds);
  const double seconds = last_time_ ? SecondsBetween(*last_time_, image.time) : 0.0;
  if (last_time_ && (seconds <= 0.0 || seconds > config_.tracks.hidden_time_s)) people_.clear();
  last_time_ = image.time;
  const auto& is_sound = sound_.Find(view_);
  floor_ = floor_tracker_.Update(view_, is_sound, time_s);
  taken_.assign(view_.z_m().size(), 0);
  for (auto& person : people_) {
    Follow(*person, seconds);
    Take(*person);
  }
  LetGo();
  FindNew(is_sound, time_s);
  Number(time_s);
  Report(image);
  return poses_;
}

void PoseFitter::LetGo() {
  people_.erase(std::remove_if(people_.begin(), people_.end(),
                               [this](const auto& person) {
                                 const Hypothesis& best = person->hypotheses.front();
                                 return person->unseen_s > config_.tracks.hidden_time_s ||
                                        (best.age_s > 2.0 * config_.start.settle_s &&
                                         best.mean_score > config_.start.worst_score);
                               }),
                people_.end());
}

void PoseFitter::Number(double time_s) {
  std::vector<PersonSighting> sightings;
  for (const auto& person : people_) {
    sightings.push_back(
        {person->hypotheses.front().pose.frame_from_root.translation_m, person->id, true});
  }
  const auto& ids = tracks_.Update(sightings, time_s);
  for (std::size_t i = 0; i < people_.size(); ++i) people_[i]->id = ids[i];
}

BodyPose PoseFitter::Predict(const Hypothesis& hypothesis, double seconds) const {
  BodyPose pose = hypothesis.pose;
  const double ahead_s = config_.velocity_share * seconds;
  pose.frame_from_root.translation_m += ahead_s * hypothesis.velocity_m_per_s;
  const Eigen::Quaterniond turn(body_model::RotationFrom(ahead_s * hypothesis.turn_rate_rad_per_s));
  pose.frame_from_root.rotation = (turn * pose.frame_from_root.rotation).normalized();
  pose.angles_rad += ahead_s * hypothesis.rates_rad_per_s;
  return pose;
}

void PoseFitter::Follow(Person& person, double seconds) {
  std::vector<BodyPose> predicted;
  for (const Hypothesis& hypothesis : person.hypotheses) {
    predicted.push_back(Predict(hypothesis, seconds));
  }
  std::vector<const BodyPose*> poses;
  for (const BodyPose& pose : predicted) poses.push_back(&pose);
  person.evidence.Gather(view_, person.fitter.kinematics(), poses, floor_, {&taken_},
                         config_.evidence.gate_m);
  if (person.evidence.points().count() < 50) {
    person.unseen_s += seconds;
    return;
  }
  person.unseen_s = 0.0;
  for (std::size_t i = 0; i < predicted.size(); ++i) {
    Fit(person, person.hypotheses[i], predicted[i], seconds);
  }
  Choose(person);
}

void PoseFitter::Fit(Person& person, Hypothesis& hypothesis, const BodyPose& predicted,
                     double seconds) {
  const BodyPose before = hypothesis.pose;
  hypothesis.pose = predicted;
  hypothesis.result =
      person.fitter.Fit(person.evidence, floor_, predicted, seconds, hypothesis.pose);
  hypothesis.information = person.fitter.information();
  const BodyPose& now = hypothesis.pose;
  hypothesis.velocity_m_per_s =
      (now.frame_from_root.translation_m - before.frame_from_root.translation_m) / seconds;
  const Eigen::AngleAxisd turn(now.frame_from_root.rotation *
                               before.frame_from_root.rotation.conjugate());
  hypothesis.turn_rate_rad_per_s = turn.angle() * turn.axis() / seconds;
  hypothesis.rates_rad_per_s = (now.angles_rad - before.angles_rad) / seconds;
  const double score = hypothesis.result.score + FacingPenalty(now);
  const double share = std::min(1.0, seconds / (0.5 * config_.start.settle_s));
  hypothesis.mean_score += share * (score - hypothesis.mean_score);
  hypothesis.age_s += seconds;
}

// The best one stays before the others, unless one of them is clearly better; with time, all but
// the best go.
void PoseFitter::Choose(Person& person) {
  auto& hypotheses = person.hypotheses;
  std::stable_sort(
      hypotheses.begin(), hypotheses.end(),
      [](const Hypothesis& a, const Hypothesis& b) { return a.mean_score < b.mean_score; });
  while (hypotheses.size() > 1 && hypotheses.back().age_s >= config_.start.settle_s) {
    hypotheses.pop_back();
  }
}

double PoseFitter::FacingPenalty(const BodyPose& pose) const {
  const Vector3d forward = pose.frame_from_root.rotation * Vector3d::UnitX();
  const Vector3d from_camera = pose.frame_from_root.translation_m.normalized();
  return config_.start.facing_away * 0.5 * (1.0 + forward.dot(from_camera));
}

void PoseFitter::Take(const Person& person) {
  const auto owner = static_cast<std::uint8_t>(
      1 + std::min<std::ptrdiff_t>(
              254, std::find_if(people_.begin(), people_.end(), [&person](const auto& other) {
                     return other.get() == &person;
                   }) - people_.begin()));
  const cv::Mat& body = person.evidence.body();
  for (int v = 0; v < body.rows; ++v) {
    const auto* row = body.ptr<std::uint8_t>(v);
    for (int u = 0; u < body.cols; ++u) {
      if (row[u] != 0) taken_[static_cast<std::size_t>(v * body.cols + u)] = owner;
    }
  }
}

void PoseFitter::FindNew(const std::vector<std::uint8_t>& is_sound, double time_s) {
  if (last_try_s_ && time_s >= *last_try_s_ && time_s - *last_try_s_ < config_.start.again_s)
    return;
  last_try_s_ = time_s;
  for (const PersonRegion& region : finder_.Find(view_, is_sound, floor_).regions) {
    if (IsTaken(region)) {
      Doubt(region);
      continue;
    }
    auto person = Start(region);
    if (!person) continue;
    people_.push_back(std::move(person));
    Take(*people_.back());
  }
}

bool PoseFitter::IsTaken(const PersonRegion& region) const {
  const auto& labels = finder_.regions().labels;
  int taken = 0;
  for (std::size_t i = 0; i < labels.size(); ++i) {
    if (labels[i] == region.label && taken_[i] != 0) ++taken;
  }
  return taken > config_.start.most_taken * region.pixel_count;
}

// The best start that faces the camera and the best one that does not, as far as they are good.
std::vector<PoseFitter::Hypothesis> PoseFitter::StartsIn(const PersonRegion& region,
                                                         BodyFitter& fitter,
                                                         BodyEvidence& evidence) {
  BodyFitterConfig coarse = config_.fit;
  coarse.iterations = config_.start.iterations;
  coarse.first_scale_m = config_.start.first_scale_m;
  coarse.first_reach_m = config_.start.first_reach_m;
  coarse.most_rest_rad = config_.start.rest_rad;
  coarse.upright_rad = config_.start.upright_rad;
  BodyFitter coarse_fitter(coarse, model_);
  std::optional<Hypothesis> facing, turned;
  const Vector3d top_m =
      TopOf(view_, finder_.regions().labels, region, floor_, config_.start.head_m);
  for (BodyPose pose : StartPoses(model_, top_m, floor_)) {
    const BodyPose guess = pose;
    start_evidence_.Gather(view_, coarse_fitter.kinematics(), {&guess}, floor_, {},
                           config_.start.gate_m);
    coarse_fitter.Fit(start_evidence_, floor_, pose, std::nullopt, pose);
    const BodyPose near = pose;
    evidence.Gather(view_, fitter.kinematics(), {&near}, floor_, {}, config_.evidence.gate_m);
    Hypothesis hypothesis;
    hypothesis.result = fitter.Fit(evidence, floor_, pose, std::nullopt, pose);
    hypothesis.information = fitter.information();
    hypothesis.mean_score = hypothesis.result.score + FacingPenalty(pose);
    hypothesis.pose = pose;
    hypothesis.rates_rad_per_s.setZero(model_.angle_count());
    if (std::getenv("DBG")) {
      const auto& result = hypothesis.result;
      double fr = 0, sa = 0;
      for (auto& l : result.limbs) {
        fr += l.view.free;
        sa += l.view.samples;
      }
      const Vector3d f = pose.frame_from_root.rotation * Vector3d::UnitX();
      const Vector3d t = pose.frame_from_root.translation_m;
      fprintf(stderr,
              "hyp region at %.1f %.1f %.1f top %.2f px %d like %.2f root %.1f %.1f %.1f fwd %.2f "
              "%.2f %.2f score %.3f free %.3f expl %.3f trunk %.2f\n",
              region.centroid_m.x(), region.centroid_m.y(), region.centroid_m.z(), region.top_m,
              region.pixel_count, region.likeness, t.x(), t.y(), t.z(), f.x(), f.y(), f.z(),
              result.score, fr / sa, result.explained, result.trunk_seen);
    }
    if (hypothesis.mean_score > config_.start.worst_score ||
        hypothesis.result.trunk_seen < config_.start.least_trunk) {
      continue;
    }
    const bool faces = FacingPenalty(pose) < 0.5 * config_.start.facing_away;
    std::optional<Hypothesis>& best = faces ? facing : turned;
    if (!best || hypothesis.mean_score < best->mean_score) best = hypothesis;
  }
  std::vector<Hypothesis> starts;
  for (const auto* best : {&facing, &turned}) {
    if (*best) starts.push_back(**best);
  }
  return starts;
}

std::unique_ptr<PoseFitter::Person> PoseFitter::Start(const PersonRegion& region) {
  auto person = std::make_unique<Person>(config_, model_);
  person->hypotheses = StartsIn(region, person->fitter, person->evidence);
  if (person->hypotheses.empty()) return nullptr;
  std::vector<const BodyPose*> poses;
  for (const Hypothesis& hypothesis : person->hypotheses) poses.push_back(&hypothesis.pose);
  person->evidence.Gather(view_, person->fitter.kinematics(), poses, floor_, {&taken_},
                          config_.evidence.gate_m);
  Choose(*person);
  return person;
}

// Where a person is badly explained, what a start would find there becomes a rival.
void PoseFitter::Doubt(const PersonRegion& region) {
  Person* person = OwnerOf(region);
  if (person == nullptr || person->hypotheses.size() > 1 ||
      person->hypotheses.front().mean_score < config_.start.doubtful_score) {
    return;
  }
  BodyEvidence evidence(config_.evidence);
  for (const Hypothesis& start : StartsIn(region, person->fitter, evidence)) {
    if (start.mean_score < person->hypotheses.front().mean_score) {
      person->hypotheses.push_back(start);
    }
  }
}

PoseFitter::Person* PoseFitter::OwnerOf(const PersonRegion& region) {
  std::vector<int> counts(people_.size() + 1, 0);
  const auto& labels = finder_.regions().labels;
  for (std::size_t i = 0; i < labels.size(); ++i) {
    if (labels[i] == region.label) ++counts[std::min<std::size_t>(taken_[i], people_.size())];
  }
  counts[0] = 0;
  const auto most = std::max_element(counts.begin(), counts.end());
  if (*most == 0) return nullptr;
  return people_[static_cast<std::size_t>(most - counts.begin() - 1)].get();
}

std::vector<body_model::PersonModel> PoseFitter::Models() const {
  body_model::PersonModel model{last_time_.value_or(Timestamp{}), model_};
  model.stature_m = stature_m_;
  model.is_frozen = true;
  return {model};
}

void PoseFitter::Report(const images::DepthImage& image) {
  poses_.time = image.time;
  poses_.camera = image.camera;
  poses_.frame = image.camera;
  poses_.source = "pose_fitter";
  poses_.floor = floor_;
  poses_.bodies.clear();
  for (const auto& followed : people_) {
    Person& person = *followed;
    if (person.id < 0) continue;
    const Hypothesis& best = person.hypotheses.front();
    body_model::TrackedBody& body = poses_.bodies.emplace_back();
    body.person_id = person.id;
    body.state =
        person.unseen_s > 0.0 ? body_model::BodyState::kLost : body_model::BodyState::kTracked;
    body.pose = best.pose;
    body.root_velocity_m_per_s = best.velocity_m_per_s;
    body.root_rate_rad_per_s = best.turn_rate_rad_per_s;
    body.rates_rad_per_s = best.rates_rad_per_s;
    const auto size = best.information.rows();
    body.covariance = config_.covariance_factor *
                      best.information.ldlt().solve(Eigen::MatrixXd::Identity(size, size));
    for (int k = 0; k < 3; ++k) {
      body.covariance(k, k) += config_.position_sigma_m * config_.position_sigma_m;
    }
    body_model::PlaceLimbs(person.fitter.kinematics(), body);
    for (std::size_t limb = 0; limb < body.limbs.size(); ++limb) {
      const LimbEvidence& evidence = best.result.limbs[limb];
      body.limbs[limb].inlier_count = evidence.inlier_count;
      body.limbs[limb].residual_m = evidence.residual_m;
      const auto& view = evidence.view;
      using body_model::LimbState;
      body.limbs[limb].state = evidence.inlier_count >= 8 ? LimbState::kMeasured
                               : 2 * (view.hidden + view.outside) > view.samples
                                   ? LimbState::kHidden
                               : 2 * view.free > view.samples ? LimbState::kLost
                                                              : LimbState::kInferred;
    }
  }
}

}  // namespace deixis::pose_fitter
