#pragma once
#include <opencv2/core/types.hpp>
#include <optional>
#include <string>

#include "common/capture/mount.h"
#include "common/config/config.h"
#include "common/geometry/camera_calibration.h"

namespace deixis::capture {

struct CalibrationConfig {
  /// OpenCV YAML with the lens: camera_matrix, distortion_coefficients as OpenCV's calibration
  /// sample writes them, or M1, D1 as stereo_calib does. A path, or a name under config/. Empty =
  /// guess.
  std::string file;
  double horizontal_fov_deg = 60.0;  ///< Guess without a file: horizontal field of view.
  MountConfig mount;                 ///< Where the camera is; see MountOf.
  /// Where this stands in the configuration, for messages; not a setting.
  std::string key = "calibration";

  template <typename Visitor>
  void Visit(Visitor& v) {
    v("file", file);
    v("horizontal_fov_deg", horizontal_fov_deg);
    v("mount", mount);
  }
  void Check(config::Faults& faults) const;
};

/// A lens as a calibration file describes it.
struct LensFile {
  std::string path;
  geometry::CameraCalibration calibration;  ///< width_px, height_px 0 when the file does not say.
};

/// Throws ConfigError naming file, key and cure; `cure` is for a file that is not there.
LensFile ReadLensFile(const std::string& path, const std::string& cure = "name one that does");

/// What is known of the lens at one image size.
struct CalibrationAnswer {
  geometry::CameraCalibration calibration;
  std::string remark;  ///< "guessed from ...", "scaled from 640x480"; empty = as in the file.
};

/// Whether pictures of `size` can be those of the lens, made larger or smaller.
bool HasSameAspect(const geometry::CameraCalibration& calibration, cv::Size size);

/// The lens of pictures of `size`: as in the file, or scaled when they have another size of the
/// same aspect. Throws ConfigError when the aspect is another one.
CalibrationAnswer AtSize(const LensFile& lens, cv::Size size);

/// Knows the camera's lens for any image size: from a file, as the camera itself says it, or
/// guessed, in this order.
class Calibration {
 public:
  /// Reads the file, if one is named. Throws ConfigError.
  explicit Calibration(const CalibrationConfig& config);

  /// `lens` was read from a file already; goes before what `config` names.
  Calibration(const CalibrationConfig& config, LensFile lens);

  /// Takes the lens as the camera says it of itself. Returns whether answers differ from now on:
  /// not when a file is named, or nothing but its time, name and mount is new.
  bool UseOwn(const geometry::CameraCalibration& lens);

  /// Whether a file or the camera has said the lens: it need not be guessed.
  bool IsKnown() const { return lens_ || own_; }

  /// The lens of pictures of `size`: as in the file or as the camera says it, scaled when they have
  /// another size of the same aspect, or guessed. Throws ConfigError when the file's aspect is
  /// another one; a camera's own lens of another aspect is left out, with a remark.
  CalibrationAnswer For(cv::Size size) const;

 private:
  CalibrationConfig config_;
  std::optional<LensFile> lens_;
  std::optional<geometry::CameraCalibration> own_;  ///< As the camera says it of itself.
};

}  // namespace deixis::capture
