#pragma once
#include <cstddef>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "services/calibrator/core/lens.h"

namespace deixis::calibrator {

/// The views determine no lens. The text says the cure.
class FitFailed : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

struct LensOptions {
  LensModel model = LensModel::kPlumbBob;
  bool has_fixed_aspect = false;  ///< fx = fy. Not for the fisheye model.
  bool has_zero_tangent = false;  ///< p1 = p2 = 0. The fisheye model has none anyway.
};

struct LensFit {
  Lens lens;
  std::vector<double> deviations;      ///< Standard deviations of fx fy cx cy and the distortion;
                                       ///< empty = not known.
  std::vector<BoardPose> poses;        ///< One per view.
  std::vector<double> view_errors_px;  ///< Root mean square per view.
  double error_px = 0.0;               ///< Of all corners.
};

/// Zhang 2000, as OpenCV has it. `views`: three at least; throws FitFailed. Deviations are those of
/// cv::calibrateCamera; of a fisheye, the jackknife's over five groups of views (Efron 1982), not
/// known of fewer than six views or when the others determine no lens without some group.
LensFit FitLens(const std::vector<Corners>& views, const BoardLayout& layout, cv::Size size,
                const LensOptions& options);

/// A view that does not go with the others.
struct DroppedView {
  std::size_t index = 0;
  double error_px = 0.0;   ///< Its error with the lens that was fitted without it.
  double others_px = 0.0;  ///< The median of the others then.
};

struct RobustLensFit {
  LensFit fit;
  std::vector<std::size_t> used;  ///< Indices of the views in the fit.
  std::vector<DroppedView> dropped;
};

/// Fits, and leaves out views whose leave-one-out error is far above the others', the worst one
/// first; a third of all at most, and none without which the others determine no lens. Throws
/// FitFailed.
RobustLensFit FitLensRobustly(const std::vector<Corners>& views, const BoardLayout& layout,
                              cv::Size size, const LensOptions& options);

/// The error of FitLens, without the time for deviations; nothing when it fails.
std::optional<double> FittedError_px(const std::vector<Corners>& views, const BoardLayout& layout,
                                     cv::Size size, const LensOptions& options);

/// Root mean square error of views that had no part in the fit: five groups, each one measured with
/// the lens of the four others. Nothing when there are fewer than six views or a fit fails.
std::optional<double> CrossValidatedError_px(const std::vector<Corners>& views,
                                             const BoardLayout& layout, cv::Size size,
                                             const LensOptions& options);

/// The views of `all` at `indices`.
std::vector<Corners> At(const std::vector<Corners>& all, const std::vector<std::size_t>& indices);

}  // namespace deixis::calibrator
