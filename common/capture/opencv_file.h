#pragma once
#include <opencv2/core.hpp>
#include <string>

#include "common/geometry/camera_calibration.h"

namespace deixis::capture {

/// A YAML file as OpenCV's calibration samples write it; it is looked at by opencv_text.h before
/// OpenCV reads it, which hostile files crash. All methods throw ConfigError naming file,
/// key and cure.
class OpenCvFile {
 public:
  /// Opens `path`; `cure` says what to do when there is no such file ("set calibration.file").
  OpenCvFile(const std::string& path, const std::string& cure);

  const std::string& path() const { return path_; }
  bool Has(const std::string& key) const { return !storage_[key].empty(); }

  /// The matrix under `key`, or under `other_key` when there is none and that is not empty; one
  /// channel, CV_64F, all values finite.
  cv::Mat Matrix(const std::string& key, const std::string& other_key = "") const;

  /// image_width and image_height, of a picture that can go through the system; 0x0 when neither is
  /// there.
  cv::Size ImageSize() const;
  bool HasImageSize() const { return Has("image_width") || Has("image_height"); }

  /// Whether the lens was calibrated with OpenCV's fisheye model.
  bool IsFisheye() const { return static_cast<int>(storage_["fisheye_model"]) == 1; }

  [[noreturn]] void Fail(const std::string& fault) const;

 private:
  int PixelCount(const std::string& key) const;

  std::string path_;
  std::string text_;
  cv::FileStorage storage_;
};

/// Under which keys a lens stands: each with the other one that is looked for.
struct LensKeys {
  std::string matrix = "camera_matrix";
  std::string other_matrix = "M1";
  std::string distortion = "distortion_coefficients";
  std::string other_distortion = "D1";
};

/// Fails unless a camera can have what `lens` has, by geometry/lens_limits.h; `name` is the key
/// that it was read from.
void RequirePinhole(const OpenCvFile& file, const std::string& name,
                    const geometry::CameraCalibration& lens);

/// A lens without its image size (0). Its distortion has 4, 5 or 8 values, or 12 or 14 of which
/// those of thin prism and tilt are zero; 4 of a fisheye. Throws ConfigError.
geometry::CameraCalibration ReadLens(const OpenCvFile& file, const LensKeys& keys);

}  // namespace deixis::capture
