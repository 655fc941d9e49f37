#include "test/services/stereo_driver/synthetic_rig.h"

#include <cmath>
#include <opencv2/calib3d.hpp>
#include <opencv2/core.hpp>
#include <opencv2/core/eigen.hpp>
#include <opencv2/imgproc.hpp>

#include "services/stereo_driver/core/calibration/camera_matrix.h"

namespace deixis::stereo_driver {
namespace {

geometry::CameraCalibration Lens(double focal_px, double centre_x, double k1) {
  geometry::CameraCalibration lens;
  lens.width_px = 320;
  lens.height_px = 240;
  lens.focal_px = {focal_px, focal_px};
  lens.principal_point_px = {centre_x, 121.0};
  lens.distortion_model = geometry::DistortionModel::kPlumbBob;
  lens.distortion = {k1, 0.03, 0.0005, -0.0004, 0.0};
  lens.is_calibrated = true;
  return lens;
}

/// Smooth noise with details of 8 mm and more, the same at every call.
cv::Mat Texture() {
  cv::RNG random(7);
  cv::Mat fine(1024, 1024, CV_32FC1), coarse(128, 128, CV_32FC1);
  random.fill(fine, cv::RNG::UNIFORM, 0.0, 255.0);
  random.fill(coarse, cv::RNG::UNIFORM, 0.0, 255.0);
  cv::resize(coarse, coarse, fine.size(), 0.0, 0.0, cv::INTER_CUBIC);
  cv::GaussianBlur(fine, fine, {0, 0}, 1.2);
  return 0.6 * fine + 0.4 * coarse;
}

cv::Mat See(const geometry::CameraCalibration& lens, const geometry::RigidTransform& left_from_lens,
            const Plane& plane, const cv::Mat& texture) {
  constexpr double kTexelsPerMetre = 128.0;
  cv::Mat map(lens.height_px, lens.width_px, CV_32FC2);
  const std::vector<cv::Point2d> rays = RaysOf(lens);
  for (std::size_t i = 0; i < rays.size(); ++i) {
    const Eigen::Vector3d way = left_from_lens.rotation * Eigen::Vector3d(rays[i].x, rays[i].y, 1);
    const Eigen::Vector3d start = left_from_lens.translation_m;
    const Eigen::Vector3d point =
        start + way * (plane.distance_m - plane.normal.dot(start)) / plane.normal.dot(way);
    map.at<cv::Vec2f>(static_cast<int>(i)) =
        cv::Vec2f(static_cast<float>(512.0 + kTexelsPerMetre * point.x()),
                  static_cast<float>(512.0 + kTexelsPerMetre * point.y()));
  }
  cv::Mat grey, bgr;
  cv::remap(texture, grey, map, cv::noArray(), cv::INTER_CUBIC, cv::BORDER_REFLECT);
  grey.convertTo(grey, CV_8U);
  cv::cvtColor(grey, bgr, cv::COLOR_GRAY2BGR);
  return bgr;
}

std::string Text(cv::FileStorage& storage) { return storage.releaseAndGetString(); }

cv::FileStorage Writer() { return {".yml", cv::FileStorage::WRITE | cv::FileStorage::MEMORY}; }

}  // namespace

std::vector<cv::Point2d> RaysOf(const geometry::CameraCalibration& lens) {
  std::vector<cv::Point2d> pixels, rays;
  for (int y = 0; y < lens.height_px; ++y) {
    for (int x = 0; x < lens.width_px; ++x) pixels.emplace_back(x, y);
  }
  const cv::TermCriteria exact(cv::TermCriteria::COUNT | cv::TermCriteria::EPS, 40, 1e-9);
  cv::undistortPoints(pixels, rays, CameraMatrix(lens), lens.distortion, cv::noArray(),
                      cv::noArray(), exact);
  return rays;
}

geometry::StereoCalibration SyntheticRig() {
  geometry::StereoCalibration rig;
  rig.left = Lens(280.0, 158.0, -0.08);
  rig.right = Lens(283.0, 162.0, -0.07);
  const Eigen::Vector3d axis = Eigen::Vector3d(0.3, 1.0, 0.2).normalized();
  rig.right_from_left.rotation = Eigen::AngleAxisd(2.0 * M_PI / 180.0, axis);
  rig.right_from_left.translation_m = {-0.12, 0.002, 0.001};
  return rig;
}

images::StereoPair Photograph(const geometry::StereoCalibration& rig, const Plane& plane) {
  const cv::Mat texture = Texture();
  images::StereoPair pair;
  pair.left.bgr = See(rig.left, {}, plane, texture);
  pair.right.bgr = See(rig.right, geometry::Inverse(rig.right_from_left), plane, texture);
  return pair;
}

double RectifiedDepth_m(const geometry::StereoCalibration& rectified, const Plane& plane,
                        cv::Size size, cv::Point pixel) {
  const geometry::CameraCalibration& camera = rectified.rectified;
  const Eigen::Vector2d place((pixel.x + 0.5) * camera.width_px / size.width - 0.5,
                              (pixel.y + 0.5) * camera.height_px / size.height - 0.5);
  const Eigen::Vector2d slope = (place - camera.principal_point_px).cwiseQuotient(camera.focal_px);
  const Eigen::Vector3d ray(slope.x(), slope.y(), 1.0);
  return plane.DepthAlong(rectified.left.rectification.transpose() * ray);
}

std::string IntrinsicsText(const geometry::StereoCalibration& rig) {
  cv::FileStorage file = Writer();
  file << "M1" << CameraMatrix(rig.left) << "D1" << cv::Mat(rig.left.distortion).t();
  file << "M2" << CameraMatrix(rig.right) << "D2" << cv::Mat(rig.right.distortion).t();
  return Text(file);
}

std::string ExtrinsicsText(const geometry::StereoCalibration& rig, double unit_m) {
  cv::Mat rotation, translation, r1, r2, p1, p2, q;
  cv::eigen2cv(Eigen::Matrix3d(rig.right_from_left.rotation.toRotationMatrix()), rotation);
  cv::eigen2cv(Eigen::Vector3d(rig.right_from_left.translation_m / unit_m), translation);
  cv::stereoRectify(CameraMatrix(rig.left), rig.left.distortion, CameraMatrix(rig.right),
                    rig.right.distortion, {rig.left.width_px, rig.left.height_px}, rotation,
                    translation, r1, r2, p1, p2, q, cv::CALIB_ZERO_DISPARITY, 1.0);
  cv::FileStorage file = Writer();
  file << "R" << rotation << "T" << translation << "R1" << r1 << "R2" << r2;
  file << "P1" << p1 << "P2" << p2 << "Q" << q;
  return Text(file);
}

Layers SquareBeforeWall() {
  constexpr int kWidth = 320;
  constexpr int kHeight = 240;
  cv::RNG random(3);
  cv::Mat wall(kHeight, kWidth + 64, CV_8UC1), square(kHeight, kWidth + 64, CV_8UC1);
  random.fill(wall, cv::RNG::UNIFORM, 0, 255);
  random.fill(square, cv::RNG::UNIFORM, 0, 255);
  cv::GaussianBlur(wall, wall, {0, 0}, 1.0);
  cv::GaussianBlur(square, square, {0, 0}, 1.0);
  Layers layers;
  layers.left = wall(cv::Rect(0, 0, kWidth, kHeight)).clone();
  layers.right = wall(cv::Rect(layers.wall_px, 0, kWidth, kHeight)).clone();
  const cv::Mat face = square(layers.square);
  face.copyTo(layers.left(layers.square));
  face.copyTo(layers.right(layers.square - cv::Point(layers.square_px, 0)));
  return layers;
}

}  // namespace deixis::stereo_driver
