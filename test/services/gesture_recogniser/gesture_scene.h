#pragma once
#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "common/scene/hand.h"
#include "common/scene/object.h"
#include "services/gesture_recogniser/core/gesture_model.h"
#include "services/gesture_recogniser/core/motion_features.h"

namespace deixis::gesture_recogniser {

constexpr double kTestPxPerM = 250.0;

/// A stroke of 0.6 s with a bell-shaped speed, and a model of rest.
inline std::vector<GestureModel> TestModels() {
  GestureModel approach;
  approach.name = "approach";
  approach.context = ContextNeed::kRequired;
  approach.duration_s = 0.6;
  approach.stroke = {0.1, 1.0, 0.4};
  approach.target = {0.2, 0.03, 0.35, 0.4};
  for (int i = 0; i <= 20; ++i) {
    const double phase = i / 20.0;
    ModelPoint point;
    point.shape = 16.0 * phase * phase * (1.0 - phase) * (1.0 - phase);
    point.shape_spread = 0.15;
    point.speed_m_per_s = point.shape;
    point.speed_spread_m_per_s = 0.25;
    point.turn_spread_rad = 0.8;
    if (phase >= 0.5) {
      point.context_radius_m = 0.9 - 0.6 * phase;
      point.context_start_rad = -0.4;
      point.context_end_rad = 0.4;
    }
    approach.points.push_back(point);
  }
  GestureModel rest;
  rest.name = "rest";
  rest.duration_s = 0.33;
  rest.points.assign(21, {0.03, 0.1, 0.0, 2.0, 0.5, 0.3, 0.0, 0.0, 0.0});
  return {approach, rest};
}

/// Position on a straight minimum-jerk way from `from` to `to` that begins at `start_s`.
inline Eigen::Vector2d OnWay(const Eigen::Vector2d& from, const Eigen::Vector2d& to, double time_s,
                             double start_s, double duration_s = 0.6) {
  const double u = std::clamp((time_s - start_s) / duration_s, 0.0, 1.0);
  return from + (to - from) * (u * u * u * (10.0 - 15.0 * u + 6.0 * u * u));
}

inline Timestamp At(double time_s) {
  return {5'000'000 + static_cast<std::int64_t>(std::llround(1e6 * time_s))};
}

inline scene::Hands HandAt(double time_s, const Eigen::Vector2d& centre_px, int id = 1) {
  scene::Hand hand;
  hand.id = id;
  hand.person_id = 0;
  hand.side = scene::Side::kLeft;
  hand.is_acting = true;
  hand.centre_px = centre_px;
  hand.covariance.diagonal().head<2>().setConstant(1.0);
  scene::Hands hands;
  hands.time = At(time_s);
  hands.camera = "test";
  hands.hands.push_back(hand);
  return hands;
}

inline scene::Object ObjectAt(int id, const Eigen::Vector2d& centre_px) {
  scene::Object object;
  object.id = id;
  object.label = "object_" + std::to_string(id);
  object.box = scene::Box{centre_px.x() - 15.0, centre_px.y() - 15.0, 30.0, 30.0};
  return object;
}

inline scene::Object FaceAt(const Eigen::Vector2d& centre_px) {
  const double side_px = 0.18 * kTestPxPerM;
  scene::Object face = ObjectAt(90, centre_px);
  face.kind = scene::ObjectKind::kFace;
  face.person_id = 0;
  face.box = scene::Box{centre_px.x() - side_px / 2, centre_px.y() - side_px / 2, side_px, side_px};
  return face;
}

/// The hand rests at `rest`, points with a hold at `hold` from 1.5 s to 3.1 s, and returns.
struct PointingScene {
  Eigen::Vector2d rest{350.0, 320.0};
  Eigen::Vector2d hold{430.0, 200.0};
  std::vector<scene::Object> objects{ObjectAt(3, {476.0, 160.0}), ObjectAt(4, {120.0, 180.0}),
                                     FaceAt({300.0, 90.0})};

  Eigen::Vector2d Hand(double time_s) const {
    return time_s < 3.1 ? OnWay(rest, hold, time_s, 1.5) : OnWay(hold, rest, time_s, 3.1);
  }
  scene::Objects Objects(double time_s) const {
    scene::Objects message;
    message.time = At(time_s);
    message.objects = objects;
    return message;
  }
};

}  // namespace deixis::gesture_recogniser
