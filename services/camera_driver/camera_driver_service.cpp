#include "services/camera_driver/camera_driver_service.h"

#include "common/capture/system_clocks.h"
#include "common/logging/log.h"
#include "common/messages/camera_calibration.h"
#include "common/messages/camera_pose.h"
#include "common/messages/image.h"
#include "common/program/source_step.h"
#include "common/transport/channel_name.h"

namespace deixis::camera_driver {
namespace {}  // namespace

void CameraDriverServiceConfig::Validate() const {
  config::Faults faults;
  auto channels = dimos.Channels();
  channels.insert(channels.begin(), {{"image_channel", image_channel},
                                     {"calibration_channel", calibration_channel},
                                     {"pose_channel", pose_channel}});
  for (const auto& [key, fault] : transport::ChannelFaults(channels)) {
    faults.Require(false, key, fault);
  }
  driver.Check(faults);
  faults.ThrowIfAny();
}

CameraDriverService::CameraDriverService(const CameraDriverServiceConfig& config,
                                         transport::Bus& input, transport::Bus& output)
    : config_(config),
      output_(output),
      clock_(capture::SystemClocks()),
      dimos_(config.dimos, config.driver.calibration,
             {[this](const geometry::CameraCalibration& lens) { driver_.UseLens(lens); },
              [this](const geometry::CameraPose& pose) { Publish(pose); }, [this] { Advance(); }}),
      driver_(config.driver, SourceOf(config, input)) {
  // A pose that nobody has given is none until the robot's transforms say it.
  const bool is_given = !config.driver.calibration.mount.IsIdentity();
  if (dimos_.follows_transforms() && !is_given) driver_.UseMount(std::nullopt);
}

std::unique_ptr<capture::Source> CameraDriverService::SourceOf(
    const CameraDriverServiceConfig& config, transport::Bus& input) {
  if (config.driver.source.kind != capture::SourceKind::kDimos) {
    return capture::MakeSource(config.driver.source, capture::SystemClocks());
  }
  return dimos_.Listen(input);
}

program::StepResult CameraDriverService::Step() {
  const capture::SourceState state = Advance();
  log_.Note(driver_.calibration_remark(), driver_.status().trouble);
  if (state == capture::SourceState::kFinished) LogSummary();
  return program::ResultOf(state);
}

capture::SourceState CameraDriverService::Advance() {
  const DriverOutput step = driver_.Next(clock_.Now());
  Publish(step);
  return step.state;
}

void CameraDriverService::Publish(const DriverOutput& step) {
  if (step.calibration) output_.Publish(config_.calibration_channel, *step.calibration);
  if (!step.picture) return;
  output_.Publish(config_.image_channel, *step.picture);
  ++published_;
}

void CameraDriverService::Publish(const geometry::CameraPose& pose) {
  output_.Publish(config_.pose_channel, pose);
  const std::string& parent_frame = config_.driver.calibration.mount.parent_frame;
  driver_.UseMount(geometry::CameraMount{parent_frame, pose.parent_from_camera});
}

void CameraDriverService::LogSummary() const {
  const capture::SourceStatus status = driver_.status();
  if (published_ == 0) {
    throw config::ConfigError("no picture of '" + config_.driver.source.path + "' can be read (" +
                              std::to_string(status.corrupt) +
                              " tried); set source.path to pictures that OpenCV can read");
  }
  if (status.corrupt == 0) {
    logging::Info("recording_finished", {{"published", published_}});
    return;
  }
  logging::Warn("recording_finished", {{"published", published_},
                                       {"unreadable", status.corrupt},
                                       {"last_unreadable", status.last_corrupt}});
}

transport::Health CameraDriverService::health() const {
  const capture::SourceStatus status = driver_.status();
  const std::string pose_trouble = dimos_.trouble();
  transport::Health health;
  const std::string pace_trouble = driver_.pace_trouble();
  health.is_degraded = !status.trouble.empty() || !pose_trouble.empty() || !pace_trouble.empty();
  health.Say(status.trouble);
  health.Say(pace_trouble);
  health.Say(pose_trouble);
  health.Say(driver_.calibration_remark());
  health.SayCount(status.corrupt, "corrupt pictures");
  health.SayCount(status.skipped, "skipped pictures");
  return health;
}

}  // namespace deixis::camera_driver
