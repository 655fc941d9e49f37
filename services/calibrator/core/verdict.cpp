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

class Faults {
 public:
  explicit Faults(std::string whose) : whose_(std::move(whose)) {}
  void Require(bool holds, const std::string& fault) {
    if (!holds) found_.push_back(whose_ + fault);
  }
  std::vector<std::string> found() const { return found_; }

 private:
  std::string whose_;
  std::vector<std::string> found_;
};

std::string FirstAdvice(const Coverage& coverage) {
  for (const std::string& advice : coverage.Advice()) {
    if (advice.rfind("show", 0) == 0) return advice;
  }
  return "show the board all over the picture";
}

void JudgeLens(const Lens& lens, Faults& faults) {
  const double x = (lens.matrix(0, 2) + 0.5) / lens.size.width - 0.5;
  const double y = (lens.matrix(1, 2) + 0.5) / lens.size.height - 0.5;
  faults.Require(std::abs(x) < kFarthestCentre && std::abs(y) < kFarthestCentre,
                 Figures("the principal point (%.0f, %.0f) is far from the middle of the picture: "
                         "tilt the board more, both ways",
                         lens.matrix(0, 2), lens.matrix(1, 2)));
  const double aspect = lens.matrix(0, 0) / lens.matrix(1, 1);
  faults.Require(aspect < kLargestAspect && aspect > 1.0 / kLargestAspect,
                 Figures("fx / fy is %.3f: tilt the board more, or give --fix-aspect", aspect));
  const double fov_deg = HorizontalFov_deg(lens);
  faults.Require(fov_deg > kNarrowest_deg && fov_deg < kWidest_deg,
                 Figures("a field of view of %.1f deg is no camera's: check --board and --square, "
                         "or tilt the board more",
                         fov_deg));
  faults.Require(IsMonotonic(lens),
                 "the distortion folds the picture's corners over: show the board there, or take "
                 "a simpler --model");
}

}  // namespace

std::vector<std::string> FaultsOf(const CameraCalibration& calibration, const Coverage& coverage,
                                  const std::string& whose, const Demands& demands) {
  Faults faults(whose);
  const LensFit& fit = calibration.robust.fit;
  const auto views = static_cast<int>(calibration.robust.used.size());
  faults.Require(views >= demands.views,
                 Figures("%d views are too few, %d are the least: show the board more often", views,
                         demands.views));
  faults.Require(coverage.share() >= demands.coverage,
                 Figures("only %.0f %% of the picture were covered, %.0f %% are the least: ",
                         100.0 * coverage.share(), 100.0 * demands.coverage) +
                     FirstAdvice(coverage));
  faults.Require(fit.error_px <= demands.error_px,
                 Figures("a reprojection error of %.2f px is above %.2f: hold a flat board still, "
                         "check --board, or take a richer --model",
                         fit.error_px, demands.error_px));
  faults.Require(coverage.largest_tilt_deg() >= demands.tilt_deg,
                 Figures("the board was tilted by %.0f deg at most, %.0f are the least: tilt the "
                         "board by 20 to 40 degrees, both ways",
                         coverage.largest_tilt_deg(), demands.tilt_deg));
  if (!fit.deviations.empty()) {
    const double share = fit.deviations[0] / fit.lens.matrix(0, 0);
    faults.Require(share <= demands.focal_deviation,
                   Figures("the focal length is uncertain by %.1f %%, at most %.1f: tilt the board "
                           "by 20 to 40 degrees, both ways",
                           100.0 * share, 100.0 * demands.focal_deviation));
  }
  JudgeLens(fit.lens, faults);
  return faults.found();
}

std::vector<std::string> FaultsOf(const StereoCalibration& calibration,
                                  const ViewSelection& selection, const Demands& demands) {
  std::vector<std::string> found =
      FaultsOf(calibration.left, selection.coverage(0), "left: ", demands);
  for (const auto& fault : FaultsOf(calibration.right, selection.coverage(1), "right: ", demands)) {
    found.push_back(fault);
  }
  Faults faults("");
  const cv::Vec3d& t = calibration.fit.translation_m;
  const auto pairs = static_cast<int>(calibration.used.size());
  Faults left("left, fitted with the right one: ");
  Faults right("right, fitted with the left one: ");
  JudgeLens(calibration.fit.left, left);
  JudgeLens(calibration.fit.right, right);
  for (const auto& fault : left.found()) found.push_back(fault);
  for (const auto& fault : right.found()) found.push_back(fault);
  faults.Require(pairs >= demands.views,
                 Figures("%d pairs are too few, %d are the least: show the board to both cameras "
                         "more often",
                         pairs, demands.views));
  faults.Require(std::abs(t[0]) > std::abs(t[1]),
                 "the cameras stand one above the other: turn the pair by 90 degrees");
  faults.Require(t[0] < 0.0 || std::abs(t[0]) <= std::abs(t[1]),
                 "left and right are swapped: exchange them");
  faults.Require(calibration.fit.error_px <= demands.error_px,
                 Figures("a stereo reprojection error of %.2f px is above %.2f: take both pictures "
                         "at the same moment, hold the board still",
                         calibration.fit.error_px, demands.error_px));
  faults.Require(calibration.rows_px.median <= demands.rows_px,
                 Figures("rows differ by %.2f px (median), at most %.2f: take both pictures at the "
                         "same moment, hold the board still",
                         calibration.rows_px.median, demands.rows_px));
  faults.Require(
      std::abs(calibration.median_square - 1.0) < kSquareError,
      Figures("squares are measured %.1f %% off their size: tilt the board more, show it "
              "nearer",
              100.0 * (calibration.median_square - 1.0)));
  for (const auto& fault : faults.found()) found.push_back(fault);
  return found;
}

}  // namespace deixis::calibrator
