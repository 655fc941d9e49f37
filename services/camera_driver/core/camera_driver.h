#pragma once
#include <memory>
#include <optional>
#include <string>

#include "common/capture/calibration.h"
#include "common/capture/calibration_schedule.h"
#include "common/capture/lens_wait.h"
#include "common/capture/pacer.h"
#include "common/capture/picture_encoder.h"
#include "common/capture/sources.h"
#include "common/geometry/camera_calibration.h"
#include "common/images/encoded_image.h"

namespace deixis::camera_driver {

struct CameraDriverConfig {
  std::string camera = "CAMERA";                ///< Name of the camera in all messages.
  capture::LoopableSourceConfig source;         ///< Where pictures come from.
  capture::Pace pace = capture::Pace::kByTime;  ///< How fast a recording is played.
  std::int64_t start_time_utime = -1;           ///< Recordings: see Pacer.
  capture::CalibrationConfig calibration;       ///< What is known of the lens.
  capture::EncodingConfig image;                ///< How pictures are published.

  template <typename Visitor>
  void Visit(Visitor& v) {
    v("camera", camera);
    v("source", source);
    v("pace", pace);
    v("start_time_utime", start_time_utime);
    v("calibration", calibration);
    v("image", image);
  }
  void Check(config::Faults& faults) const;
};

/// What one step of the driver has brought.
struct DriverOutput {
  capture::SourceState state = capture::SourceState::kWaiting;
  std::optional<geometry::CameraCalibration> calibration;  ///< To be published before the picture.
  std::optional<images::EncodedImage> picture;             ///< Set with kPicture only.
};

/// Turns a source of pictures into the stream that is published: each with its capture time, and
/// the calibration before the first picture, once per second of picture time, and when the size
/// changes. Pictures of a dimos robot wait for its lens, see capture::LensWait.
class CameraDriver {
 public:
  CameraDriver(const CameraDriverConfig& config, std::unique_ptr<capture::Source> source);

  /// The next picture that is due at `now` (wall clock); never waits. Throws ConfigError when the
  /// calibration does not suit the pictures.
  DriverOutput Next(Timestamp now);

  /// From now on the lens is this one, as the camera itself says, unless a file is configured. When
  /// pictures have another aspect it is not theirs, and the remark says so.
  void UseLens(const geometry::CameraCalibration& lens);

  /// From now on the camera is mounted like this; nothing = it is not known. Before the first call
  /// it is as in the configuration.
  void UseMount(const std::optional<geometry::CameraMount>& mount);

  capture::SourceStatus status() const;
  /// What is wrong with the playing of a recording; empty when nothing is.
  std::string pace_trouble() const { return pacer_.trouble(); }
  /// What has to be known about the calibration ("guessed ..."); empty before the first picture and
  /// when it is as in its file.
  const std::string& calibration_remark() const { return lens_.remark; }

 private:
  capture::SourceState Fetch();
  bool IsDue(Timestamp now);
  std::optional<geometry::CameraCalibration> CalibrationIfDue(const images::EncodedImage& picture);

  CameraDriverConfig config_;
  std::unique_ptr<capture::Source> source_;
  capture::Calibration calibration_;
  capture::Pacer pacer_;
  bool is_live_;
  std::optional<capture::Picture> waiting_;     ///< Recorded picture whose time has not come.
  std::optional<capture::LensWait> lens_wait_;  ///< Of cameras that say their lens themselves.
  capture::CalibrationAnswer lens_;
  bool is_own_lens_new_ = false;
  std::optional<geometry::CameraMount> mount_;
  capture::CalibrationSchedule schedule_;
};

}  // namespace deixis::camera_driver
