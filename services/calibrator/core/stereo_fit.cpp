#include "services/calibrator/core/stereo_fit.h"

#include <algorithm>
#include <cmath>
#include <opencv2/calib3d.hpp>

namespace deixis::calibrator {
namespace {

const cv::TermCriteria kUntilStill{cv::TermCriteria::COUNT + cv::TermCriteria::EPS, 200, 1e-9};

struct Data {
  std::vector<std::vector<cv::Point3f>> object;
  std::vector<std::vector<cv::Point2f>> left;
  std::vector<std::vector<cv::Point2f>> right;
};

Data DataOf(const std::vector<CornerPair>& pairs, const BoardLayout& layout) {
  Data data;
  for (const CornerPair& pair : pairs) {
    data.object.push_back(PointsOnBoard(layout, pair.first));
    data.left.push_back(pair.first.points_px);
    data.right.push_back(pair.second.points_px);
  }
  return data;
}

int Flags(const LensOptions& options, Refinement refinement) {
  // Without the flag of the model, OpenCV takes k4 to k6 of a fixed lens for zero.
  int flags = options.model == LensModel::kRational ? cv::CALIB_RATIONAL_MODEL : 0;
  if (refinement == Refinement::kPlacesOnly) return flags | cv::CALIB_FIX_INTRINSIC;
  flags |= cv::CALIB_USE_INTRINSIC_GUESS;
  if (options.has_fixed_aspect) flags |= cv::CALIB_FIX_ASPECT_RATIO;
  if (options.has_zero_tangent) flags |= cv::CALIB_ZERO_TANGENT_DIST;
  return flags;
}

void Fit(const Data& data, Lens& left, Lens& right, int flags, StereoFit& fit) {
  cv::Mat matrices[2] = {cv::Mat(left.matrix), cv::Mat(right.matrix)};
  cv::Mat distortions[2] = {cv::Mat(left.distortion, true), cv::Mat(right.distortion, true)};
  cv::Mat rotation;
  cv::Mat translation;
  cv::Mat ignored;
  fit.error_px = cv::stereoCalibrate(data.object, data.left, data.right, matrices[0],
                                     distortions[0], matrices[1], distortions[1], left.size,
                                     rotation, translation, ignored, ignored, flags, kUntilStill);
  // The sum over both cameras per corner, in OpenCV's root mean square, is halved already.
  fit.rotation = rotation;
  fit.translation_m = cv::Vec3d(translation.ptr<double>());
  const std::size_t count = left.distortion.size();
  left.matrix = matrices[0];
  right.matrix = matrices[1];
  left.distortion.assign(distortions[0].begin<double>(), distortions[0].end<double>());
  right.distortion.assign(distortions[1].begin<double>(), distortions[1].end<double>());
  left.distortion.resize(count);
  right.distortion.resize(count);
}

std::vector<cv::Point2f> Rectified(const Lens& lens, const Corners& corners,
                                   const cv::Matx33d& rotation, const cv::Matx34d& projection) {
  return Undistort(lens, corners.points_px, rotation, projection);
}

cv::Point3d Triangulate(const cv::Matx44d& disparity_to_depth, cv::Point2d left,
                        cv::Point2d right) {
  const cv::Vec4d point = disparity_to_depth * cv::Vec4d(left.x, left.y, left.x - right.x, 1.0);
  return {point[0] / point[3], point[1] / point[3], point[2] / point[3]};
}

}  // namespace

CornerPair PairOf(const Corners& left, const Corners& right, const BoardLayout& layout) {
  if (!layout.has_certain_ids) {
    const cv::Point2f way_left = left.points_px.back() - left.points_px.front();
    const cv::Point2f way_right = right.points_px.back() - right.points_px.front();
    if (way_left.dot(way_right) < 0.0F) return Shared(left, Turned(right, layout));
  }
  return Shared(left, right);
}

StereoFit FitStereo(const std::vector<CornerPair>& pairs, const BoardLayout& layout,
                    const Lens& left, const Lens& right, const LensOptions& options,
                    Refinement refinement) {
  if (pairs.empty()) throw FitFailed("no pair shows the board in both pictures: show it to both");
  StereoFit fit;
  fit.left = left;
  fit.right = right;
  try {
    Lens lenses[2] = {left, right};
    Fit(DataOf(pairs, layout), lenses[0], lenses[1], Flags(options, refinement), fit);
    if (refinement == Refinement::kJoint) {
      fit.left = lenses[0];
      fit.right = lenses[1];
    }
    fit.rectification = Rectify(fit, 0.0);
  } catch (const cv::Exception&) {
    throw FitFailed("the pairs determine no stereo calibration: show the board to both, tilted");
  }
  if (!cv::checkRange(fit.rotation) || !cv::checkRange(fit.translation_m)) {
    throw FitFailed("the stereo fit ran away: show more pairs, tilted more");
  }
  return fit;
}

Rectification Rectify(const StereoFit& fit, double alpha) {
  Rectification result;
  cv::stereoRectify(fit.left.matrix, fit.left.distortion, fit.right.matrix, fit.right.distortion,
                    fit.left.size, fit.rotation, fit.translation_m, result.left_rotation,
                    result.right_rotation, result.left_projection, result.right_projection,
                    result.disparity_to_depth, cv::CALIB_ZERO_DISPARITY, alpha, fit.left.size);
  return result;
}

std::vector<double> RowDifferences_px(const StereoFit& fit, const CornerPair& pair) {
  const Rectification& r = fit.rectification;
  const auto left = Rectified(fit.left, pair.first, r.left_rotation, r.left_projection);
  const auto right = Rectified(fit.right, pair.second, r.right_rotation, r.right_projection);
  const double scale = fit.left.matrix(1, 1) / r.left_projection(1, 1);
  std::vector<double> differences;
  for (std::size_t i = 0; i < left.size(); ++i) {
    differences.push_back(scale * (static_cast<double>(left[i].y) - right[i].y));
  }
  return differences;
}

std::vector<double> RelativeSquares(const StereoFit& fit, const CornerPair& pair,
                                    const BoardLayout& layout) {
  const Rectification& r = fit.rectification;
  const auto left = Rectified(fit.left, pair.first, r.left_rotation, r.left_projection);
  const auto right = Rectified(fit.right, pair.second, r.right_rotation, r.right_projection);
  std::vector<double> ratios;
  for (std::size_t i = 0; i + 1 < left.size(); ++i) {
    const int id = pair.first.ids[i];
    if (pair.first.ids[i + 1] != id + 1 || (id + 1) % layout.corners.width == 0) continue;
    const cv::Point3d a = Triangulate(r.disparity_to_depth, left[i], right[i]);
    const cv::Point3d b = Triangulate(r.disparity_to_depth, left[i + 1], right[i + 1]);
    ratios.push_back(cv::norm(a - b) / layout.square_m);
  }
  return ratios;
}

ErrorSummary Summarise(std::vector<double> errors) {
  if (errors.empty()) return {};
  ErrorSummary summary;
  for (double& error : errors) {
    error = std::abs(error);
    summary.mean += error / static_cast<double>(errors.size());
  }
  std::sort(errors.begin(), errors.end());
  summary.median = errors[errors.size() / 2];
  summary.p95 = errors[std::min(errors.size() - 1, errors.size() * 95 / 100)];
  return summary;
}

}  // namespace deixis::calibrator
