#include "services/calibrator/core/calibration.h"

#include <algorithm>
#include <array>
#include <stdexcept>

#include "services/calibrator/core/median.h"

namespace deixis::calibrator {
namespace {

constexpr double kGoodEnough = 1.02;  // Of an error, over the least.
constexpr std::size_t kGroups = 5;
constexpr std::size_t kFewestForGroups = 8;
constexpr std::size_t kFewestAfterDropping = 5;
constexpr std::size_t kFewestShared = 6;
constexpr double kSuspicious = 1.8;
constexpr double kOutlying = 3.0;
constexpr double kHarmless_px = 0.3;

using Indices = std::vector<std::size_t>;
using Models = std::vector<LensModel>;

// The simplest first.
const Models kPinholeModels{LensModel::kPlumbBob, LensModel::kRational};
const Models kAllModels{LensModel::kPlumbBob, LensModel::kRational, LensModel::kFisheye};

cv::Size SizeOf(const std::vector<Shot>& shots, std::size_t camera) {
  if (shots.empty()) throw FitFailed("no view of the board: show it");
  return shots.front().views.at(camera).size;
}

LensOptions BestModel(const std::vector<Corners>& views, const BoardLayout& layout, cv::Size size,
                      LensOptions options, const Models& models) {
  std::vector<std::optional<double>> errors_px;
  for (const LensModel model : models) {
    options.model = model;
    errors_px.push_back(CrossValidatedError_px(views, layout, size, options));
  }
  options.model = models[FirstGoodEnough(errors_px)];
  return options;
}

LensOptions ChosenOptions(const std::vector<Shot>& shots, std::size_t camera,
                          const BoardLayout& layout, const CalibrationOptions& options,
                          const Models& models) {
  if (options.choice == ModelChoice::kAsGiven) return options.lens;
  return BestModel(CornersOf(shots, camera), layout, SizeOf(shots, camera), options.lens, models);
}

CameraCalibration CalibrateLens(const std::vector<Shot>& shots, std::size_t camera,
                                const BoardLayout& layout, const LensOptions& options) {
  const cv::Size size = SizeOf(shots, camera);
  const std::vector<Corners> views = CornersOf(shots, camera);
  CameraCalibration result;
  result.options = options;
  result.robust = FitLensRobustly(views, layout, size, options);
  result.cross_validated_px =
      CrossValidatedError_px(calibrator::At(views, result.robust.used), layout, size, options);
  return result;
}

std::vector<CornerPair> PairsOf(const std::vector<Shot>& shots, const BoardLayout& layout) {
  std::vector<CornerPair> pairs;
  for (const Shot& shot : shots) {
    pairs.push_back(PairOf(shot.views.at(0).corners, shot.views.at(1).corners, layout));
  }
  return pairs;
}

Indices UsedByBoth(const CameraCalibration& left, const CameraCalibration& right,
                   const std::vector<CornerPair>& pairs) {
  Indices used;
  for (const std::size_t index : left.robust.used) {
    const auto& others = right.robust.used;
    const bool is_in_both = std::find(others.begin(), others.end(), index) != others.end();
    if (is_in_both && pairs[index].first.ids.size() >= kFewestShared) used.push_back(index);
  }
  return used;
}

std::vector<CornerPair> At(const std::vector<CornerPair>& pairs, const Indices& indices) {
  std::vector<CornerPair> chosen;
  for (const std::size_t index : indices) chosen.push_back(pairs[index]);
  return chosen;
}

double MedianRows_px(const StereoFit& fit, const CornerPair& pair) {
  return Summarise(RowDifferences_px(fit, pair)).median;
}

class PairFitter {
 public:
  PairFitter(const std::vector<CornerPair>& pairs, const BoardLayout& layout,
             const StereoCalibration& calibration, const CalibrationOptions& options)
      : pairs_(pairs), layout_(layout), calibration_(calibration), options_(options) {}

  StereoFit Fit(const Indices& indices) const {
    const LensOptions lens = calibration_.left.options;
    StereoFit fit = FitStereo(At(pairs_, indices), layout_, calibration_.left.robust.fit.lens,
                              calibration_.right.robust.fit.lens, lens, options_.refinement);
    fit.rectification = Rectify(fit, options_.alpha);
    return fit;
  }

  /// The worst pair of `used`, when it is an outlier; none when the others determine no fit.
  std::optional<DroppedView> FindOutlier(const StereoFit& fit, const Indices& used) const {
    const std::vector<double> errors = Errors_px(fit, used);
    const auto worst = std::max_element(errors.begin(), errors.end());
    if (*worst < std::max(kHarmless_px, kSuspicious * Median(errors))) return std::nullopt;
    const auto position = worst - errors.begin();
    Indices rest = used;
    rest.erase(rest.begin() + position);
    const auto without = FitIfPossible(rest);
    if (!without) return std::nullopt;
    const std::size_t index = used[static_cast<std::size_t>(position)];
    const double error_px = MedianRows_px(*without, pairs_[index]);
    const double others_px = Median(Errors_px(*without, rest));
    if (error_px < std::max(kHarmless_px, kOutlying * others_px)) return std::nullopt;
    return DroppedView{index, error_px, others_px};
  }

 private:
  std::optional<StereoFit> FitIfPossible(const Indices& indices) const {
    try {
      return Fit(indices);
    } catch (const FitFailed&) {
      return std::nullopt;
    }
  }

