#pragma once
#include <string>

#include "common/capture/playing_clock.h"
#include "common/dimos/dimos_camera.h"
#include "common/program/service_loop.h"
#include "common/program/source_log.h"
#include "common/transport/bus.h"
#include "common/transport/status_reporter.h"
#include "services/stereo_driver/core/stereo_driver.h"

namespace deixis::stereo_driver {

/// Channels of a dimos robot, as they are on the wire: no prefix goes in front of them.
struct DimosConfig {
  dimos::DimosCameraConfig camera;                               ///< The colour camera.
  std::string depth_channel = "/depth_image#sensor_msgs.Image";  ///< 16UC1 or 32FC1.

  template <typename Visitor>
  void Visit(Visitor& v) {
    camera.Visit(v);  // On the same level: `dimos.image_channel`.
    v("depth_channel", depth_channel);
  }
  void Validate() const { camera.Validate(); }
};

struct StereoDriverServiceConfig {
  std::string stereo_channel = "STEREO";                   ///< Pictures with depth go here.
  std::string calibration_channel = "STEREO_CALIBRATION";  ///< What is known of the cameras.
  std::string pair_channel = "STEREO_PAIR";     ///< Pairs as taken: to here, or from here.
  std::string kinect_channel = "KINECT_FRAME";  ///< source.kind kinect_channel: from here.
  std::string pose_channel = "CAMERA_POSE";     ///< source.kind dimos: the camera's pose, to here.
  std::string poses_channel = "BODY_POSES";  ///< Where people are, from here; empty = nobody says.
  DimosConfig dimos;                         ///< source.kind dimos: from here.
  bool publishes_pairs = false;              ///< Pairs go out too, so that a log can keep them.
  StereoDriverConfig driver;

  template <typename Visitor>
  void Visit(Visitor& v) {
    v("stereo_channel", stereo_channel);
    v("calibration_channel", calibration_channel);
    v("pair_channel", pair_channel);
    v("kinect_channel", kinect_channel);
    v("pose_channel", pose_channel);
    v("poses_channel", poses_channel);
    v("dimos", dimos);
    v("publishes_pairs", publishes_pairs);
    driver.Visit(v);  // On the same level: `source.kind`, not `driver.source.kind`.
  }
  void Validate() const;
};

/// Publishes pictures with the depth of the same view, and what they were measured with.
class StereoDriverService {
 public:
  /// Opens the cameras or recordings, or listens for pairs or depth frames on `input`. Throws
  /// ConfigError when a source or a calibration is not there.
  StereoDriverService(const StereoDriverServiceConfig& config, transport::Bus& input,
                      transport::Bus& output);

  /// Throws ConfigError at the end of a recording that gave no frame.
  program::StepResult Step();
  transport::Health health() const;

 private:
  std::unique_ptr<FrameSource> SourceOf(const StereoDriverServiceConfig& config,
                                        transport::Bus& input);
  void Listen(transport::Bus& input);
  /// Publishes what is due. A robot's frames are published as they come, from within the bus: it
  /// drops and counts what cannot be, where Step() would end the program.
  capture::SourceState Advance();
  void PublishIfUsable(const std::optional<StereoOutput>& output);
  void Publish(const geometry::CameraPose& pose);
  const capture::MountConfig& mount() const;
  void LogRegistration();
  void LogRefusal();
  void LogSummary() const;

  StereoDriverServiceConfig config_;
  transport::Bus& output_;
  capture::PlayingClock clock_;
  dimos::DimosCamera dimos_;
  StereoDriver driver_;
  std::int64_t published_ = 0;  ///< Frames.
  program::SourceLog log_;
  std::string logged_registration_fault_;
  std::string logged_refusal_;
};

}  // namespace deixis::stereo_driver
