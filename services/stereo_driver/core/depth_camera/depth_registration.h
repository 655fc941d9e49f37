#pragma once
#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <vector>

#include "common/geometry/camera_calibration.h"
#include "common/geometry/rigid_transform.h"
#include "services/stereo_driver/core/depth_camera/depth_registration_kernels.h"

namespace deixis::stereo_driver {

/// From where a depth camera sees.
struct DepthView {
  geometry::CameraCalibration lens;  ///< Of the depth pictures, with their size.
  geometry::RigidTransform colour_from_depth;
};

/// Rays through a grid of points of the depth picture, turned into the target's pixels: a point at
/// distance z along its ray lies at (u, v, 1) ~ z * ray + offset.
struct RayGrid {
  int columns = 0;
  std::vector<float> u, v, z;

  Rays Row(int row) const;
};

/// Brings depth from the depth camera's view into another one. Depth is a surface, wherever
/// neighbours agree, so that no holes come when the target has more pixels; where they do not,
/// each pixel is a patch of its own, and what opens between two is not measured. The nearest wins.
///
/// Memory and rays are made once: nothing is allocated per picture.
class DepthRegistration {
 public:
  /// `target` is a pinhole in the colour camera's frame. Throws std::logic_error when one of the
  /// cameras has no size.
  DepthRegistration(const DepthView& view, const geometry::CameraCalibration& target);

  /// From CV_16UC1 of the depth lens' size to CV_16UC1 of the target's size, millimetres along
  /// their optical axes, 0 = not measured. `registered_mm` is used again. Throws std::logic_error
  /// on depth of another size or type.
  void Register(const cv::Mat& depth_mm, cv::Mat& registered_mm);

 private:
  /// One row of depth pixels in the target.
  struct Row {
    explicit Row(int width);
    Projected projected();
    std::vector<float> u_px, v_px, z_mm;
  };

  void Project(const cv::Mat& depth_mm, int y, Row& row) const;
  void FindSurfaceBelow();
  void FillSurface(cv::Mat& registered_mm) const;
  void FillPatches(const std::uint16_t* depth_mm, int y, cv::Mat& registered_mm) const;
  bool IsInsideSurface(int x) const;

  cv::Size depth_size_, target_size_;
  Offset offset_;
  RayGrid centres_;  ///< Of the depth pixels.
  RayGrid corners_;  ///< One more in each direction: pixel (x, y) lies between corners (x, y) and
                     ///< (x + 1, y + 1).
  Row upper_, lower_;
  /// Whether the surface goes on between columns x - 1 and x, above and below the row that is
  /// being filled. At 0 and at the width it does not.
  std::vector<std::int32_t> goes_on_above_, goes_on_below_;
  /// What each quad of the surface below the row covers.
  std::vector<std::int32_t> first_u_, last_u_, first_v_, last_v_;
};

}  // namespace deixis::stereo_driver
