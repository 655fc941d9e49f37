#pragma once
#include <optional>
#include <string>
#include <vector>

#include "services/calibrator/core/stereo_fit.h"
#include "services/calibrator/core/view.h"

namespace deixis::calibrator {

enum class ModelChoice {
  kAsGiven,
  kByCrossValidation  ///< The simplest one whose error on views left out is within 2 % of the best;
                      ///< of a stereo pair by its left camera, and no fisheye.
};

/// Which of some models, the simplest first, is the first whose error is within 2 % of the least;
/// nothing = it could not be fitted. 0 when none could.
std::size_t FirstGoodEnough(const std::vector<std::optional<double>>& errors_px);

struct CalibrationOptions {
  LensOptions lens;
  ModelChoice choice = ModelChoice::kAsGiven;
  Refinement refinement = Refinement::kJoint;
  double alpha = 0.0;  ///< Of the rectification: 0 = only pixels that both have, 1 = all of them.
};

/// One camera's calibration, and how it came about.
struct CameraCalibration {
  LensOptions options;  ///< As used.
  RobustLensFit robust;
  std::optional<double> cross_validated_px;  ///< Error on views that had no part in the fit.
};

/// What `camera` (0 = the only one, or the left one) saw in all `shots`.
std::vector<Corners> CornersOf(const std::vector<Shot>& shots, std::size_t camera);

/// `shots` by their `camera`. Throws FitFailed.
CameraCalibration CalibrateCamera(const std::vector<Shot>& shots, std::size_t camera,
                                  const BoardLayout& layout, const CalibrationOptions& options);

struct PairError {
  std::size_t shot = 0;
  double rows_px = 0.0;  ///< Median absolute row difference.
};

struct StereoCalibration {
  CameraCalibration left;
  CameraCalibration right;
  StereoFit fit;
  std::vector<std::size_t> used;     ///< Shots of the fit.
  std::vector<DroppedView> dropped;  ///< Shots that do not go with the others; row differences.
  std::vector<PairError> pairs;      ///< Of the shots in the fit.
  ErrorSummary rows_px;              ///< Row differences of the shots in the fit.
  std::optional<ErrorSummary> held_out_rows_px;  ///< Of shots that had no part in it, five groups.
  ErrorSummary square_errors;                    ///< Of distances between neighbours, relative.
  double median_square = 1.0;                    ///< Measured over true; 1 = the scale is right.
};

/// For pinhole lenses: rectifying makes pinhole pictures, and the stereo driver reads no other
/// ones. Throws FitFailed; std::invalid_argument when `options` ask for a fisheye.
StereoCalibration CalibrateStereo(const std::vector<Shot>& shots, const BoardLayout& layout,
                                  const CalibrationOptions& options);

}  // namespace deixis::calibrator