  std::vector<double> Errors_px(const StereoFit& fit, const Indices& indices) const {
    std::vector<double> errors;
    for (const std::size_t index : indices) errors.push_back(MedianRows_px(fit, pairs_[index]));
    return errors;
  }

  const std::vector<CornerPair>& pairs_;
  const BoardLayout& layout_;
  const StereoCalibration& calibration_;
  const CalibrationOptions& options_;
};

void FitPairs(const std::vector<CornerPair>& pairs, const BoardLayout& layout,
              const CalibrationOptions& options, StereoCalibration& result) {
  result.used = UsedByBoth(result.left, result.right, pairs);
  const PairFitter fitter(pairs, layout, result, options);
  result.fit = fitter.Fit(result.used);
  const std::size_t least =
      std::max(kFewestAfterDropping, result.used.size() - result.used.size() / 3);
  while (result.used.size() > least) {
    const auto outlier = fitter.FindOutlier(result.fit, result.used);
    if (!outlier) break;
    result.dropped.push_back(*outlier);
    result.used.erase(std::find(result.used.begin(), result.used.end(), outlier->index));
    result.fit = fitter.Fit(result.used);
  }
}

void Measure(const std::vector<CornerPair>& pairs, const BoardLayout& layout,
             StereoCalibration& result) {
  std::vector<double> rows_px;
  std::vector<double> squares;
  for (const std::size_t index : result.used) {
    const auto of_pair = RowDifferences_px(result.fit, pairs[index]);
    result.pairs.push_back({index, Summarise(of_pair).median});
    rows_px.insert(rows_px.end(), of_pair.begin(), of_pair.end());
    const auto ratios = RelativeSquares(result.fit, pairs[index], layout);
    squares.insert(squares.end(), ratios.begin(), ratios.end());
  }
  result.rows_px = Summarise(rows_px);
  result.median_square = squares.empty() ? 1.0 : Median(squares);
  for (double& square : squares) square -= 1.0;
  result.square_errors = Summarise(squares);
}

StereoCalibration Calibrate(const std::vector<Shot>& shots, const BoardLayout& layout,
                            const CalibrationOptions& options) {
  // One model for both: the files name it once.
  const LensOptions lens = ChosenOptions(shots, 0, layout, options, kPinholeModels);
  StereoCalibration result;
  result.left = CalibrateLens(shots, 0, layout, lens);
  result.right = CalibrateLens(shots, 1, layout, lens);
  FitPairs(PairsOf(shots, layout), layout, options, result);
  return result;
}

std::optional<ErrorSummary> HeldOutRows(const std::vector<Shot>& shots, const BoardLayout& layout,
                                        CalibrationOptions options) {
  if (shots.size() < kFewestForGroups) return std::nullopt;
  std::vector<double> rows_px;
  for (std::size_t group = 0; group < kGroups; ++group) {
    std::vector<Shot> inside;
    std::vector<Shot> outside;
    for (std::size_t i = 0; i < shots.size(); ++i) {
      (i % kGroups == group ? inside : outside).push_back(shots[i]);
    }
    try {
      const StereoFit fit = Calibrate(outside, layout, options).fit;
      for (const CornerPair& pair : PairsOf(inside, layout)) {
        const auto of_pair = RowDifferences_px(fit, pair);
        rows_px.insert(rows_px.end(), of_pair.begin(), of_pair.end());
      }
    } catch (const FitFailed&) {
      return std::nullopt;
    }
  }
  return Summarise(rows_px);
}

std::vector<Shot> At(const std::vector<Shot>& shots, const Indices& indices) {
  std::vector<Shot> chosen;
  for (const std::size_t index : indices) chosen.push_back(shots[index]);
  return chosen;
}

}  // namespace

std::vector<Corners> CornersOf(const std::vector<Shot>& shots, std::size_t camera) {
  std::vector<Corners> views;
  for (const Shot& shot : shots) views.push_back(shot.views.at(camera).corners);
  return views;
}

std::size_t FirstGoodEnough(const std::vector<std::optional<double>>& errors_px) {
  std::optional<double> least_px;
  for (const auto& error_px : errors_px) {
    if (error_px) least_px = std::min(*error_px, least_px.value_or(*error_px));
  }
  const auto first =
      std::find_if(errors_px.begin(), errors_px.end(), [&least_px](const auto& error_px) {
        return error_px && *error_px <= kGoodEnough * *least_px;
      });
  return first == errors_px.end() ? 0 : static_cast<std::size_t>(first - errors_px.begin());
}

CameraCalibration CalibrateCamera(const std::vector<Shot>& shots, std::size_t camera,
                                  const BoardLayout& layout, const CalibrationOptions& options) {
  return CalibrateLens(shots, camera, layout,
                       ChosenOptions(shots, camera, layout, options, kAllModels));
}

StereoCalibration CalibrateStereo(const std::vector<Shot>& shots, const BoardLayout& layout,
                                  const CalibrationOptions& options) {
  if (options.lens.model == LensModel::kFisheye) {
    throw std::invalid_argument("a stereo calibration takes pinhole lenses, no fisheye");
  }
  StereoCalibration result = Calibrate(shots, layout, options);
  Measure(PairsOf(shots, layout), layout, result);
  CalibrationOptions as_used = options;
  as_used.lens = result.left.options;
  as_used.choice = ModelChoice::kAsGiven;
  result.held_out_rows_px = HeldOutRows(At(shots, result.used), layout, as_used);
  return result;
}

}  // namespace deixis::calibrator
