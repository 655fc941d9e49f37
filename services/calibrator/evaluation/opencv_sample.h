#pragma once
#include <optional>

#include "services/calibrator/core/stereo_fit.h"

namespace deixis::calibrator {

/// What OpenCV's sample stereo_calib does with the same calls, flags and limits; the yardstick.

/// Corners by findChessboardCorners (twice as large at the second try) and cornerSubPix in a window
/// of 23 px.
std::optional<Corners> SampleCorners(const cv::Mat& grey, cv::Size count);

/// initCameraMatrix2D and one stereoCalibrate for all. Throws FitFailed.
StereoFit SampleFit(const std::vector<CornerPair>& pairs, const BoardLayout& layout, cv::Size size);

/// Its measure of quality: distance of points from their epipolar lines, both pictures together,
/// mean over corners, pixels.
double SampleEpipolarError_px(const StereoFit& fit, const std::vector<CornerPair>& pairs);

}  // namespace deixis::calibrator
