#include "services/pose_fitter/pose_fitter_service.h"

#include "common/messages/body_poses.h"
#include "common/messages/hands.h"
#include "common/messages/objects.h"
#include "common/messages/person_model.h"
#include "common/messages/stereo_calibration.h"
#include "common/messages/stereo_image.h"
#include "common/transport/channel_name.h"

namespace deixis::pose_fitter {

namespace {

constexpr double kModelPeriod_s = 1.0;
constexpr double kLatest_s = 1.0;  // An image older than the last by more tells of another clock.

bool IsLate(Timestamp time, Timestamp last) {
  const double ahead_s = SecondsBetween(last, time);
  return ahead_s <= 0.0 && ahead_s >= -kLatest_s;
}

}  // namespace

void PoseFitterServiceConfig::Validate() const {
  config::Faults faults;
  const auto channel_faults =
      transport::ChannelFaults({{"stereo_channel", stereo_channel},
                                {"calibration_channel", calibration_channel},
                                {"hands_channel", hands_channel},
                                {"objects_channel", objects_channel},
                                {"model_channel", model_channel},
                                {"poses_channel", poses_channel}});
  for (const auto& [key, fault] : channel_faults) faults.Require(false, key, fault);
  faults.ThrowIfAny();
}

PoseFitterService::PoseFitterService(const PoseFitterServiceConfig& config, transport::Bus& input,
                                     transport::Bus& output)
    : config_(config), output_(output), fitter_(config.fitter) {
  using transport::Delivery;
  input.Subscribe<geometry::StereoCalibration>(
      config.calibration_channel, Delivery::kEvery,
      [this](const geometry::StereoCalibration& calibration) { calibration_ = calibration; });
  input.Subscribe<scene::Hands>(config.hands_channel, Delivery::kEvery,
                                [this](const scene::Hands& hands) { fitter_.See(hands); });
  input.Subscribe<scene::Objects>(config.objects_channel, Delivery::kEvery,
                                  [this](const scene::Objects& objects) { fitter_.See(objects); });
  input.Subscribe<images::StereoImage>(
      config.stereo_channel, Delivery::kLatest,
      [this](const images::StereoImage& stereo) { OnStereo(stereo); });
}

transport::Health PoseFitterService::health() const {
  if (calibration_) return {};
  return {false, "waiting for the first " + config_.calibration_channel};
}

void PoseFitterService::RequireUsable(const images::StereoImage& stereo) const {
  if (!calibration_) throw messages::Rejected("no_calibration");
  const auto& rectified = calibration_->rectified;
  if (!images::MayCoverSameView(stereo.depth_mm.size(),
                                {rectified.width_px, rectified.height_px})) {
    throw messages::Rejected("depth_of_other_view");
  }
  if (last_time_ && IsLate(stereo.left.time, *last_time_)) throw messages::Rejected("late_image");
}

void PoseFitterService::OnStereo(const images::StereoImage& stereo) {
  RequireUsable(stereo);
  last_time_ = stereo.left.time;
  const auto& poses =
      fitter_.Track({stereo.left.time, calibration_->camera, stereo.depth_mm}, *calibration_);
  PublishModels(stereo.left.time);
  output_.Publish(config_.poses_channel, poses);
}

// All models once a second, and one that changed or is new before the first pose of it.
void PoseFitterService::PublishModels(Timestamp time) {
  const bool is_due = !models_time_ || time < *models_time_ ||
                      SecondsBetween(*models_time_, time) >= kModelPeriod_s;
  if (is_due) {
    models_time_ = time;
    known_models_.clear();
  }
  for (auto& model : fitter_.Models()) {
    if (!known_models_.insert({model.person_id, model.body.id()}).second) continue;
    model.time = time;
    output_.Publish(config_.model_channel, model);
  }
}

}  // namespace deixis::pose_fitter
