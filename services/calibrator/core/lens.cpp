#include "services/calibrator/core/lens.h"

#include <algorithm>
#include <cmath>
#include <opencv2/calib3d.hpp>

namespace deixis::calibrator {
namespace {

constexpr double kRadiusSteps = 200.0;

/// Radius in the picture (over the focal length) of a direction at `angle_rad` from the axis.
double RadiusOf(const Lens& lens, double angle_rad) {
  const auto& d = lens.distortion;
  if (lens.model == LensModel::kFisheye) {
    const double t = angle_rad * angle_rad;
    return angle_rad * (1.0 + t * (d[0] + t * (d[1] + t * (d[2] + t * d[3]))));
  }
  const double r = std::tan(angle_rad);
  const double s = r * r;
  const double above = 1.0 + s * (d[0] + s * (d[1] + s * d[4]));
  const double below =
      lens.model == LensModel::kRational ? 1.0 + s * (d[5] + s * (d[6] + s * d[7])) : 1.0;
  return r * above / below;
}

/// From the principal point to the picture's farthest corner, over the focal length.
double LargestRadius(const Lens& lens) {
  const double u = lens.matrix(0, 2);
  const double v = lens.matrix(1, 2);
  const double x = std::max(u, lens.size.width - 1 - u) / lens.matrix(0, 0);
  const double y = std::max(v, lens.size.height - 1 - v) / lens.matrix(1, 1);
  return std::hypot(x, y);
}

double RootMeanSquare(const std::vector<cv::Point2f>& a, const std::vector<cv::Point2f>& b) {
  double sum = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const cv::Point2d difference = cv::Point2d(a[i]) - cv::Point2d(b[i]);
    sum += difference.dot(difference);
  }
  return std::sqrt(sum / static_cast<double>(a.size()));
}

}  // namespace

std::string NameOf(LensModel model) {
  switch (model) {
    case LensModel::kPlumbBob:
      return "plumb_bob";
    case LensModel::kRational:
      return "rational";
    case LensModel::kFisheye:
      return "fisheye";
  }
  return "unknown";
}

std::vector<cv::Point2f> Project(const Lens& lens, const std::vector<cv::Point3f>& points_m,
                                 const BoardPose& pose) {
  std::vector<cv::Point2f> points_px;
  if (lens.model == LensModel::kFisheye) {
    cv::fisheye::projectPoints(points_m, points_px, pose.rotation, pose.translation_m, lens.matrix,
                               lens.distortion);
  } else {
    cv::projectPoints(points_m, pose.rotation, pose.translation_m, lens.matrix, lens.distortion,
                      points_px);
  }
  return points_px;
}

std::vector<cv::Point2f> Undistort(const Lens& lens, const std::vector<cv::Point2f>& points_px,
                                   const cv::Matx33d& rotation, const cv::Matx34d& projection) {
  std::vector<cv::Point2f> undistorted;
  if (lens.model == LensModel::kFisheye) {
    cv::fisheye::undistortPoints(points_px, undistorted, lens.matrix, lens.distortion, rotation,
                                 projection);
  } else {
    // OpenCV's own five rounds leave hundredths of a pixel near the corners.
    cv::undistortPoints(points_px, undistorted, lens.matrix, lens.distortion, rotation, projection,
                        {cv::TermCriteria::COUNT + cv::TermCriteria::EPS, 50, 1e-6});
  }
  return undistorted;
}

std::optional<BoardPose> FindPose(const Lens& lens, const BoardLayout& layout,
                                  const Corners& corners) {
  try {
    const std::vector<cv::Point2f> ideal =
        Undistort(lens, corners.points_px, cv::Matx33d::eye(), cv::Matx34d::eye());
    const std::vector<cv::Point3f> points_m = PointsOnBoard(layout, corners);
    BoardPose pose;
    if (!cv::solvePnP(points_m, ideal, cv::Matx33d::eye(), cv::noArray(), pose.rotation,
                      pose.translation_m, false, cv::SOLVEPNP_IPPE)) {
      return std::nullopt;
    }
    cv::solvePnPRefineLM(points_m, ideal, cv::Matx33d::eye(), cv::noArray(), pose.rotation,
                         pose.translation_m);
    if (!cv::checkRange(pose.rotation) || !cv::checkRange(pose.translation_m)) return std::nullopt;
    return pose;
  } catch (const cv::Exception&) {
    return std::nullopt;  // Corners that no pose can have.
  }
}

std::optional<double> ReprojectionError_px(const Lens& lens, const BoardLayout& layout,
                                           const Corners& corners) {
  const auto pose = FindPose(lens, layout, corners);
  if (!pose) return std::nullopt;
  return RootMeanSquare(Project(lens, PointsOnBoard(layout, corners), *pose), corners.points_px);
}

Lens RoughLens(cv::Size size) {
  const double focal_px = size.width;
  return {LensModel::kPlumbBob, size,
          cv::Matx33d(focal_px, 0, (size.width - 1) / 2.0, 0, focal_px, (size.height - 1) / 2.0, 0,
                      0, 1),
          std::vector<double>(5, 0.0)};
}

double HorizontalFov_deg(const Lens& lens) {
  const double half = 0.5 * lens.size.width / lens.matrix(0, 0);
  const double half_rad = lens.model == LensModel::kFisheye ? half : std::atan(half);
  return 2.0 * half_rad * 180.0 / CV_PI;
}

bool IsMonotonic(const Lens& lens) {
  const double largest = LargestRadius(lens);
  const double end_rad = lens.model == LensModel::kFisheye ? CV_PI : 0.5 * CV_PI;
  double before = 0.0;
  for (double step = 1.0; step < kRadiusSteps; step += 1.0) {
    const double radius = RadiusOf(lens, end_rad * step / kRadiusSteps);
    if (!(radius > before)) return false;
    if (radius >= largest) return true;
    before = radius;
  }
  return false;
}

}  // namespace deixis::calibrator
