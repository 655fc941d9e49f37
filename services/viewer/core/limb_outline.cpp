#include "services/viewer/core/limb_outline.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <optional>

namespace deixis::viewer {
namespace {

constexpr double kNearest_m = 0.1;
constexpr int kCorners = 24;             // Of an ellipse.
constexpr double kNineOfTen = 4.605170;  // Chi-square of two dimensions.

double TurnOf(int corner) { return 2.0 * M_PI * corner / kCorners; }

Eigen::Vector2d Project(const Eigen::Vector3d& point_m, const geometry::CameraCalibration& camera) {
  return camera.focal_px.cwiseProduct(point_m.head<2>()) / point_m.z() + camera.principal_point_px;
}

/// The part of a line that lies before the camera.
struct Line {
  Eigen::Vector3d from_m;
  Eigen::Vector3d to_m;
};

std::optional<Line> Before(Line line) {
  if (line.from_m.z() < line.to_m.z()) std::swap(line.from_m, line.to_m);  // The farther end first.
  if (!(line.from_m.z() > kNearest_m)) return std::nullopt;
  if (line.to_m.z() >= kNearest_m) return line;
  const double share = (line.from_m.z() - kNearest_m) / (line.from_m.z() - line.to_m.z());
  line.to_m = line.from_m + share * (line.to_m - line.from_m);
  return line;
}

std::vector<Eigen::Vector2d> HullOf(const std::vector<cv::Point2f>& points) {
  std::vector<cv::Point2f> hull;
  if (!points.empty()) cv::convexHull(points, hull);
  std::vector<Eigen::Vector2d> corners;
  for (const cv::Point2f& corner : hull) corners.emplace_back(corner.x, corner.y);
  return corners;
}

Eigen::Matrix<double, 2, 3> ProjectionJacobian(const Eigen::Vector3d& at_m,
                                               const geometry::CameraCalibration& camera) {
  Eigen::Matrix<double, 2, 3> jacobian = Eigen::Matrix<double, 2, 3>::Zero();
  jacobian.leftCols<2>().diagonal() = camera.focal_px / at_m.z();
  jacobian.col(2) = -camera.focal_px.cwiseProduct(at_m.head<2>()) / (at_m.z() * at_m.z());
  return jacobian;
}

}  // namespace

std::vector<Eigen::Vector2d> OutlineOf(const geometry::DegenerateCylinder& limb,
                                       const geometry::RigidTransform& camera_from_limb,
                                       const geometry::CameraCalibration& camera) {
  std::vector<cv::Point2f> points;
  for (int corner = 0; corner < kCorners; ++corner) {
    const auto line = Before({camera_from_limb * geometry::SidePoint(limb, TurnOf(corner), 0.0),
                              camera_from_limb * geometry::SidePoint(limb, TurnOf(corner), 1.0)});
    if (!line) continue;
    for (const Eigen::Vector3d& end_m : {line->from_m, line->to_m}) {
      const Eigen::Vector2f end = Project(end_m, camera).cast<float>();
      points.emplace_back(end.x(), end.y());
    }
  }
  return HullOf(points);
}

std::vector<Eigen::Vector2d> SpreadOf(const Eigen::Vector3d& mean_m,
                                      const Eigen::Matrix3d& covariance_m2,
                                      const geometry::CameraCalibration& camera) {
  if (!(mean_m.z() > kNearest_m) || covariance_m2.isZero(0.0)) return {};
  const auto jacobian = ProjectionJacobian(mean_m, camera);
  const Eigen::Matrix2d covariance_px2 = jacobian * covariance_m2 * jacobian.transpose();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> axes(covariance_px2);
  const Eigen::Vector2d semi_axes_px = (kNineOfTen * axes.eigenvalues().cwiseMax(0.0)).cwiseSqrt();
  const Eigen::Vector2d centre_px = Project(mean_m, camera);
  std::vector<Eigen::Vector2d> outline;
  for (int corner = 0; corner < kCorners; ++corner) {
    const Eigen::Vector2d direction(std::cos(TurnOf(corner)), std::sin(TurnOf(corner)));
    outline.push_back(centre_px + axes.eigenvectors() * semi_axes_px.cwiseProduct(direction));
  }
  return outline;
}

}  // namespace deixis::viewer
