#pragma once
#include <memory>
#include <string>

#include "common/capture/playing_clock.h"
#include "common/program/service_loop.h"
#include "common/transport/bus.h"
#include "common/transport/status_reporter.h"
#include "services/camera_driver/core/camera_driver.h"

namespace deixis::camera_driver {

/// Channels of a dimos robot, as they are on the wire.
struct DimosConfig {
  std::string image_channel = "/color_image#sensor_msgs.Image";      ///< Or CompressedImage.
  std::string info_channel = "/camera_info#sensor_msgs.CameraInfo";  ///< The lens.

  template <typename Visitor>
  void Visit(Visitor& v) {
    v("image_channel", image_channel);
    v("info_channel", info_channel);
  }
};

struct CameraDriverServiceConfig {
  std::string image_channel = "CAMERA";                    ///< Pictures go here.
  std::string calibration_channel = "CAMERA_CALIBRATION";  ///< The lens goes here.
  DimosConfig dimos;                                       ///< For pictures of a dimos robot.
  CameraDriverConfig driver;

  template <typename Visitor>
  void Visit(Visitor& v) {
    v("image_channel", image_channel);
    v("calibration_channel", calibration_channel);
    v("dimos", dimos);
    driver.Visit(v);  // On the same level: `source.kind`, not `driver.source.kind`.
  }
  void Validate() const;
};

/// Publishes a camera's pictures and its calibration. Its pictures come from a source that it
/// opens, or, of a dimos robot, over the bus.
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
  void LogNews();
  void LogSummary() const;

  CameraDriverServiceConfig config_;
  transport::Bus& output_;
  capture::PlayingClock clock_;
  CameraDriver driver_;
  std::int64_t published_ = 0;  ///< Pictures.
  std::string logged_remark_;
  std::string logged_trouble_;
};

}  // namespace deixis::camera_driver
