#pragma once
#include <opencv2/core.hpp>
#include <vector>

#include "services/calibrator/core/lens.h"

namespace deixis::calibrator::test {

/// A 640x480 wide-angle lens with visible barrel distortion.
Lens WideLens();

/// Poses that turn the board every way and carry it all over the picture of WideLens();
/// `distance_m` suits a board of `size`.
std::vector<BoardPose> Poses(cv::Size2d size, double distance_m, int count);

/// The pose in a camera that stands `baseline_m` to the right of the first, turned by `turn`
/// (Rodrigues' vector, right_from_left).
BoardPose SeenFromRight(const BoardPose& pose, double baseline_m, const cv::Vec3d& turn);

/// Takes pictures of a printed board through a lens: four rays per pixel, a little blur, noise of
/// two grey levels with a fixed seed.
class BoardCamera {
 public:
  BoardCamera(const Lens& lens, const BoardLayout& layout);

  /// CV_8UC3. The board's picture stands on grey.
  cv::Mat Take(const BoardPose& pose) const;

 private:
  cv::Mat TakeOnce(const BoardPose& pose, const cv::Mat& rays) const;

  Lens lens_;
  BoardLayout layout_;
  cv::Mat paper_;              ///< The print with a margin of one square.
  std::vector<cv::Mat> rays_;  ///< Directions per pixel, one picture per place within the pixel.
};

/// The corners of the whole board as `lens` shows them, with noise of `sigma_px`.
Corners ProjectedCorners(const Lens& lens, const BoardLayout& layout, const BoardPose& pose,
                         double sigma_px, cv::RNG& random);

}  // namespace deixis::calibrator::test
