#pragma once
#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "common/scene/box.h"
#include "common/time/timestamp.h"

namespace deixis::scene {

enum class ObjectKind { kFace, kObject, kMarker, kPlace };
enum class Visibility { kSeen, kOccluded, kRemembered };

/// A position in the message's frame with its uncertainty.
struct ObjectPosition {
  Eigen::Vector3d position_m = Eigen::Vector3d::Zero();
  Eigen::Matrix3d covariance_m2 = Eigen::Matrix3d::Zero();
  Eigen::Vector3d extent_m =
      Eigen::Vector3d::Zero();  ///< Full size along the frame's axes; 0 = unknown.
};

/// Something that can be pointed at, or a face.
struct Object {
  int id = -1;        ///< Unique within the source, kept while tracked.
  std::string label;  ///< What it is: "cup", "face".
  ObjectKind kind = ObjectKind::kObject;
  int person_id = -1;                      ///< Whose face; -1 = nobody's or unknown.
  std::optional<Box> box;                  ///< Where in the image.
  std::optional<ObjectPosition> position;  ///< Where in space, if known.
  double score = 0.0;                      ///< Detector's confidence, 0..1; 1 for a fixed place.
  Visibility visibility = Visibility::kSeen;
  Timestamp last_seen;  ///< Capture time of the last image that showed it.
};

/// Everything that one detector knows of at one time.
struct Objects {
  Timestamp time;
  std::string camera;  ///< Image that boxes refer to.
  std::string frame;   ///< Frame of positions; empty when none is given.
  std::string source;  ///< Which detector says so.
  std::vector<Object> objects;
};

}  // namespace deixis::scene
