#include "common/capture/calibration.h"

#include <cmath>
#include <utility>

#include "common/capture/opencv_file.h"
#include "common/geometry/lens_limits.h"
#include "common/text/number_text.h"
#include "common/text/size_text.h"

namespace deixis::capture {
namespace {

using geometry::CameraCalibration;

constexpr double kAspectTolerance = 0.01;

CalibrationAnswer Guess(cv::Size size, const CalibrationConfig& config) {
  const double fov_rad = config.horizontal_fov_deg * M_PI / 180.0;
  return {geometry::GuessCalibration(size.width, size.height, fov_rad),
          "not calibrated: guessed from a horizontal field of view of " +
              text::NumberText(config.horizontal_fov_deg) + " deg; set " + config.key + ".file"};
}

LensFile ReadNamed(const CalibrationConfig& config) {
  const std::string cure = "set " + config.key + ".file, or leave it empty to guess";
  return ReadLensFile(config::FindConfig(config.file, cure).string(), cure);
}

// One that comes over the bus must not stop its receiver.
bool CanBeScaled(const CameraCalibration& lens, cv::Size size) {
  return HasSameAspect(lens, size) &&
         geometry::IsLens(geometry::Scaled(lens, size.width, size.height));
}

// Time, name and mount apart.
bool IsSameLens(const CameraCalibration& a, const CameraCalibration& b) {
  return a.width_px == b.width_px && a.height_px == b.height_px &&
         a.distortion_model == b.distortion_model && a.distortion == b.distortion &&
         a.focal_px == b.focal_px && a.principal_point_px == b.principal_point_px &&
         a.rectification == b.rectification;
}

}  // namespace

void CalibrationConfig::Check(config::Faults& faults) const {
  faults.Require(horizontal_fov_deg > 0.0 && horizontal_fov_deg < 180.0,
                 "calibration.horizontal_fov_deg", "must lie between 0 and 180");
}

LensFile ReadLensFile(const std::string& path, const std::string& cure) {
  const OpenCvFile file(path, cure);
  LensFile lens{path, ReadLens(file, {})};
  const cv::Size size = file.ImageSize();
  lens.calibration.width_px = size.width;
  lens.calibration.height_px = size.height;
  return lens;
}

bool HasSameAspect(const CameraCalibration& calibration, cv::Size size) {
  const double ratio = static_cast<double>(size.width) * calibration.height_px /
                       (static_cast<double>(size.height) * calibration.width_px);
  return std::abs(ratio - 1.0) <= kAspectTolerance;
}

CalibrationAnswer AtSize(const LensFile& lens, cv::Size size) {
  CameraCalibration calibration = lens.calibration;
  if (calibration.width_px == 0 || calibration.height_px == 0) {
    calibration.width_px = size.width;
    calibration.height_px = size.height;
    return {calibration,
            "the calibration file states no image size: taken as that of the pictures"};
  }
  const std::string stated = text::SizeText(calibration.width_px, calibration.height_px);
  if (size == cv::Size(calibration.width_px, calibration.height_px)) return {calibration, ""};
  if (!HasSameAspect(calibration, size)) {
    throw config::ConfigError(lens.path + ": is for pictures of " + stated + " but they have " +
                              text::SizeText(size.width, size.height) +
                              ", another aspect; calibrate at this size or change the camera's");
  }
  const CameraCalibration scaled = geometry::Scaled(calibration, size.width, size.height);
  if (!geometry::IsLens(scaled)) {
    throw config::ConfigError(lens.path + ": scaled from " + stated + " to " +
                              text::SizeText(size.width, size.height) +
                              " it is no lens that a camera has; calibrate again");
  }
  return {scaled, "calibration scaled from " + stated};
}

Calibration::Calibration(const CalibrationConfig& config) : config_(config) {
  if (!config.file.empty()) lens_ = ReadNamed(config);
}

Calibration::Calibration(const CalibrationConfig& config, LensFile lens)
    : config_(config), lens_(std::move(lens)) {}

bool Calibration::UseOwn(const CameraCalibration& lens) {
  if (lens_ || (own_ && IsSameLens(*own_, lens))) return false;
  own_ = lens;
  return true;
}

CalibrationAnswer Calibration::For(cv::Size size) const {
  if (lens_) return AtSize(*lens_, size);
  if (own_ && CanBeScaled(*own_, size)) return AtSize({"the camera's own lens", *own_}, size);
  CalibrationAnswer answer = Guess(size, config_);
  if (own_) {
    answer.remark += "; the camera's own lens is for " +
                     text::SizeText(own_->width_px, own_->height_px) + ", another aspect";
  }
  return answer;
}

}  // namespace deixis::capture
