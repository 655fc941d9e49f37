#pragma once
#include <opencv2/core/mat.hpp>
#include <vector>

#include "services/calibrator/core/coverage.h"
#include "services/calibrator/core/lens_fit.h"
#include "services/calibrator/core/stereo_fit.h"

namespace deixis::calibrator {

/// All results are CV_8UC3.

/// `bgr` with the corners that were found, one colour per row of the board.
cv::Mat DrawCorners(const cv::Mat& bgr, const Corners& corners, const BoardLayout& layout);

/// The picture's cells, the more often seen the greener, and every corner of `views`.
cv::Mat DrawCoverage(const Coverage& coverage, const std::vector<Corners>& views, cv::Size size);

/// How much longer than they are the arrows of DrawResiduals are drawn.
inline constexpr double kResidualScale = 50.0;
/// An arrow from every corner towards where the calibration would have it.
cv::Mat DrawResiduals(const LensFit& fit, const std::vector<Corners>& views,
                      const BoardLayout& layout);

/// Both pictures, rectified, side by side, with lines along the rows.
cv::Mat DrawRectified(const StereoFit& fit, const cv::Mat& left_bgr, const cv::Mat& right_bgr);

}  // namespace deixis::calibrator
