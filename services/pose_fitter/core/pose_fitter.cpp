#include "services/pose_fitter/core/pose_fitter.h"

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

struct PoseFitter::Person {
  Person(int person_id, const PoseFitterConfig& config, const body_model::BodyModel& model)
      : id(person_id), fitter(config.fit, model), evidence(config.evidence) {}
  int id;
  BodyFitter fitter;
  BodyEvidence evidence;
  BodyPose pose;
  BodyPose rates;  // Change per second: root translation, root turn (as quaternion per second no).
  Vector3d turn_rate = Vector3d::Zero();
  FitResult result;
  double unseen_s = 0.0;
  double age_s = 0.0;
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
      start_evidence_(config.evidence) {
  stature_m_ = config.stature_m;
}

PoseFitter::~PoseFitter() = default;

const body_model::BodyPoses& PoseFitter::Track(const images::DepthImage& image,
                                               const geometry::StereoCalibration& calibration) {
  view_.Update(DepthCameraOf(calibration, image.depth_mm.size()), image.depth_mm);
  const double seconds = last_time_ ? SecondsBetween(*last_time_, image.time) : 0.0;
  if (last_time_ && (seconds <= 0.0 || seconds > config_.forget_after_s)) people_.clear();
  last_time_ = image.time;
  taken_.assign(view_.z_m().size(), 0);
  for (auto& person : people_) {
    Follow(*person, seconds);
    Take(*person);
  }
  people_.erase(std::remove_if(people_.begin(), people_.end(),
                               [this](const auto& person) {
                                 return person->unseen_s > config_.forget_after_s;
                               }),
                people_.end());
  if (people_.empty()) FindNew();
  Report(image);
  return poses_;
}

void PoseFitter::Follow(Person& person, double seconds) {
  const BodyPose before = person.pose;
  BodyPose predicted = before;
  const double ahead = config_.velocity_share * seconds;
  predicted.frame_from_root.translation_m += ahead * person.rates.frame_from_root.translation_m;
  predicted.frame_from_root.rotation =
      (Eigen::Quaterniond(body_model::RotationFrom(ahead * person.turn_rate)) *
       before.frame_from_root.rotation)
          .normalized();
  predicted.angles_rad += ahead * person.rates.angles_rad;
  person.fitter.kinematics().Update(predicted);
  person.evidence.Gather(view_, person.fitter.kinematics(), floor_, {&taken_},
                         config_.evidence.gate_m);
  person.pose = predicted;
  if (person.evidence.points().count() < 50) {
    person.unseen_s += seconds;
    person.pose = before;
    return;
  }
  person.result = person.fitter.Fit(person.evidence, floor_, predicted, seconds, person.pose);
  person.unseen_s = 0.0;
  person.age_s += seconds;
  person.rates.frame_from_root.translation_m =
      (person.pose.frame_from_root.translation_m - before.frame_from_root.translation_m) / seconds;
  const Eigen::AngleAxisd turn(person.pose.frame_from_root.rotation *
                               before.frame_from_root.rotation.conjugate());
  person.turn_rate = turn.angle() * turn.axis() / seconds;
  person.rates.angles_rad = (person.pose.angles_rad - before.angles_rad) / seconds;
}

void PoseFitter::Take(const Person& person) {
  const cv::Mat& body = person.evidence.body();
  for (int v = 0; v < body.rows; ++v) {
    const auto* row = body.ptr<std::uint8_t>(v);
    for (int u = 0; u < body.cols; ++u) {
      if (row[u] != 0) taken_[static_cast<std::size_t>(v * body.cols + u)] = 1;
    }
  }
}

void PoseFitter::FindNew() {
  regions_ = FindPeople(view_, floor_);
  floor_ = regions_.floor;
  for (const PersonRegion& region : regions_.regions) {
    auto person = Start(region);
    if (!person) continue;
    person->id = next_id_++;
    people_.push_back(std::move(person));
  }
}

std::unique_ptr<PoseFitter::Person> PoseFitter::Start(const PersonRegion& region) {
  start_evidence_.GatherRegion(view_, regions_.labels, region.label, floor_);
  PoseFitterConfig config = config_;
  config.fit.iterations = config_.start.iterations;
  config.fit.first_scale_m = config_.start.first_scale_m;
  config.fit.first_reach_m = config_.start.first_reach_m;
  BodyFitter fitter(config.fit, model_);
  auto best = std::make_unique<Person>(-1, config_, model_);
  best->result.score = 1e9;
  for (BodyPose pose : StartPoses(model_, region, floor_)) {
    const FitResult result = fitter.Fit(start_evidence_, floor_, pose, std::nullopt, pose);
    if (std::getenv("DBG")) {
      double fr=0,sa=0; for (auto& l : result.limbs) { fr += l.view.free; sa += l.view.samples; }
      const Vector3d f = pose.frame_from_root.rotation * Vector3d::UnitX();
      fprintf(stderr, "hyp top %.2f px %d fwd %.2f %.2f %.2f score %.3f free %.3f explained %.3f\n", region.top_m, region.pixel_count, f.x(), f.y(), f.z(), result.score, fr/sa, result.explained);
    }
    if (result.score >= best->result.score) continue;
    best->result = result;
    best->pose = pose;
  }
  if (best->result.score > config_.start.worst_score) return nullptr;
  best->rates.angles_rad.setZero(model_.angle_count());
  fitter.Fit(start_evidence_, floor_, best->pose, std::nullopt, best->pose);
  best->evidence = start_evidence_;
  best->result = best->fitter.Fit(best->evidence, floor_, best->pose, std::nullopt, best->pose);
  return best;
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
  poses_.bodies.resize(people_.size());
  for (std::size_t i = 0; i < people_.size(); ++i) {
    Person& person = *people_[i];
    body_model::TrackedBody& body = poses_.bodies[i];
    body.person_id = person.id;
    body.state =
        person.unseen_s > 0.0 ? body_model::BodyState::kLost : body_model::BodyState::kTracked;
    body.pose = person.pose;
    body.root_velocity_m_per_s = person.rates.frame_from_root.translation_m;
    body.root_rate_rad_per_s = person.turn_rate;
    body.rates_rad_per_s = person.rates.angles_rad;
    body.covariance = config_.covariance_factor * person.fitter.Covariance();
    for (int k = 0; k < 3; ++k) {
      body.covariance(k, k) += config_.position_sigma_m * config_.position_sigma_m;
    }
    body_model::PlaceLimbs(person.fitter.kinematics(), body);
    for (std::size_t limb = 0; limb < body.limbs.size(); ++limb) {
      const LimbEvidence& evidence = person.result.limbs[limb];
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
