#pragma once
#include <opencv2/core/matx.hpp>
#include <optional>
#include <string>
#include <vector>

#include "services/calibrator/core/lens_fit.h"

namespace deixis::calibrator {

/// The board as both cameras see it at one moment: the same corners in the same order.
using CornerPair = SharedCorners;

/// Pairs of one shot's corners that both cameras see. The right camera's chessboard is counted from
/// the end that makes both run the same way (cameras that stand upright to each other).
CornerPair PairOf(const Corners& left, const Corners& right, const BoardLayout& layout);

/// How the two pictures are turned into ones whose rows correspond (OpenCV's R1 R2 P1 P2 Q).
struct Rectification {
  cv::Matx33d left_rotation;
  cv::Matx33d right_rotation;
  cv::Matx34d left_projection;
  cv::Matx34d right_projection;
  cv::Matx44d disparity_to_depth;
};

struct StereoFit {
  Lens left;
  Lens right;
  cv::Matx33d rotation;     ///< right_from_left.
  cv::Vec3d translation_m;  ///< right_from_left; x < 0 when the right camera is on the right.
  double error_px = 0.0;    ///< Root mean square reprojection error over both cameras.
  Rectification rectification;
};

/// What the two lenses may do while the cameras' places are fitted.
enum class Refinement {
  kPlacesOnly,  ///< Stay as given.
  kJoint        ///< Be fitted again, together.
};

/// `left`, `right`: pinhole lenses of the model in `options`. Throws FitFailed.
StereoFit FitStereo(const std::vector<CornerPair>& pairs, const BoardLayout& layout,
                    const Lens& left, const Lens& right, const LensOptions& options,
                    Refinement refinement);

/// Rectification for `fit`; `alpha` 0 = only pixels that both pictures have, 1 = all of them.
Rectification Rectify(const StereoFit& fit, double alpha);

/// Row in the left minus row in the right rectified picture, per corner; in pixels of the left
/// camera, however much the rectified pictures are enlarged.
std::vector<double> RowDifferences_px(const StereoFit& fit, const CornerPair& pair);

/// Distances between neighbouring corners, as the two cameras measure them, over the true one.
std::vector<double> RelativeSquares(const StereoFit& fit, const CornerPair& pair,
                                    const BoardLayout& layout);

/// Of absolute values.
struct ErrorSummary {
  double mean = 0.0;
  double median = 0.0;
  double p95 = 0.0;
};
ErrorSummary Summarise(std::vector<double> errors);

}  // namespace deixis::calibrator
