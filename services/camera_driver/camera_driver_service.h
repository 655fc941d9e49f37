#pragma once
#include <string>

#include "common/capture/playing_clock.h"
#include "common/program/service_loop.h"
#include "common/transport/bus.h"
#include "common/transport/status_reporter.h"
#include "services/camera_driver/core/camera_driver.h"

namespace deixis::camera_driver {

struct CameraDriverServiceConfig {
  std::string image_channel = "CAMERA";                    ///< Pictures go here.
  std::string calibration_channel = "CAMERA_CALIBRATION";  ///< The lens goes here.
  CameraDriverConfig driver;

  template <typename Visitor>
  void Visit(Visitor& v) {
    v("image_channel", image_channel);
    v("calibration_channel", calibration_channel);
    driver.Visit(v);  // On the same level: `source.kind`, not `driver.source.kind`.
  }
  void Validate() const;
};

/// Publishes a camera's pictures and its calibration.
class CameraDriverService {
 public:
  /// Opens the source; throws ConfigError when it is not there. `input` is not used.
  CameraDriverService(const CameraDriverServiceConfig& config, transport::Bus& input,
                      transport::Bus& output);

  /// Throws ConfigError at the end of a recording of which no picture could be read.
  program::StepResult Step();
  transport::Health health() const;

 private:
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
