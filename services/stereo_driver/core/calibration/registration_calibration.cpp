#include "services/stereo_driver/core/calibration/registration_calibration.h"

#include <utility>

#include "common/text/size_text.h"
#include "services/stereo_driver/core/calibration/rig_files.h"

namespace deixis::stereo_driver {
namespace {

using capture::OpenCvFile;

// Colour and depth camera sit in one housing, or on one bracket.
const BaselineLimits kBaselineLimits = {0, 300, "depth_camera.registration.unit_m"};

std::string Cure(const std::string& key) { return "set depth_camera.registration." + key; }

std::string Find(const std::string& name, const std::string& key) {
  return config::FindConfig(name, Cure(key)).string();
}

OpenCvFile Open(const std::string& name, const std::string& key) {
  return {Find(name, key), Cure(key)};
}

void RequireSameAspect(const capture::LensFile& lens, cv::Size size) {
  const geometry::CameraCalibration& filed = lens.calibration;
  if (filed.width_px == 0 || capture::HasSameAspect(filed, size)) return;
  throw config::ConfigError(
      lens.path + ": is for pictures of " + text::SizeText(filed.width_px, filed.height_px) +
      " but the depth camera's have " + text::SizeText(size.width, size.height) +
      ", another aspect; calibrate the depth camera at this size and name its lens by "
      "depth_camera.registration.depth_lens");
}

}  // namespace

void RegistrationConfig::Validate() const {
  config::Faults faults;
  faults.Require(unit_m > 0.0, "unit_m", "must be positive");
  if (mode == RegistrationMode::kExtrinsics) {
    faults.Require(!extrinsics.empty(), "extrinsics",
                   "must name the file with R T that `scripts/deixis calibrate stereo` writes");
    faults.Require(
        intrinsics.empty() != depth_lens.empty(), "intrinsics",
        "must name the file with M1 D1 M2 D2 beside it, unless depth_lens names one with "
        "the depth camera's lens alone: one of the two");
  }
  faults.ThrowIfAny();
}

RegistrationCalibration::RegistrationCalibration(const RegistrationConfig& config) {
  if (config.depth_lens.empty()) {
    ReadBothLenses(config);
  } else {
    depth_lens_ = capture::ReadLensFile(Find(config.depth_lens, "depth_lens"), Cure("depth_lens"));
  }
  const geometry::RigidTransform second_from_first =
      ReadSecondFromFirst(Open(config.extrinsics, "extrinsics"), config.unit_m, kBaselineLimits);
  colour_from_depth_ = config.first == FirstCamera::kDepth ? second_from_first
                                                           : geometry::Inverse(second_from_first);
}

void RegistrationCalibration::ReadBothLenses(const RegistrationConfig& config) {
  const OpenCvFile intrinsics = Open(config.intrinsics, "intrinsics");
  colour_lens_ = ReadLensOf(intrinsics, "1");
  depth_lens_ = ReadLensOf(intrinsics, "2");
  if (config.first == FirstCamera::kDepth) std::swap(*colour_lens_, depth_lens_);
  const cv::Size size =
      (intrinsics.HasImageSize() ? intrinsics : Open(config.extrinsics, "extrinsics")).ImageSize();
  SetSize(colour_lens_->calibration, size);
  SetSize(depth_lens_.calibration, size);
}

DepthViewAnswer RegistrationCalibration::For(cv::Size depth_size) const {
  RequireSameAspect(depth_lens_, depth_size);
  capture::CalibrationAnswer lens = capture::AtSize(depth_lens_, depth_size);
  if (!lens.remark.empty()) lens.remark = "depth lens: " + lens.remark;
  return {{std::move(lens.calibration), colour_from_depth_}, std::move(lens.remark)};
}

std::string RegistrationFault(RegistrationMode mode, bool is_registered) {
  if (mode == RegistrationMode::kSensor && !is_registered) {
    return "the sensor says that its depth is not registered to the colour picture: it is off by "
           "the way between the two lenses; let the sensor's driver register it, or set "
           "depth_camera.registration.mode to extrinsics";
  }
  if (mode == RegistrationMode::kExtrinsics && is_registered) {
    return "the sensor says that its depth is registered already, and it is registered once more; "
           "set depth_camera.registration.mode to sensor, or let the sensor's driver send depth as "
           "it is";
  }
  return "";
}

}  // namespace deixis::stereo_driver
