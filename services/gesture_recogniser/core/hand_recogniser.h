#pragma once
#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "common/scene/box.h"
#include "common/scene/gesture.h"
#include "common/scene/hand.h"
#include "services/gesture_recogniser/core/motion_features.h"

namespace deixis::gesture_recogniser {

/// An object that may be pointed at, in metres in the image plane at the person's distance (the
/// box's fields, too, hold metres here).
struct Target {
  int id = -1;
  std::string label;
  scene::Box box_m;
};

/// What surrounds a hand.
struct Surroundings {
  std::vector<Target> targets;
  std::optional<scene::Box> face_m;  ///< The person's own face.
};

/// A context area in metres (Hofemann 2004, Fig. 2); angles from image x towards image y.
struct Area {
  Eigen::Vector2d centre_m = Eigen::Vector2d::Zero();
  double radius_m = 0.0;
  double start_rad = 0.0;
  double end_rad = 0.0;
};

/// A gesture that has just been recognised.
struct Decision {
  scene::GestureOutcome outcome = scene::GestureOutcome::kNoObject;
  int target = -1;         ///< Index into Surroundings::targets; -1 without an object.
  double started_s = 0.0;  ///< How long ago the motion began.
};

/// What is thought of a hand after an image.
struct Assessment {
  std::string model;             ///< Most probable motion model.
  double phase = 0.0;            ///< Mean position in that model, 0..1.
  double end_probability = 0.0;  ///< p_end of the most probable model with a context.
  std::optional<Area> context;
  std::vector<double> target_probability;  ///< One per target.
  double none_probability = 1.0;
  std::optional<Decision> decision;
};

/// Recognises gestures of one hand.
class HandRecogniser {
 public:
  virtual ~HandRecogniser() = default;
  /// Takes in the motion up to a new image. `motion.elapsed_s` = 0 says that it begins anew.
  virtual const Assessment& Observe(const Motion& motion, const Surroundings& surroundings,
                                    scene::Side side) = 0;
};

}  // namespace deixis::gesture_recogniser
