#include "services/stereo_driver/stereo_driver_service.h"

#include "common/capture/pushed_source.h"
#include "common/capture/system_clocks.h"
#include "common/logging/log.h"
#include "common/messages/body_poses.h"
#include "common/messages/camera_pose.h"
#include "common/messages/depth_image.h"
#include "common/messages/rgbd_image.h"
#include "common/messages/stereo_calibration.h"
#include "common/messages/stereo_image.h"
#include "common/messages/stereo_pair.h"
#include "common/program/source_step.h"
#include "common/transport/channel_name.h"
#include "services/stereo_driver/core/sources/matched_source.h"

namespace deixis::stereo_driver {
namespace {

using transport::Delivery;

/// What a source's pictures are called on their own.
struct SideNames {
  std::string left, right;
};

SideNames NamesOf(FrameSourceKind kind) {
  const bool has_depth =
      kind == FrameSourceKind::kColourAndDepth || kind == FrameSourceKind::kDimos;
  return has_depth ? SideNames{"colour", "depth"} : SideNames{"left", "right"};
}

std::string Origin(const FrameSourceConfig& source) {
  const std::string left = "source.left '" + source.left.path + "'";
  if (source.kind == FrameSourceKind::kSideBySide) return left;
  return left + " and source.right '" + source.right.path + "'";
}

std::int64_t Lost(const FrameSourceStatus& status) {
  return status.pictures.corrupt + status.unmatched_left + status.unmatched_right + status.unusable;
}

KeepPairs WhatToKeep(const StereoDriverServiceConfig& config) {
  return config.publishes_pairs ? KeepPairs::kYes : KeepPairs::kNo;
}

}  // namespace

void StereoDriverServiceConfig::Validate() const {
  config::Faults faults;
  auto channels = dimos.camera.Channels();
  channels.insert(channels.begin(), {{"stereo_channel", stereo_channel},
                                     {"calibration_channel", calibration_channel},
                                     {"pair_channel", pair_channel},
                                     {"kinect_channel", kinect_channel},
                                     {"pose_channel", pose_channel},
                                     {"dimos.depth_channel", dimos.depth_channel}});
  if (!poses_channel.empty()) channels.push_back({"poses_channel", poses_channel});
  for (const auto& [key, fault] : transport::ChannelFaults(channels)) {
    faults.Require(false, key, fault);
  }
  faults.Require(!publishes_pairs || driver.source.kind != FrameSourceKind::kPairChannel,
                 "publishes_pairs", "must be false when the pairs come from pair_channel");
  driver.Check(faults);
  faults.ThrowIfAny();
}

StereoDriverService::StereoDriverService(const StereoDriverServiceConfig& config,
                                         transport::Bus& input, transport::Bus& output)
    : config_(config),
      output_(output),
      clock_(capture::SystemClocks()),
      dimos_(config.dimos.camera, config.driver.depth_camera.calibration,
             {[this](const geometry::CameraCalibration& lens) { driver_.UseLens(lens); },
              [this](const geometry::CameraPose& pose) { Publish(pose); }, [this] { Advance(); }}),
      driver_(config.driver, SourceOf(config, input), WhatToKeep(config)) {
  // A pose that nobody has given is none until the robot's transforms say it.
  if (dimos_.follows_transforms() && mount().IsIdentity()) driver_.UseMount(std::nullopt);
  Listen(input);
}

std::unique_ptr<FrameSource> StereoDriverService::SourceOf(const StereoDriverServiceConfig& config,
                                                           transport::Bus& input) {
  if (config.driver.source.kind != FrameSourceKind::kDimos) {
    return MakeFrameSource(config.driver.source, capture::SystemClocks());
  }
  auto colour = dimos_.Listen(input);
  auto depth = std::make_unique<capture::PushedSource>(config.dimos.depth_channel,
                                                       capture::SystemClocks().monotonic);
  input.SubscribeForeign<images::DepthImage>(
      config.dimos.depth_channel, Delivery::kLatest,
      [this, pictures = depth.get()](const images::DepthImage& image) {
        pictures->Push(image);
        Advance();
      });
  return std::make_unique<MatchedSource>(
      std::move(colour), std::move(depth), config.driver.source.max_skew_s,
      [](const capture::Picture& picture, const capture::Picture& distances) {
        return ComposeColourAndDepth(picture, distances, /*depth_unit_mm=*/1.0);
      });
}

void StereoDriverService::Listen(transport::Bus& input) {
  // Who writes a log is told nothing: people are then found by what stands out.
  if (!config_.poses_channel.empty() && config_.driver.LooksForPeople() && input.can_receive()) {
    input.Subscribe<body_model::BodyPoses>(
        config_.poses_channel, Delivery::kEvery,
        [this](const body_model::BodyPoses& poses) { driver_.Hear(poses); });
  }
  if (config_.driver.source.kind == FrameSourceKind::kPairChannel) {
    input.Subscribe<images::StereoPair>(
        config_.pair_channel, Delivery::kLatest,
        [this](const images::StereoPair& pair) { PublishIfUsable(driver_.TryConvert(pair)); });
  }
  if (config_.driver.source.kind == FrameSourceKind::kKinectChannel) {
    input.Subscribe<images::RgbdImage>(
        config_.kinect_channel, Delivery::kLatest,
        [this](const images::RgbdImage& image) { PublishIfUsable(driver_.TryConvert(image)); });
  }
}

program::StepResult StereoDriverService::Step() {
  const capture::SourceState state = Advance();
  log_.Note(driver_.calibration_remark(), driver_.status().pictures.trouble);
  LogRegistration();
  LogRefusal();
  if (state == capture::SourceState::kFinished) LogSummary();
  return program::ResultOf(state);
}

capture::SourceState StereoDriverService::Advance() {
  const StereoStep step = driver_.Next(clock_.Now());
  PublishIfUsable(step.output);
  return step.state;
}

void StereoDriverService::PublishIfUsable(const std::optional<StereoOutput>& output) {
  if (!output) return;
  if (output->calibration) output_.Publish(config_.calibration_channel, *output->calibration);
  if (output->pair) output_.Publish(config_.pair_channel, *output->pair);
  output_.Publish(config_.stereo_channel, output->stereo);
  ++published_;
}

void StereoDriverService::Publish(const geometry::CameraPose& pose) {
  output_.Publish(config_.pose_channel, pose);
  driver_.UseMount(geometry::CameraMount{mount().parent_frame, pose.parent_from_camera});
}

// Of a dimos robot: what it has is a depth camera.
const capture::MountConfig& StereoDriverService::mount() const {
  return config_.driver.depth_camera.calibration.mount;
}

void StereoDriverService::LogSummary() const {
  const FrameSourceStatus status = driver_.status();
  if (published_ == 0) {
    throw config::ConfigError("no frame of " + Origin(config_.driver.source) + " can be used (" +
                              std::to_string(Lost(status)) +
                              " pictures tried); do they belong together in time and size?" +
                              (status.last_unusable.empty() ? "" : " " + status.last_unusable));
  }
  if (Lost(status) == 0) {
    logging::Info("recording_finished", {{"published", published_}});
    return;
  }
  const SideNames names = NamesOf(config_.driver.source.kind);
  logging::Warn("recording_finished", {{"published", published_},
                                       {"unreadable", status.pictures.corrupt},
                                       {"last_unreadable", status.pictures.last_corrupt},
                                       {"unmatched_" + names.left, status.unmatched_left},
                                       {"unmatched_" + names.right, status.unmatched_right},
                                       {"unusable", status.unusable}});
}

void StereoDriverService::LogRefusal() {
  const FrameSourceStatus status = driver_.status();
  if (status.is_refusing && status.last_unusable != logged_refusal_) {
    logging::Warn("unusable", {{"reason", status.last_unusable}});
  }
  logged_refusal_ = status.is_refusing ? status.last_unusable : "";
}

void StereoDriverService::LogRegistration() {
  const std::string& fault = driver_.registration_fault();
  const bool is_new = fault != logged_registration_fault_;
  if (is_new && !fault.empty()) logging::Warn("registration", {{"fault", fault}});
  logged_registration_fault_ = fault;
}

transport::Health StereoDriverService::health() const {
  const FrameSourceStatus status = driver_.status();
  const std::string pose_trouble = dimos_.trouble();
  transport::Health health;
  const std::string pace_trouble = driver_.pace_trouble();
  health.is_degraded = !status.pictures.trouble.empty() || !pose_trouble.empty() ||
                       !pace_trouble.empty() || !driver_.registration_fault().empty() ||
                       status.is_refusing;
  health.Say(status.pictures.trouble);
  health.Say(pace_trouble);
  health.Say(pose_trouble);
  health.Say(driver_.registration_fault());
  health.Say(driver_.calibration_remark());
  health.SayCount(status.pictures.corrupt, "corrupt pictures");
  health.SayCount(status.pictures.skipped, "skipped pictures");
  health.SayCount(driver_.poses_elsewhere(), "poses of another picture or frame");
  const SideNames names = NamesOf(config_.driver.source.kind);
  health.SayCount(status.unmatched_left,
                  names.left + " pictures without a " + names.right + " one");
  health.SayCount(status.unmatched_right,
                  names.right + " pictures without a " + names.left + " one");
  const std::string& why = status.last_unusable;
  health.SayCount(status.unusable, "pictures that make no pair" + (why.empty() ? "" : ": " + why));
  return health;
}

}  // namespace deixis::stereo_driver
