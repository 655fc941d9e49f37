#include "test/services/pose_fitter/synthetic_room.h"

#include <Eigen/Geometry>
#include <cmath>
#include <limits>

#include "common/filtering/random.h"

namespace deixis::pose_fitter::test {
namespace {

constexpr double kNone = std::numeric_limits<double>::infinity();
constexpr double kFarthest_m = 60.0;  // What 16 bits of millimetres hold.

struct Ray {
  Eigen::Vector3d from, along;
};

/// Smallest positive solution of a t^2 + 2 b t + c = 0.
double FirstRoot(double a, double b, double c) {
  const double inside = b * b - a * c;
  if (inside < 0.0) return kNone;
  const double t = (-b - std::sqrt(inside)) / a;
  return t > 0.0 ? t : kNone;
}

double Hit(const Ray& ray, const Ball& ball) {
  const Eigen::Vector3d from = ray.from - ball.centre_m;
  return FirstRoot(ray.along.squaredNorm(), from.dot(ray.along),
                   from.squaredNorm() - ball.radius_m * ball.radius_m);
}

double Hit(const Ray& ray, const Box& box) {
  double enter = 0.0, leave = kNone;
  for (int i = 0; i < 3; ++i) {
    const double a = (box.low_m[i] - ray.from[i]) / ray.along[i];
    const double b = (box.high_m[i] - ray.from[i]) / ray.along[i];
    enter = std::max(enter, std::min(a, b));
    leave = std::min(leave, std::max(a, b));
  }
  return enter > 0.0 && enter < leave ? enter : kNone;
}

double Hit(const Ray& ray, const Pillar& pillar) {
  const Eigen::Array2d half(pillar.half_x_m, pillar.half_y_m);
  const Eigen::Array2d from = (ray.from - pillar.foot_m).head<2>().array() / half;
  const Eigen::Array2d along = ray.along.head<2>().array() / half;
  const double t = FirstRoot(along.square().sum(), (from * along).sum(), from.square().sum() - 1.0);
  const double z = ray.from.z() + t * ray.along.z() - pillar.foot_m.z();
  if (t < kNone && z >= 0.0 && z <= pillar.height_m) return t;
  // Its top, seen from above.
  const double top = (pillar.foot_m.z() + pillar.height_m - ray.from.z()) / ray.along.z();
  const bool is_inside = (from + top * along).square().sum() < 1.0;
  return top > 0.0 && is_inside && ray.along.z() < 0.0 ? top : kNone;
}

Eigen::Matrix3d RotationOf(const Room& room) {
  Eigen::Matrix3d level;
  level << 1, 0, 0, 0, 0, -1, 0, 1, 0;
  const Eigen::AngleAxisd pitch(room.pitch_rad, Eigen::Vector3d::UnitX());
  const Eigen::AngleAxisd roll(room.roll_rad, Eigen::Vector3d::UnitZ());
  return roll * pitch * level;
}

struct Seen {
  double distance;
  int owner;
};

Seen FirstSeen(const Room& room, const Ray& ray) {
  Seen seen = {kNone, 0};
  const auto look_at = [&seen](double distance, int owner) {
    if (distance > 0.0 && distance < seen.distance) seen = {distance, owner};
  };
  if (room.has_floor) look_at(-ray.from.z() / ray.along.z(), 0);
  if (room.wall_m > 0.0) look_at((room.wall_m - ray.from.y()) / ray.along.y(), 0);
  for (const Room::Thing& thing : room.things) {
    look_at(std::visit([&ray](const auto& shape) { return Hit(ray, shape); }, thing.shape),
            thing.owner);
  }
  return seen;
}

}  // namespace

void Room::AddStanding(double x_m, double y_m, int owner, double stature_m) {
  const double s = stature_m / 1.75;
  for (const double side : {-1.0, 1.0}) {
    Add(Pillar{{x_m + side * 0.1 * s, y_m, 0.0}, 0.075 * s, 0.08 * s, 0.85 * s}, owner);
    Add(Pillar{{x_m + side * 0.1 * s, y_m - 0.08 * s, 0.0}, 0.05 * s, 0.12 * s, 0.09 * s}, owner);
    Add(Pillar{{x_m + side * 0.22 * s, y_m, 0.8 * s}, 0.045 * s, 0.05 * s, 0.62 * s}, owner);
  }
  Add(Pillar{{x_m, y_m, 0.8 * s}, 0.18 * s, 0.11 * s, 0.65 * s}, owner);
  Add(Pillar{{x_m, y_m, 1.4 * s}, 0.055 * s, 0.055 * s, 0.2 * s}, owner);
  Add(Ball{{x_m, y_m, 1.64 * s}, 0.105 * s}, owner);
}

void Room::AddSeated(double x_m, double y_m, int owner) {
  Add(Box{{x_m - 0.22, y_m - 0.25, 0.40}, {x_m + 0.22, y_m + 0.2, 0.44}});
  Add(Box{{x_m - 0.22, y_m + 0.2, 0.40}, {x_m + 0.22, y_m + 0.23, 0.85}});
  for (const double side : {-1.0, 1.0}) {
    Add(Pillar{{x_m + side * 0.1, y_m - 0.45, 0.0}, 0.06, 0.065, 0.5}, owner);
    for (int i = 0; i < 6; ++i) {  // The thigh, as a row of balls.
      Add(Ball{{x_m + side * 0.1, y_m - 0.42 + 0.07 * i, 0.51}, 0.075}, owner);
    }
    Add(Pillar{{x_m + side * 0.22, y_m + 0.03, 0.6}, 0.045, 0.05, 0.45}, owner);
  }
  Add(Pillar{{x_m, y_m + 0.05, 0.44}, 0.18, 0.11, 0.62}, owner);
  Add(Pillar{{x_m, y_m + 0.05, 1.0}, 0.055, 0.055, 0.2}, owner);
  Add(Ball{{x_m, y_m + 0.05, 1.24}, 0.105}, owner);
}

void Room::AddTable(double x_m, double y_m, double half_x_m, double half_y_m, double height_m) {
  const Eigen::Vector2d half(half_x_m, half_y_m);
  const Eigen::Vector2d centre(x_m, y_m);
  Box top{{0, 0, height_m - 0.03}, {0, 0, height_m}};
  top.low_m.head<2>() = centre - half;
  top.high_m.head<2>() = centre + half;
  Add(top);
  for (const double sx : {-1.0, 1.0}) {
    for (const double sy : {-1.0, 1.0}) {
      const Eigen::Vector2d foot = centre + 0.9 * half.cwiseProduct(Eigen::Vector2d(sx, sy));
      Add(Pillar{{foot.x(), foot.y(), 0.0}, 0.025, 0.025, height_m - 0.03});
    }
  }
}

body_model::Floor Room::Floor() const { return {RotationOf(*this).col(2), camera_height_m}; }

Eigen::Isometry3d Room::CameraFromRoom() const {
  const Eigen::Isometry3d camera_from_upright(RotationOf(*this));
  return camera_from_upright * Eigen::Translation3d(0.0, 0.0, -camera_height_m);
}

Picture Look(const Room& room, int width_px, double noise_per_square_m, std::uint64_t seed) {
  Picture picture;
  const int height_px = std::max(1, width_px * 3 / 4);
  const double focal_px = 0.5 * width_px / std::tan(M_PI / 6.0);
  picture.camera = {width_px,
                    height_px,
                    {focal_px, focal_px},
                    {0.5 * (width_px - 1), 0.5 * (height_px - 1)},
                    {0.001, noise_per_square_m}};
  picture.depth_mm = cv::Mat(height_px, width_px, CV_16UC1, cv::Scalar(0));
  picture.owner = cv::Mat(height_px, width_px, CV_8UC1, cv::Scalar(0));
  const Eigen::Matrix3d room_from_camera = RotationOf(room).transpose();
  const filtering::CounterRandom random(seed, 2);
  std::uint64_t pixel = 0;
  for (int v = 0; v < height_px; ++v) {
    for (int u = 0; u < width_px; ++u, ++pixel) {
      const Ray ray = {{0.0, 0.0, room.camera_height_m},
                       room_from_camera * picture.camera.Ray(u, v)};
      const Seen seen = FirstSeen(room, ray);
      if (seen.distance > kFarthest_m) continue;
      // Along a ray with z = 1, the distance is the depth.
      const double noise_m =
          picture.camera.noise.Sigma_m(seen.distance) * static_cast<double>(random.Normal(pixel));
      picture.depth_mm.at<std::uint16_t>(v, u) =
          cv::saturate_cast<std::uint16_t>(1000.0 * (seen.distance + noise_m));
      picture.owner.at<std::uint8_t>(v, u) = static_cast<std::uint8_t>(seen.owner);
    }
  }
  return picture;
}

}  // namespace deixis::pose_fitter::test
