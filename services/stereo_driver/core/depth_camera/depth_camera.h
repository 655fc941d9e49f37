#pragma once
#include <opencv2/core/mat.hpp>
#include <optional>

#include "common/geometry/stereo_calibration.h"
#include "common/images/rgbd_image.h"
#include "services/stereo_driver/core/depth_camera/depth_registration.h"
#include "services/stereo_driver/core/matching/stereo_matcher.h"

namespace deixis::stereo_driver {

/// From colour and depth as a depth camera gave them to rectified picture and depth.
class DepthCamera {
 public:
  /// For colour pictures of the calibration's size, whose `left` has the lens and whose `rectified`
  /// has none. Depth is seen from `depth_view`, whose lens has the depth's size; without one it is
  /// taken to cover the colour picture's view, whatever its size. Throws std::logic_error on a
  /// calibration that is none.
  DepthCamera(const geometry::StereoCalibration& calibration, Size depth_size,
              const std::optional<DepthView>& depth_view = std::nullopt);

  /// Takes out the lens distortion of both, brings depth of another view into the picture's, and
  /// makes the depth half as large when it was asked for and comes as large as the picture, of two
  /// rows and columns at least. The result shares memory with this object, or with `image` when
  /// nothing had to be done, and holds until the next call.
  const RectifiedDepth& Rectify(const images::RgbdImage& image);

 private:
  const cv::Mat& InPicturesView(const cv::Mat& depth_mm);
  void PrepareDepthMaps(cv::Size size);

  geometry::StereoCalibration calibration_;
  Size depth_size_;
  bool has_distortion_;
  cv::Mat colour_map_x_, colour_map_y_;
  cv::Mat depth_map_x_, depth_map_y_;
  cv::Size depth_map_size_;
  std::optional<DepthRegistration> registration_;
  cv::Mat rectified_bgr_, rectified_mm_, halved_mm_;
  RectifiedDepth result_;
};

/// Half as wide and high, of the same view (see Halving). Each pixel is the mean of those of its
/// 2x2 distances that agree with the nearest of the valid ones, so that no distance is made up
/// between a body and what lies behind it.
void HalveDepth(const cv::Mat& depth_mm, cv::Mat& halved_mm);

}  // namespace deixis::stereo_driver
