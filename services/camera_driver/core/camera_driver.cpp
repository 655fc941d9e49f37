#include "services/camera_driver/core/camera_driver.h"

#include <utility>

#include "common/config/plain_text.h"

namespace deixis::camera_driver {

void CameraDriverConfig::Check(config::Faults& faults) const {
  faults.Require(config::IsPlainText(camera), "camera", config::kPlainTextRule);
  faults.Require(start_time_utime >= -1 && start_time_utime <= capture::kLatestTime.microseconds,
                 "start_time_utime",
                 "must be -1 (chosen by the pace) or a time in microseconds, 2^59 at most");
  source.Check(faults);
  calibration.Check(faults);
  image.Check(faults);
}

CameraDriver::CameraDriver(const CameraDriverConfig& config,
                           std::unique_ptr<capture::Source> source)
    : config_(config),
      source_(std::move(source)),
      calibration_(config.calibration),
      pacer_(config.pace, config.start_time_utime),
      is_live_(source_->status().is_live),
      mount_(capture::MountOf(config.calibration.mount)) {
  if (config.source.kind == capture::SourceKind::kDimos) lens_wait_.emplace();
}

DriverOutput CameraDriver::Next(Timestamp now) {
  DriverOutput output;
  output.state = Fetch();
  if (!waiting_) return output;
  if (!IsDue(now)) {
    output.state = capture::SourceState::kWaiting;
    return output;
  }
  const Timestamp time = is_live_ ? waiting_->time : pacer_.CaptureTime(waiting_->time);
  const capture::Picture picture = std::move(*waiting_);
  waiting_.reset();  // Whatever comes of it, it is not tried again.
  if (lens_wait_ && lens_wait_->Holds(calibration_, time)) {
    output.state = capture::SourceState::kWaiting;
    return output;
  }
  output.state = capture::SourceState::kPicture;
  output.picture = capture::Encode(picture, time, config_.camera, config_.image);
  output.calibration = CalibrationIfDue(*output.picture);
  return output;
}

capture::SourceState CameraDriver::Fetch() {
  if (waiting_) return capture::SourceState::kPicture;
  capture::Grab grab = source_->Next();
  waiting_ = std::move(grab.picture);
  return grab.state;
}

bool CameraDriver::IsDue(Timestamp now) { return is_live_ || pacer_.IsDue(waiting_->time, now); }

capture::SourceStatus CameraDriver::status() const {
  capture::SourceStatus status = source_->status();
  if (lens_wait_) status.skipped += lens_wait_->held_back();
  return status;
}

void CameraDriver::UseLens(const geometry::CameraCalibration& lens) {
  if (calibration_.UseOwn(lens)) is_own_lens_new_ = true;
}

void CameraDriver::UseMount(const std::optional<geometry::CameraMount>& mount) {
  if (mount_.has_value() != mount.has_value()) schedule_.BeginAnew();
  mount_ = mount;
}

std::optional<geometry::CameraCalibration> CameraDriver::CalibrationIfDue(
    const images::EncodedImage& picture) {
  const bool has_same_size = lens_.calibration.width_px == picture.width_px &&
                             lens_.calibration.height_px == picture.height_px;
  if (!has_same_size || is_own_lens_new_) {
    lens_ = calibration_.For({picture.width_px, picture.height_px});
    schedule_.BeginAnew();
  }
  is_own_lens_new_ = false;
  if (!schedule_.IsDue(picture.time)) return std::nullopt;
  schedule_.NoteSent(picture.time);
  geometry::CameraCalibration calibration = lens_.calibration;
  calibration.camera = config_.camera;
  calibration.time = picture.time;
  return mount_ ? Mounted(std::move(calibration), *mount_) : calibration;
}

}  // namespace deixis::camera_driver
