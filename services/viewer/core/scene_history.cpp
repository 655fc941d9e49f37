#include "services/viewer/core/scene_history.h"

#include <algorithm>
#include <utility>

#include "common/images/stereo_image.h"

namespace deixis::viewer {
namespace {

constexpr double kSilentStream_s = 2.0;  // A service that is silent for longer is not waited for.
constexpr std::size_t kMostResults = 60;
constexpr std::size_t kMostModels = 64;  // People, and shapes of each while they are learned.

template <typename Result>
void Append(Result result, std::deque<Result>& results) {
  if (!results.empty() && result.time < results.back().time) results.clear();
  results.push_back(std::move(result));
  if (results.size() > kMostResults) results.pop_front();
}

/// Whether nothing more is to be expected of this stream for a picture of `time`.
template <typename Result>
bool HasAnswered(const std::deque<Result>& results, Timestamp time) {
  if (results.empty()) return true;
  const double behind_s = SecondsBetween(results.back().time, time);
  return behind_s <= 0.0 || behind_s > kSilentStream_s;
}

/// The newest result that is not later than `time` nor older than `max_age_s`.
template <typename Result>
std::optional<Result> NewestUntil(const std::deque<Result>& results, Timestamp time,
                                  double max_age_s) {
  for (auto result = results.rbegin(); result != results.rend(); ++result) {
    if (time < result->time) continue;
    if (SecondsBetween(result->time, time) > max_age_s) break;
    return *result;
  }
  return std::nullopt;
}

}  // namespace

void SceneHistoryConfig::Check(config::Faults& faults) const {
  faults.Require(max_delay_s >= 0.0, "history.max_delay_s", "must not be negative");
  faults.Require(max_age_s >= 0.0, "history.max_age_s", "must not be negative");
  faults.Require(decision_shown_s >= 0.0, "history.decision_shown_s", "must not be negative");
  faults.Require(max_images >= 1 && max_images <= 1000, "history.max_images",
                 "must lie in 1..1000");
}

void SceneHistory::Add(images::Image image) {
  if (!images_.empty() && image.time < images_.back().time) Clear();
  images_.push_back(std::move(image));
  if (images_.size() > static_cast<std::size_t>(config_.max_images)) images_.pop_front();
}

void SceneHistory::Add(scene::Objects objects) { Append(std::move(objects), objects_); }
void SceneHistory::Add(scene::Hands hands) { Append(std::move(hands), hands_); }
void SceneHistory::Add(scene::GestureState state) { Append(std::move(state), states_); }
void SceneHistory::Add(scene::Gesture gesture) { decision_ = std::move(gesture); }
void SceneHistory::Add(body_model::BodyPoses bodies) { Append(std::move(bodies), bodies_); }

void SceneHistory::Add(body_model::PersonModel model) {
  const auto is_same = [&](const auto& known) { return known.body.id() == model.body.id(); };
  models_.erase(std::remove_if(models_.begin(), models_.end(), is_same), models_.end());
  models_.push_back(std::move(model));
  if (models_.size() > kMostModels) models_.pop_front();
}

void SceneHistory::Add(geometry::StereoCalibration calibration) {
  calibration_ = std::move(calibration);
}

std::optional<Scene> SceneHistory::Take() {
  for (auto image = images_.rbegin(); image != images_.rend(); ++image) {
    if (taken_ && !(*taken_ < image->time)) break;
    if (!IsComplete(*image)) continue;
    taken_ = image->time;
    return Compose(*image);
  }
  return std::nullopt;
}

std::optional<Scene> SceneHistory::From(Timestamp time) const {
  const auto image = std::find_if(images_.begin(), images_.end(), [time](const auto& candidate) {
    return !(candidate.time < time);
  });
  if (image == images_.end()) return std::nullopt;
  if (SecondsBetween(time, image->time) > config_.max_delay_s) return std::nullopt;
  return Compose(*image);
}

bool SceneHistory::HasPassed(Timestamp time) const {
  return !images_.empty() && SecondsBetween(time, images_.back().time) > config_.max_delay_s;
}

bool SceneHistory::IsComplete(const images::Image& image) const {
  const bool has_waited = SecondsBetween(image.time, images_.back().time) >= config_.max_delay_s;
  return has_waited || (HasAnswered(objects_, image.time) && HasAnswered(hands_, image.time) &&
                        HasAnswered(states_, image.time) && HasAnswered(bodies_, image.time));
}

Scene SceneHistory::Compose(const images::Image& image) const {
  Scene scene;
  scene.image = image;
  scene.objects = NewestUntil(objects_, image.time, config_.max_age_s);
  scene.hands = NewestUntil(hands_, image.time, config_.max_age_s);
  scene.state = NewestUntil(states_, image.time, config_.max_age_s);
  if (decision_) {
    const double age_s = SecondsBetween(decision_->time, image.time);
    if (age_s >= 0.0 && age_s <= config_.decision_shown_s) scene.decision = decision_;
  }
  ComposeBodies(scene);
  return scene;
}

// Poses of another camera, or in a frame that is not its own, cannot be drawn here.
void SceneHistory::ComposeBodies(Scene& scene) const {
  const images::Image& image = scene.image;
  auto bodies = NewestUntil(bodies_, image.time, config_.max_age_s);
  if (!bodies || !calibration_) return;
  const std::string& camera = calibration_->camera;
  if (bodies->camera != camera || bodies->frame != camera || image.camera != camera) return;
  const geometry::CameraCalibration& rectified = calibration_->rectified;
  if (!images::MayCoverSameView(image.bgr.size(), {rectified.width_px, rectified.height_px})) {
    return;
  }
  scene.camera = geometry::Scaled(rectified, image.bgr.cols, image.bgr.rows);
  for (const body_model::PersonModel& model : models_) {
    const bool is_used = std::any_of(bodies->bodies.begin(), bodies->bodies.end(),
                                     [&](const auto& b) { return b.model_id == model.body.id(); });
    if (is_used) scene.models.push_back(model);
  }
  scene.bodies = std::move(bodies);
}

void SceneHistory::Clear() {
  images_.clear();
  objects_.clear();
  hands_.clear();
  states_.clear();
  bodies_.clear();
  decision_.reset();
  taken_.reset();
}

}  // namespace deixis::viewer
