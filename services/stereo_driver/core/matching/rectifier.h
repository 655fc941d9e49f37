#pragma once
#include <opencv2/core/mat.hpp>

#include "common/geometry/stereo_calibration.h"
#include "common/images/stereo_pair.h"

namespace deixis::stereo_driver {

/// A pair whose rows agree: what is seen in row v of the left picture lies in row v of the right.
struct RectifiedPair {
  cv::Mat left_bgr;    ///< CV_8UC3, as published.
  cv::Mat left_grey;   ///< CV_8UC1, of the same size.
  cv::Mat right_grey;  ///< CV_8UC1, of the same size.
};

/// Takes out lens distortion and the rotation between the cameras, by fixed-point maps made once.
class Rectifier {
 public:
  /// Both cameras must have one size. Throws std::logic_error.
  explicit Rectifier(const geometry::StereoCalibration& calibration);

  /// The size that pictures must have.
  cv::Size size() const { return size_; }

  /// Writes into `rectified`, whose memory is used again. Throws std::logic_error on pictures of
  /// another size or type.
  void Rectify(const images::StereoPair& pair, RectifiedPair& rectified);

 private:
  struct Maps {
    cv::Mat whole;     ///< CV_16SC2
    cv::Mat fraction;  ///< CV_16UC1
  };
  static Maps MakeMaps(const geometry::CameraCalibration& camera,
                       const geometry::CameraCalibration& rectified);

  cv::Size size_;
  Maps left_;
  Maps right_;
  cv::Mat right_bgr_;
};

}  // namespace deixis::stereo_driver
