#pragma once
#include <deque>
#include <optional>
#include <vector>

#include "common/body_model/tracked_body.h"
#include "common/config/config.h"
#include "common/geometry/stereo_calibration.h"
#include "common/images/image.h"
#include "common/scene/gesture.h"
#include "common/scene/hand.h"
#include "common/scene/object.h"

namespace deixis::viewer {

/// A picture with what is known of it.
struct Scene {
  images::Image image;
  std::optional<scene::Objects> objects;
  std::optional<scene::Hands> hands;
  std::optional<scene::GestureState> state;
  std::optional<scene::Gesture> decision;             ///< The last one, while it is still news.
  std::optional<body_model::BodyPoses> bodies;        ///< Of this picture's camera only.
  std::vector<body_model::PersonModel> models;        ///< Those of `bodies` that are known.
  std::optional<geometry::CameraCalibration> camera;  ///< By which `bodies` are seen here.
};

struct SceneHistoryConfig {
  double max_delay_s = 0.3;  ///< A picture waits this long for its results.
  double max_age_s = 0.5;    ///< Older results are not drawn on a picture that has none itself.
  double decision_shown_s = 2.5;  ///< How long a decision stays in the picture.
  int max_images = 15;            ///< Pictures that are kept.

  template <typename Visitor>
  void Visit(Visitor& v) {
    v("max_delay_s", max_delay_s);
    v("max_age_s", max_age_s);
    v("decision_shown_s", decision_shown_s);
    v("max_images", max_images);
  }
  void Check(config::Faults& faults) const;
};

/// Puts pictures and the results that came from them together again: a result belongs to the
/// picture of the same time. Services that pass over pictures answer only some of them; then the
/// newest result from before is taken. A picture from before the last one begins everything anew, a
/// result from before the last of its kind begins its kind anew.
class SceneHistory {
 public:
  explicit SceneHistory(const SceneHistoryConfig& config) : config_(config) {}

  void Add(images::Image image);
  void Add(scene::Objects objects);
  void Add(scene::Hands hands);
  void Add(scene::GestureState state);
  void Add(scene::Gesture gesture);
  void Add(body_model::BodyPoses bodies);
  void Add(body_model::PersonModel model);
  void Add(geometry::StereoCalibration calibration);

  /// The newest picture not yet taken whose results are there, or that has waited long enough.
  std::optional<Scene> Take();
  /// The first picture that is kept of `time` or after; nothing when there is none yet, or the
  /// picture of that time has gone.
  std::optional<Scene> From(Timestamp time) const;
  /// Whether From(time) will give none any more, if it gives none now: what comes next is too late.
  bool HasPassed(Timestamp time) const;

 private:
  template <typename Result>
  using Results = std::deque<Result>;

  bool IsComplete(const images::Image& image) const;
  Scene Compose(const images::Image& image) const;
  void ComposeBodies(Scene& scene) const;
  void Clear();

  SceneHistoryConfig config_;
  std::deque<images::Image> images_;  ///< Oldest first, like all of these.
  Results<scene::Objects> objects_;
  Results<scene::Hands> hands_;
  Results<scene::GestureState> states_;
  Results<body_model::BodyPoses> bodies_;
  std::optional<scene::Gesture> decision_;
  std::deque<body_model::PersonModel> models_;              ///< Hold whatever the time is.
  std::optional<geometry::StereoCalibration> calibration_;  ///< The same.
  std::optional<Timestamp> taken_;
};

}  // namespace deixis::viewer
