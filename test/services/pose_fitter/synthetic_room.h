#pragma once
#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <variant>
#include <vector>

#include "common/body_model/tracked_body.h"
#include "services/pose_fitter/core/depth/depth_view.h"

namespace deixis::pose_fitter::test {

/// Upright on `foot_m`; elliptic, of half axes along x and y.
struct Pillar {
  Eigen::Vector3d foot_m;
  double half_x_m, half_y_m, height_m;
};
struct Ball {
  Eigen::Vector3d centre_m;
  double radius_m;
};
struct Box {
  Eigen::Vector3d low_m, high_m;
};

/// A room: x to the right, y ahead, z up from the floor; the camera stands above its origin.
struct Room {
  struct Thing {
    std::variant<Pillar, Ball, Box> shape;
    int owner;  ///< 0 = furniture, else which person.
  };
  double camera_height_m = 1.2;
  double pitch_rad = 0.15;  ///< Downward.
  double roll_rad = 0.0;    ///< To the right.
  double wall_m = 4.5;      ///< Ahead; 0 = none.
  bool has_floor = true;
  std::vector<Thing> things;

  void Add(std::variant<Pillar, Ball, Box> shape, int owner = 0) {
    things.push_back({shape, owner});
  }
  void AddStanding(double x_m, double y_m, int owner, double stature_m = 1.75);
  /// On a chair, whose seat is part of the room.
  void AddSeated(double x_m, double y_m, int owner);
  void AddTable(double x_m, double y_m, double half_x_m, double half_y_m, double height_m);

  body_model::Floor Floor() const;  ///< In the camera's optical frame.
  Eigen::Isometry3d CameraFromRoom() const;
};

/// What a depth camera sees of it.
struct Picture {
  DepthCamera camera;
  cv::Mat depth_mm;
  cv::Mat owner;  ///< CV_8UC1.
};

/// 60 degrees wide; `noise_per_square_m` as DepthNoise has it, of the same seed the same noise.
Picture Look(const Room& room, int width_px = 320, double noise_per_square_m = 0.001,
             std::uint64_t seed = 1);

}  // namespace deixis::pose_fitter::test
