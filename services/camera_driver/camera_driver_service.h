#pragma once
#include <memory>
#include <string>

#include "common/capture/playing_clock.h"
#include "common/dimos/dimos_camera.h"
#include "common/program/service_loop.h"
#include "common/program/source_log.h"
#include "common/transport/bus.h"
#include "common/transport/status_reporter.h"
#include "services/camera_driver/core/camera_driver.h"

namespace deixis::camera_driver {

struct CameraDriverServiceConfig {
  std::string image_channel = "CAMERA";                    ///< Pictures go here.
  std::string calibration_channel = "CAMERA_CALIBRATION";  ///< The lens goes here.
  std::string pose_channel = "CAMERA_POSE";  ///< Where a dimos robot holds the camera: to here.
  dimos::DimosCameraConfig dimos;            ///< For pictures of a dimos robot.
  CameraDriverConfig driver;

  template <typename Visitor>
  void Visit(Visitor& v) {
    v("image_channel", image_channel);
    v("calibration_channel", calibration_channel);
    v("pose_channel", pose_channel);
    v("dimos", dimos);
    driver.Visit(v);  // On the same level: `source.kind`, not `driver.source.kind`.
  }
  void Validate() const;
};

/// Publishes a camera's pictures and its calibration. Its pictures come from a source that it
/// opens, or, of a dimos robot, over the bus; then it publishes the camera's pose, too, by the
/// robot's transforms.
class CameraDriverService {
 public:
  /// Opens the source; throws ConfigError when it is not there. Of `input` only channels of a dimos
  /// robot are read.
  CameraDriverService(const CameraDriverServiceConfig& config, transport::Bus& input,
                      transport::Bus& output);

  /// Throws ConfigError at the end of a recording of which no picture could be read.
  program::StepResult Step();
  transport::Health health() const;

 private:
  std::unique_ptr<capture::Source> SourceOf(const CameraDriverServiceConfig& config,
                                            transport::Bus& input);
  void Publish(const DriverOutput& step);
  void Publish(const geometry::CameraPose& pose);
  void LogSummary() const;

  CameraDriverServiceConfig config_;
  transport::Bus& output_;
  capture::PlayingClock clock_;
  dimos::DimosCamera dimos_;
  CameraDriver driver_;
  std::int64_t published_ = 0;  ///< Pictures.
  program::SourceLog log_;
};

}  // namespace deixis::camera_driver
