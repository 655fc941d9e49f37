#include "services/calibrator/evaluation/opencv_sample.h"

#include <cmath>
#include <numeric>
#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>

namespace deixis::calibrator {
namespace {

cv::Matx33d CrossMatrix(const cv::Vec3d& t) {
  return {0, -t[2], t[1], t[2], 0, -t[0], -t[1], t[0], 0};
}

cv::Matx34d ProjectionOf(const Lens& lens) {
  cv::Matx34d projection = cv::Matx34d::zeros();
  for (int i = 0; i < 9; ++i) projection(i / 3, i % 3) = lens.matrix(i / 3, i % 3);
  return projection;
}

double DistanceFromLine(const cv::Vec3d& line, const cv::Vec3d& point) {
  return std::abs(line.dot(point)) / std::hypot(line[0], line[1]);
}

std::vector<double> FirstEight(const cv::Mat& distortion) {
  std::vector<double> values(distortion.begin<double>(), distortion.end<double>());
  values.resize(8, 0.0);
  return values;
}

}  // namespace

std::optional<Corners> SampleCorners(const cv::Mat& grey, cv::Size count) {
  Corners corners;
  bool is_found = false;
  for (int scale = 1; scale <= 2 && !is_found; ++scale) {
    cv::Mat enlarged = grey;
    if (scale > 1) cv::resize(grey, enlarged, {}, scale, scale, cv::INTER_LINEAR_EXACT);
    is_found =
        cv::findChessboardCorners(enlarged, count, corners.points_px,
                                  cv::CALIB_CB_ADAPTIVE_THRESH | cv::CALIB_CB_NORMALIZE_IMAGE);
    for (cv::Point2f& point : corners.points_px) point *= 1.0 / scale;
  }
  if (!is_found) return std::nullopt;
  cv::cornerSubPix(grey, corners.points_px, {11, 11}, {-1, -1},
                   {cv::TermCriteria::COUNT + cv::TermCriteria::EPS, 30, 0.01});
  corners.ids.resize(corners.points_px.size());
  std::iota(corners.ids.begin(), corners.ids.end(), 0);
  return corners;
}

StereoFit SampleFit(const std::vector<CornerPair>& pairs, const BoardLayout& layout,
                    cv::Size size) {
  std::vector<std::vector<cv::Point3f>> object;
  std::vector<std::vector<cv::Point2f>> left;
  std::vector<std::vector<cv::Point2f>> right;
  for (const CornerPair& pair : pairs) {
    object.push_back(PointsOnBoard(layout, pair.first));
    left.push_back(pair.first.points_px);
    right.push_back(pair.second.points_px);
  }
  cv::Mat matrices[2] = {cv::initCameraMatrix2D(object, left, size, 0),
                         cv::initCameraMatrix2D(object, right, size, 0)};
  cv::Mat distortions[2];
  cv::Mat rotation;
  cv::Mat translation;
  cv::Mat ignored;
  StereoFit fit;
  fit.error_px = cv::stereoCalibrate(object, left, right, matrices[0], distortions[0], matrices[1],
                                     distortions[1], size, rotation, translation, ignored, ignored,
                                     cv::CALIB_FIX_ASPECT_RATIO | cv::CALIB_ZERO_TANGENT_DIST |
                                         cv::CALIB_USE_INTRINSIC_GUESS |
                                         cv::CALIB_SAME_FOCAL_LENGTH | cv::CALIB_RATIONAL_MODEL |
                                         cv::CALIB_FIX_K3 | cv::CALIB_FIX_K4 | cv::CALIB_FIX_K5,
                                     {cv::TermCriteria::COUNT + cv::TermCriteria::EPS, 100, 1e-5});
  fit.left = {LensModel::kRational, size, matrices[0], FirstEight(distortions[0])};
  fit.right = {LensModel::kRational, size, matrices[1], FirstEight(distortions[1])};
  fit.rotation = rotation;
  fit.translation_m = cv::Vec3d(translation.ptr<double>());
  fit.rectification = Rectify(fit, 1.0);
  return fit;
}

double SampleEpipolarError_px(const StereoFit& fit, const std::vector<CornerPair>& pairs) {
  const cv::Matx33d fundamental = fit.right.matrix.inv().t() * CrossMatrix(fit.translation_m) *
                                  fit.rotation * fit.left.matrix.inv();
  double sum = 0.0;
  double points = 0.0;
  for (const CornerPair& pair : pairs) {
    const auto left =
        Undistort(fit.left, pair.first.points_px, cv::Matx33d::eye(), ProjectionOf(fit.left));
    const auto right =
        Undistort(fit.right, pair.second.points_px, cv::Matx33d::eye(), ProjectionOf(fit.right));
    for (std::size_t i = 0; i < left.size(); ++i) {
      const cv::Vec3d a(left[i].x, left[i].y, 1.0);
      const cv::Vec3d b(right[i].x, right[i].y, 1.0);
      sum += DistanceFromLine(fundamental * a, b) + DistanceFromLine(fundamental.t() * b, a);
    }
    points += static_cast<double>(left.size());
  }
  return sum / points;
}

}  // namespace deixis::calibrator
