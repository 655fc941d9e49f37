#pragma once
#include <opencv2/core/types.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "common/capture/calibration.h"
#include "common/config/config.h"
#include "services/stereo_driver/core/depth_camera/depth_registration.h"

namespace deixis::stereo_driver {

/// Who brings depth into the colour picture's view.
enum class RegistrationMode {
  kSensor,     ///< The sensor has done so, or both have one lens: depth is taken as it comes.
  kExtrinsics  ///< We do, by both lenses and how the cameras stand to each other.
};
inline auto EnumNames(RegistrationMode) {
  return std::vector<std::pair<std::string, RegistrationMode>>{
      {"sensor", RegistrationMode::kSensor}, {"extrinsics", RegistrationMode::kExtrinsics}};
}

/// Which camera the calibration's first one (M1 D1, the left one) is.
enum class FirstCamera { kColour, kDepth };
inline auto EnumNames(FirstCamera) {
  return std::vector<std::pair<std::string, FirstCamera>>{{"colour", FirstCamera::kColour},
                                                          {"depth", FirstCamera::kDepth}};
}

struct RegistrationConfig {
  RegistrationMode mode = RegistrationMode::kSensor;  ///< All other keys are for `extrinsics`.
  /// Both lenses: M1 D1 M2 D2 as `scripts/deixis calibrate stereo` or OpenCV's stereo_calib writes
  /// them from colour and infra-red pictures. A path, or a name under config/.
  std::string intrinsics;
  /// Instead of `intrinsics`, when the two cameras' pictures differ in size: the depth camera's
  /// lens alone, as `scripts/deixis calibrate camera` writes it. The colour lens is then
  /// depth_camera.calibration.
  std::string depth_lens;
  std::string extrinsics;                    ///< R T of the same calibration: second_from_first.
  double unit_m = 1.0;                       ///< Metres per unit of T.
  FirstCamera first = FirstCamera::kColour;  ///< Of M1 D1, and of whom R T start.

  template <typename Visitor>
  void Visit(Visitor& v) {
    v("mode", mode);
    v("intrinsics", intrinsics);
    v("depth_lens", depth_lens);
    v("extrinsics", extrinsics);
    v("unit_m", unit_m);
    v("first", first);
  }
  void Validate() const;  ///< Throws FaultsFound.
};

/// From where depth pictures of one size are seen.
struct DepthViewAnswer {
  DepthView view;
  std::string remark;  ///< As of capture::CalibrationAnswer.
};

/// Knows the depth camera's lens and its place beside the colour camera.
class RegistrationCalibration {
 public:
  /// Reads the files of mode `extrinsics`. Throws ConfigError naming file, key and cure.
  explicit RegistrationCalibration(const RegistrationConfig& config);

  /// The colour camera's lens, when the files have it.
  const std::optional<capture::LensFile>& colour_lens() const { return colour_lens_; }

  /// Throws ConfigError when the calibration is for another aspect.
  DepthViewAnswer For(cv::Size depth_size) const;

 private:
  void ReadBothLenses(const RegistrationConfig& config);

  std::optional<capture::LensFile> colour_lens_;
  capture::LensFile depth_lens_;
  geometry::RigidTransform colour_from_depth_;
};

/// What is wrong when the sensor says `is_registered` of its depth and `mode` says otherwise, with
/// the cure; empty when they agree.
std::string RegistrationFault(RegistrationMode mode, bool is_registered);

}  // namespace deixis::stereo_driver
