#pragma once
#include <opencv2/core/types.hpp>
#include <string>
#include <utility>
#include <vector>

#include "common/capture/calibration.h"
#include "common/capture/mount.h"
#include "common/config/config.h"
#include "common/geometry/stereo_calibration.h"

namespace deixis::stereo_driver {

/// Where the rectification comes from.
enum class Rectification {
  kComputed,  ///< From M, D, R, T with the `alpha` here: OpenCV's sample writes its R1 R2 P1 P2
              ///< with alpha 1, which leaves black borders and wastes resolution.
  kFromFile   ///< R1 R2 P1 P2 as they stand in the file.
};
inline auto EnumNames(Rectification) {
  return std::vector<std::pair<std::string, Rectification>>{
      {"computed", Rectification::kComputed}, {"from_file", Rectification::kFromFile}};
}

struct RigCalibrationConfig {
  /// OpenCV's intrinsics.yml: M1 D1 M2 D2, as its sample stereo_calib writes it. A path, or a name
  /// under config/.
  std::string intrinsics = "cameras/intrinsics.yml";
  std::string extrinsics = "cameras/extrinsics.yml";  ///< R T, and R1 R2 P1 P2 for `from_file`.
  /// Metres per unit of T: 1 when it is in metres; the side of a board square, for example 0.025,
  /// when the calibration counted in squares.
  double unit_m = 1.0;
  int width_px = 0;   ///< Pictures of the calibration, unless a file has image_width; 0 = as those
                      ///< that come.
  int height_px = 0;  ///< Goes with width_px.
  Rectification rectification = Rectification::kComputed;
  double alpha = 0.0;  ///< `computed`: 0 = only pixels that both cameras' pictures have, 1 = all.
  double disparity_sigma_px = 0.2;  ///< Error of a disparity at full width, as it is published.
  capture::MountConfig mount;       ///< Where the raw left camera is; see capture::MountOf.

  template <typename Visitor>
  void Visit(Visitor& v) {
    v("intrinsics", intrinsics);
    v("extrinsics", extrinsics);
    v("unit_m", unit_m);
    v("width_px", width_px);
    v("height_px", height_px);
    v("rectification", rectification);
    v("alpha", alpha);
    v("disparity_sigma_px", disparity_sigma_px);
    v("mount", mount);
  }
  void Validate() const;  ///< Throws FaultsFound.
};

/// What is known of the two cameras at one image size.
struct RigCalibrationAnswer {
  geometry::StereoCalibration calibration;  ///< Without times and names of cameras.
  std::string remark;                       ///< "calibration scaled from ..."; empty = as filed.
};

/// The rectification that a file has.
struct FiledRectification {
  Eigen::Matrix3d rectified_from_left = Eigen::Matrix3d::Identity();   ///< R1
  Eigen::Matrix3d rectified_from_right = Eigen::Matrix3d::Identity();  ///< R2
  capture::LensFile projection;  ///< P1 as a lens without distortion.
};

/// Knows both lenses and how the cameras stand to each other, for any image size.
class RigCalibration {
 public:
  /// Reads both files. Throws ConfigError naming file, key and cure, also when the cameras cannot
  /// be rectified left to right (swapped, one above the other, no plausible baseline).
  explicit RigCalibration(RigCalibrationConfig config);

  /// The calibration of pictures of `size`, scaled when the files are for another size of the same
  /// aspect. Throws ConfigError when the aspect is another one or both cameras share no view.
  RigCalibrationAnswer For(cv::Size size) const;

 private:
  RigCalibrationConfig config_;
  capture::LensFile left_;
  capture::LensFile right_;
  geometry::RigidTransform right_from_left_;
  FiledRectification filed_;  ///< Only with `from_file`.
};

}  // namespace deixis::stereo_driver
