#pragma once
#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "common/scene/box.h"
#include "common/time/timestamp.h"

namespace deixis::scene {

/// Of the person, not of the image.
enum class Side { kUnknown, kLeft, kRight };

/// How the hand's position in this image came about.
enum class HandState {
  kMeasured,   ///< An own skin region was found.
  kPredicted,  ///< Nothing was found; the filter's prediction.
  kMerged,     ///< It shares a region with another hand or the face.
  kOccluded    ///< Nothing was found for so long that it must be hidden.
};

/// A hand's place and motion in space, in the message's frame.
struct HandPosition {
  Eigen::Vector3d position_m = Eigen::Vector3d::Zero();
  Eigen::Vector3d velocity_m_per_s = Eigen::Vector3d::Zero();
  Eigen::Matrix3d covariance_m2 = Eigen::Matrix3d::Zero();
};

/// One tracked hand.
struct Hand {
  int id = -1;         ///< Kept while the track lives; never used again in a run.
  int person_id = -1;  ///< Whose hand; -1 = unknown.
  Side side = Side::kUnknown;
  double side_probability = 0;  ///< Of `side`; 0 when unknown.
  bool is_acting = false;       ///< The hand that moves with intent; at most one per person.
  HandState state = HandState::kMeasured;
  Eigen::Vector2d centre_px = Eigen::Vector2d::Zero();
  Eigen::Vector2d velocity_px_per_s = Eigen::Vector2d::Zero();
  Eigen::Matrix4d covariance =
      Eigen::Matrix4d::Zero();  ///< Of centre (px^2) and velocity (px^2/s^2).
  Box box;                      ///< Around the hand's region.
  std::optional<Eigen::Vector2d> fingertip_px;
  std::optional<HandPosition> position;  ///< In space, where depth is at hand.
};

/// All hands of one image; an empty list says that none was found.
struct Hands {
  Timestamp time;
  std::string camera;  ///< Image that pixels refer to.
  std::string frame;   ///< Frame of positions; empty when none is given.
  std::vector<Hand> hands;
};

}  // namespace deixis::scene
