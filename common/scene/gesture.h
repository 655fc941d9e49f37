#pragma once
#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "common/scene/hand.h"
#include "common/time/timestamp.h"

namespace deixis::scene {

/// An object that a gesture may mean, with its probability among all candidates.
struct Candidate {
  int object_id = -1;
  std::string label;
  double probability = 0.0;
};

/// Where an object is looked for: a circle sector around the hand (Hofemann 2004, Fig. 2).
struct ContextArea {
  Eigen::Vector2d centre_px = Eigen::Vector2d::Zero();
  double radius_px = 0.0;  ///< Search radius c_r.
  double start_rad = 0.0;  ///< From image x towards image y; the sector runs from start to end.
  double end_rad = 0.0;
};

/// What the recogniser thinks of one hand at one image.
struct GestureHypothesis {
  int hand_id = -1;
  int person_id = -1;
  Side side = Side::kUnknown;
  std::string model;             ///< Most probable motion model: "approach", "rest".
  double phase = 0.0;            ///< Mean position within that model, 0..1.
  double end_probability = 0.0;  ///< That `model` is being completed (the paper's p_end).
  std::optional<ContextArea> context;
  std::vector<Candidate> candidates;
  double none_probability = 1.0;  ///< That nothing is pointed at.
};

struct GestureState {
  Timestamp time;
  std::string camera;
  std::string frame;
  std::vector<GestureHypothesis> hypotheses;
};

enum class GestureOutcome { kObject, kNoObject, kAmbiguous };

/// A pointing ray in the gesture's frame, with covariances of origin (m^2) and unit direction.
struct PointingRay {
  std::string frame;
  Eigen::Vector3d origin_m = Eigen::Vector3d::Zero();
  Eigen::Vector3d direction = Eigen::Vector3d::UnitZ();
  Eigen::Matrix3d origin_covariance_m2 = Eigen::Matrix3d::Zero();
  Eigen::Matrix3d direction_covariance = Eigen::Matrix3d::Zero();
};

/// A recognised gesture: one event.
struct Gesture {
  Timestamp time;             ///< Image at which it was decided.
  std::int64_t event_id = 0;  ///< Counts from 1 in a run.
  int person_id = -1;
  int hand_id = -1;
  Side side = Side::kUnknown;
  std::string name;  ///< "pointing".
  Timestamp start;   ///< When the motion began.
  Timestamp end;     ///< When the hold ended; 0 = still open.
  GestureOutcome outcome = GestureOutcome::kNoObject;
  int object_id = -1;  ///< -1 without an object.
  std::string object_label;
  std::vector<Candidate> candidates;  ///< Best first.
  std::optional<PointingRay> ray;
};

}  // namespace deixis::scene
