#include "services/calibrator/core/verdict.h"

#include <cmath>

#include "services/calibrator/core/figures.h"

namespace deixis::calibrator {
namespace {

constexpr double kFarthestCentre = 0.25;  // Of the principal point from the middle, over the size.
constexpr double kLargestAspect = 1.1;
constexpr double kNarrowest_deg = 5.0;
constexpr double kWidest_deg = 170.0;
constexpr double kSquareError = 0.05;
constexpr double kLeastBaseline_m = 0.001;

using Faults = std::vector<std::string>;

void Require(bool holds, const std::string& fault, Faults& faults) {
  if (!holds) faults.push_back(fault);
}

std::string FirstAdvice(const Coverage& coverage) {
  for (const std::string& advice : coverage.Advice()) {
    if (advice.rfind("show", 0) == 0) return advice;
  }
  return "show the board all over the picture";
}

Faults LensFaults(const Lens& lens) {
  Faults faults;
  const double x = (lens.matrix(0, 2) + 0.5) / lens.size.width - 0.5;
  const double y = (lens.matrix(1, 2) + 0.5) / lens.size.height - 0.5;
  Require(std::abs(x) < kFarthestCentre && std::abs(y) < kFarthestCentre,
          Figures("the principal point (%.0f, %.0f) is far from the middle of the picture: "
                  "tilt the board more, both ways",
                  lens.matrix(0, 2), lens.matrix(1, 2)),
          faults);
  const double aspect = lens.matrix(0, 0) / lens.matrix(1, 1);
  Require(aspect < kLargestAspect && aspect > 1.0 / kLargestAspect,
          Figures("fx / fy is %.3f: tilt the board more, or give --fix-aspect", aspect), faults);
  const double fov_deg = HorizontalFov_deg(lens);
  Require(fov_deg > kNarrowest_deg && fov_deg < kWidest_deg,
          Figures("a field of view of %.1f deg is no camera's: check --board and --square, "
                  "or tilt the board more",
                  fov_deg),
          faults);
  Require(IsMonotonic(lens),
          "the distortion folds the picture's corners over: show the board there, or take "
          "a simpler --model",
          faults);
  return faults;
}

Faults ViewFaults(int views, const Coverage& coverage, const Demands& demands) {
  Faults faults;
  Require(views >= demands.views,
          Figures("%d views are too few, %d are the least: show the board more often", views,
                  demands.views),
          faults);
  Require(coverage.share() >= demands.coverage,
          Figures("only %.0f %% of the picture were covered, %.0f %% are the least: ",
                  100.0 * coverage.share(), 100.0 * demands.coverage) +
              FirstAdvice(coverage),
          faults);
  Require(coverage.largest_tilt_deg() >= demands.tilt_deg,
          Figures("the board was tilted by %.0f deg at most, %.0f are the least: tilt the "
                  "board by 20 to 40 degrees, both ways",
                  coverage.largest_tilt_deg(), demands.tilt_deg),
          faults);
  return faults;
}

Faults CertaintyFaults(const LensFit& fit, const Demands& demands) {
  if (fit.deviations.empty()) {
    return {
        "how certain the focal length is cannot be told, since some views alone determine the "
        "lens: show the board more often, all over the picture and tilted"};
  }
  const double share = fit.deviations[0] / fit.lens.matrix(0, 0);
  if (share <= demands.focal_deviation) return {};
  return {
      Figures("the focal length is uncertain by %.1f %%, at most %.1f: tilt the board "
              "by 20 to 40 degrees, both ways",
              100.0 * share, 100.0 * demands.focal_deviation)};
}

Faults ErrorFaults(const LensFit& fit, const Demands& demands) {
  if (fit.error_px <= demands.error_px) return {};
  return {
      Figures("a reprojection error of %.2f px is above %.2f: hold a flat board still, "
              "check --board, or take a richer --model",
              fit.error_px, demands.error_px)};
}

Faults PlaceFaults(const StereoFit& fit) {
  const cv::Vec3d& t = fit.translation_m;
  if (!(cv::norm(t) > kLeastBaseline_m)) {
    return {"both cameras stand at one place: are the pictures of both sides the same?"};
  }
  if (std::abs(t[0]) <= std::abs(t[1])) {
    return {"the cameras stand one above the other: turn the pair by 90 degrees"};
  }
  if (t[0] >= 0.0) return {"left and right are swapped: exchange them"};
  return {};
}

Faults PairFaults(int pairs, const Demands& demands) {
  if (pairs >= demands.views) return {};
  return {
      Figures("%d pairs are too few, %d are the least: show the board to both cameras "
              "more often",
              pairs, demands.views)};
}

Faults StereoErrorFaults(const StereoCalibration& calibration, const Demands& demands) {
  Faults faults;
  Require(calibration.fit.error_px <= demands.error_px,
          Figures("a stereo reprojection error of %.2f px is above %.2f: take both pictures "
                  "at the same moment, hold the board still",
                  calibration.fit.error_px, demands.error_px),
          faults);
  Require(calibration.rows_px.median <= demands.rows_px,
          Figures("rows differ by %.2f px (median), at most %.2f: take both pictures at the "
                  "same moment, hold the board still",
                  calibration.rows_px.median, demands.rows_px),
          faults);
  // Cameras at one place, which has been told, see no depth.
  const bool has_squares = std::isfinite(calibration.median_square);
  Require(!has_squares || std::abs(calibration.median_square - 1.0) < kSquareError,
          Figures("squares are measured %.1f %% off their size: tilt the board more, show it "
                  "nearer",
                  100.0 * (calibration.median_square - 1.0)),
          faults);
  return faults;
}

/// All of `parts` in their order, `whose` before each.
Faults Together(const std::vector<Faults>& parts, const std::string& whose = "") {
  Faults all;
  for (const Faults& part : parts) {
    for (const std::string& fault : part) all.push_back(whose + fault);
  }
  return all;
}

}  // namespace

std::vector<std::string> FaultsOf(const CameraCalibration& calibration, const Coverage& coverage,
                                  const std::string& whose, const Demands& demands) {
  const LensFit& fit = calibration.robust.fit;
  const auto views = static_cast<int>(calibration.robust.used.size());
  return Together({ViewFaults(views, coverage, demands), ErrorFaults(fit, demands),
                   CertaintyFaults(fit, demands), LensFaults(fit.lens)},
                  whose);
}

std::vector<std::string> FaultsOf(const StereoCalibration& calibration,
                                  const ViewSelection& selection, const Demands& demands) {
  const StereoFit& fit = calibration.fit;
  return Together({FaultsOf(calibration.left, selection.coverage(0), "left: ", demands),
                   FaultsOf(calibration.right, selection.coverage(1), "right: ", demands),
                   Together({LensFaults(fit.left)}, "left, fitted with the right one: "),
                   Together({LensFaults(fit.right)}, "right, fitted with the left one: "),
                   PairFaults(static_cast<int>(calibration.used.size()), demands), PlaceFaults(fit),
                   StereoErrorFaults(calibration, demands)});
}

}  // namespace deixis::calibrator
