#include "services/calibrator/core/lens_fit.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/calib3d.hpp>

#include "services/calibrator/core/median.h"

namespace deixis::calibrator {
namespace {

constexpr std::size_t kFewestViews = 3;
constexpr std::size_t kGroups = 5;
constexpr std::size_t kFewestForGroups = 6;
constexpr std::size_t kFewestAfterDropping = 6;
constexpr double kSuspicious = 1.6;  // Times the median, of a view that had its part in the fit.
constexpr double kOutlying = 2.5;    // Times the median, of one that had none.
constexpr double kHarmless_px = 0.3;
constexpr std::size_t kPinholeParameters = 4;

const cv::TermCriteria kUntilStill{cv::TermCriteria::COUNT + cv::TermCriteria::EPS, 100, 1e-9};

using ObjectPoints = std::vector<std::vector<cv::Point3f>>;
using ImagePoints = std::vector<std::vector<cv::Point2f>>;

struct Data {
  ObjectPoints object;
  ImagePoints image;
};

Data DataOf(const std::vector<Corners>& views, const BoardLayout& layout) {
  Data data;
  for (const Corners& corners : views) {
    data.object.push_back(PointsOnBoard(layout, corners));
    data.image.push_back(corners.points_px);
  }
  return data;
}

std::size_t DistortionValues(LensModel model) {
  switch (model) {
    case LensModel::kPlumbBob:
      return 5;
    case LensModel::kRational:
      return 8;
    case LensModel::kFisheye:
      return 4;
  }
  return 0;
}

std::vector<BoardPose> Poses(const std::vector<cv::Mat>& rotations,
                             const std::vector<cv::Mat>& translations) {
  std::vector<BoardPose> poses;
  for (std::size_t i = 0; i < rotations.size(); ++i) {
    poses.push_back(
        {cv::Vec3d(rotations[i].ptr<double>()), cv::Vec3d(translations[i].ptr<double>())});
  }
  return poses;
}

void MeasureErrors(LensFit& fit, const std::vector<Corners>& views, const BoardLayout& layout) {
  double sum = 0.0;
  std::size_t points = 0;
  for (std::size_t i = 0; i < views.size(); ++i) {
    const auto projected = Project(fit.lens, PointsOnBoard(layout, views[i]), fit.poses[i]);
    double of_view = 0.0;
    for (std::size_t j = 0; j < projected.size(); ++j) {
      const cv::Point2d residual = cv::Point2d(projected[j]) - cv::Point2d(views[i].points_px[j]);
      of_view += residual.dot(residual);
    }
    fit.view_errors_px.push_back(std::sqrt(of_view / static_cast<double>(projected.size())));
    sum += of_view;
    points += projected.size();
  }
  fit.error_px = std::sqrt(sum / static_cast<double>(points));
}

int PinholeFlags(const LensOptions& options) {
  int flags = 0;
  if (options.model == LensModel::kRational) flags |= cv::CALIB_RATIONAL_MODEL;
  if (options.has_fixed_aspect) flags |= cv::CALIB_FIX_ASPECT_RATIO;
  if (options.has_zero_tangent) flags |= cv::CALIB_ZERO_TANGENT_DIST;
  return flags;
}

void FitPinhole(const Data& data, const LensOptions& options, LensFit& fit) {
  cv::Mat matrix = cv::Mat::eye(3, 3, CV_64F);
  cv::Mat distortion;
  cv::Mat deviations;
  cv::Mat ignored;
  std::vector<cv::Mat> rotations;
  std::vector<cv::Mat> translations;
  cv::calibrateCamera(data.object, data.image, fit.lens.size, matrix, distortion, rotations,
                      translations, deviations, ignored, ignored, PinholeFlags(options),
                      kUntilStill);
  const std::size_t count = DistortionValues(options.model);
  fit.lens.matrix = matrix;
  fit.lens.distortion.assign(distortion.begin<double>(), distortion.end<double>());
  fit.lens.distortion.resize(count, 0.0);
  fit.deviations.assign(deviations.begin<double>(), deviations.end<double>());
  fit.deviations.resize(kPinholeParameters + count, 0.0);
  fit.poses = Poses(rotations, translations);
}

// Focal lengths to start from, of the width: OpenCV's own start, that of 180 degrees, fails on
// lenses that see less.
constexpr std::array<double, 4> kFisheyeStarts{0.32, 0.5, 0.8, 1.3};

void FitFisheyeFrom(double focal_px, const Data& data, LensFit& fit) {
  const cv::Size size = fit.lens.size;
  cv::Mat matrix = cv::Mat(cv::Matx33d(focal_px, 0, 0.5 * (size.width - 1), 0, focal_px,
                                       0.5 * (size.height - 1), 0, 0, 1),
                           true);
  cv::Mat distortion = cv::Mat::zeros(4, 1, CV_64F);
  std::vector<cv::Mat> rotations;
  std::vector<cv::Mat> translations;
  cv::fisheye::calibrate(data.object, data.image, size, matrix, distortion, rotations, translations,
                         cv::fisheye::CALIB_RECOMPUTE_EXTRINSIC | cv::fisheye::CALIB_FIX_SKEW |
                             cv::fisheye::CALIB_USE_INTRINSIC_GUESS,
                         kUntilStill);
  fit.lens.matrix = matrix;
  fit.lens.distortion.assign(distortion.begin<double>(), distortion.end<double>());
  fit.poses = Poses(rotations, translations);
}

bool IsFinite(const Lens& lens) {
  return cv::checkRange(lens.matrix) && cv::checkRange(lens.distortion) &&
         lens.matrix(0, 0) > 0.0 && lens.matrix(1, 1) > 0.0;
}

LensFit FitFisheye(const Data& data, const std::vector<Corners>& views, const BoardLayout& layout,
                   const LensFit& start) {
  std::optional<LensFit> best;
  for (const double share : kFisheyeStarts) {
    LensFit fit = start;
    try {
      FitFisheyeFrom(share * start.lens.size.width, data, fit);
    } catch (const cv::Exception&) {
      continue;  // The next start may do.
    }
    if (!IsFinite(fit.lens)) continue;
    MeasureErrors(fit, views, layout);
    if (!best || fit.error_px < best->error_px) best = fit;
  }
  if (!best) throw cv::Exception();
  return *best;
}

LensFit FitWithoutDeviations(const std::vector<Corners>& views, const BoardLayout& layout,
                             cv::Size size, const LensOptions& options) {
  if (views.size() < kFewestViews) throw FitFailed("three views are the least: show more");
  LensFit fit;
  fit.lens.model = options.model;
  fit.lens.size = size;
  try {
    const Data data = DataOf(views, layout);
    if (options.model == LensModel::kFisheye) return FitFisheye(data, views, layout, fit);
    FitPinhole(data, options, fit);
  } catch (const cv::Exception&) {
    throw FitFailed("the views determine no " + NameOf(options.model) +
                    " lens: tilt the board more, cover the picture, or take another --model");
  }
  if (!IsFinite(fit.lens)) throw FitFailed("the fit ran away: tilt the board more");
  MeasureErrors(fit, views, layout);
  return fit;
}

std::optional<LensFit> FitIfPossible(const std::vector<Corners>& views, const BoardLayout& layout,
                                     cv::Size size, const LensOptions& options) {
  try {
    return FitWithoutDeviations(views, layout, size, options);
  } catch (const FitFailed&) {
    return std::nullopt;
  }
}

/// Views in and out of group `group`.
struct Split {
  std::vector<Corners> inside;
  std::vector<Corners> outside;
};

Split SplitOff(const std::vector<Corners>& views, std::size_t group) {
  Split split;
  for (std::size_t i = 0; i < views.size(); ++i) {
    (i % kGroups == group ? split.inside : split.outside).push_back(views[i]);
  }
  return split;
}

std::vector<double> ParametersOf(const Lens& lens) {
  std::vector<double> values{lens.matrix(0, 0), lens.matrix(1, 1), lens.matrix(0, 2),
                             lens.matrix(1, 2)};
  values.insert(values.end(), lens.distortion.begin(), lens.distortion.end());
  return values;
}

/// The jackknife's standard deviations, of the parameters without one group each.
std::vector<double> SpreadOf(const std::vector<std::vector<double>>& fits) {
  std::vector<double> deviations(fits.front().size(), 0.0);
  for (std::size_t p = 0; p < deviations.size(); ++p) {
    double mean = 0.0;
    for (const auto& fit : fits) mean += fit[p] / kGroups;
    for (const auto& fit : fits) deviations[p] += (fit[p] - mean) * (fit[p] - mean);
    deviations[p] = std::sqrt(deviations[p] * (kGroups - 1) / kGroups);
  }
  return deviations;
}

std::vector<double> JackknifeDeviations(const std::vector<Corners>& views,
                                        const BoardLayout& layout, cv::Size size,
                                        const LensOptions& options) {
  if (views.size() < kFewestForGroups) return {};
  std::vector<std::vector<double>> fits;
  for (std::size_t group = 0; group < kGroups; ++group) {
    const auto fit = FitIfPossible(SplitOff(views, group).outside, layout, size, options);
    if (!fit) return {};
    fits.push_back(ParametersOf(fit->lens));
  }
  return SpreadOf(fits);
}

std::vector<std::size_t> Without(const std::vector<std::size_t>& indices, std::size_t position) {
  std::vector<std::size_t> rest = indices;
  rest.erase(rest.begin() + static_cast<std::ptrdiff_t>(position));
  return rest;
}

/// The worst view of `result`, when it is an outlier; none when the others determine no lens.
std::optional<DroppedView> FindOutlier(const std::vector<Corners>& views, const BoardLayout& layout,
                                       cv::Size size, const LensOptions& options,
                                       const RobustLensFit& result) {
  const auto& errors = result.fit.view_errors_px;
  const auto worst = std::max_element(errors.begin(), errors.end());
  if (*worst < std::max(kHarmless_px, kSuspicious * Median(errors))) return std::nullopt;
  const auto position = static_cast<std::size_t>(worst - errors.begin());
  const std::size_t index = result.used[position];
  const auto without =
      FitIfPossible(At(views, Without(result.used, position)), layout, size, options);
  if (!without) return std::nullopt;
  const double others_px = Median(without->view_errors_px);
  const double error_px = ReprojectionError_px(without->lens, layout, views[index]).value_or(1e6);
  if (error_px < std::max(kHarmless_px, kOutlying * others_px)) return std::nullopt;
  return DroppedView{index, error_px, others_px};
}

}  // namespace

std::vector<Corners> At(const std::vector<Corners>& all, const std::vector<std::size_t>& indices) {
  std::vector<Corners> chosen;
  for (const std::size_t index : indices) chosen.push_back(all.at(index));
  return chosen;
}

LensFit FitLens(const std::vector<Corners>& views, const BoardLayout& layout, cv::Size size,
                const LensOptions& options) {
  LensFit fit = FitWithoutDeviations(views, layout, size, options);
  if (options.model == LensModel::kFisheye) {
    fit.deviations = JackknifeDeviations(views, layout, size, options);
  }
  return fit;
}

RobustLensFit FitLensRobustly(const std::vector<Corners>& views, const BoardLayout& layout,
                              cv::Size size, const LensOptions& options) {
  RobustLensFit result;
  for (std::size_t i = 0; i < views.size(); ++i) result.used.push_back(i);
  const std::size_t least = std::max(kFewestAfterDropping, views.size() - views.size() / 3);
  result.fit = FitWithoutDeviations(views, layout, size, options);
  while (result.used.size() > least) {
    const auto outlier = FindOutlier(views, layout, size, options, result);
    if (!outlier) break;
    result.dropped.push_back(*outlier);
    result.used.erase(std::find(result.used.begin(), result.used.end(), outlier->index));
    result.fit = FitWithoutDeviations(At(views, result.used), layout, size, options);
  }
  result.fit = FitLens(At(views, result.used), layout, size, options);
  return result;
}

std::optional<double> FittedError_px(const std::vector<Corners>& views, const BoardLayout& layout,
                                     cv::Size size, const LensOptions& options) {
  const auto fit = FitIfPossible(views, layout, size, options);
  if (!fit) return std::nullopt;
  return fit->error_px;
}

std::optional<double> CrossValidatedError_px(const std::vector<Corners>& views,
                                             const BoardLayout& layout, cv::Size size,
                                             const LensOptions& options) {
  if (views.size() < kFewestForGroups) return std::nullopt;
  double sum = 0.0;
  double points = 0.0;
  for (std::size_t group = 0; group < kGroups; ++group) {
    const Split split = SplitOff(views, group);
    const auto fit = FitIfPossible(split.outside, layout, size, options);
    if (!fit) return std::nullopt;
    for (const Corners& corners : split.inside) {
      const auto error_px = ReprojectionError_px(fit->lens, layout, corners);
      if (!error_px) return std::nullopt;
      const auto count = static_cast<double>(corners.ids.size());
      sum += *error_px * *error_px * count;
      points += count;
    }
  }
  return std::sqrt(sum / points);
}

}  // namespace deixis::calibrator
