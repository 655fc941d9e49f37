#pragma once
#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "common/config/config.h"
#include "common/scene/gesture.h"
#include "common/scene/hand.h"
#include "common/scene/object.h"
#include "services/gesture_recogniser/core/condensation.h"
#include "services/gesture_recogniser/core/gesture_model.h"
#include "services/gesture_recogniser/core/image_scale.h"
#include "services/gesture_recogniser/core/motion_features.h"
#include "services/gesture_recogniser/core/segmental.h"

namespace deixis::gesture_recogniser {

/// How hands are judged.
enum class Method { kSegmental, kAsPrinted };
inline auto EnumNames(Method) {
  return std::vector<std::pair<std::string, Method>>{{"segmental", Method::kSegmental},
                                                     {"as_printed", Method::kAsPrinted}};
}

/// Which hands are judged.
enum class HandChoice { kAll, kActing };
inline auto EnumNames(HandChoice) {
  return std::vector<std::pair<std::string, HandChoice>>{{"all", HandChoice::kAll},
                                                         {"acting", HandChoice::kActing}};
}

struct PointingRecogniserConfig {
  Method method = Method::kSegmental;
  HandChoice hands = HandChoice::kAll;
  double objects_memory_s = 10.0;  ///< How long objects count that are no longer reported.
  double longest_gap_s = 1.0;      ///< A longer gap between messages starts everything anew.
  double rejoin_speed_m_per_s =
      5.0;  ///< A new track may go on with a lost one at up to this speed.
  MotionConfig motion;
  ImageScaleConfig scale;
  SegmentalConfig segmental;
  CondensationConfig as_printed;

  template <typename Visitor>
  void Visit(Visitor& v) {
    v("method", method);
    v("hands", hands);
    v("objects_memory_s", objects_memory_s);
    v("longest_gap_s", longest_gap_s);
    v("rejoin_speed_m_per_s", rejoin_speed_m_per_s);
    v("motion", motion);
    v("scale", scale);
    v("segmental", segmental);
    v("as_printed", as_printed);
  }
  void Validate() const;
};

/// What came out of one image.
struct Recognition {
  scene::GestureState state;
  std::vector<scene::Gesture> gestures;  ///< Begun or ended with this image.
};

/// Recognises pointing gestures of all hands and the objects that they mean.
class PointingRecogniser {
 public:
  /// Throws ConfigError when the method can do nothing with these models.
  PointingRecogniser(const PointingRecogniserConfig& config,
                     const std::vector<GestureModel>& models);

  void SetFocalLength(double focal_px) { scale_.SetFocalLength(focal_px); }
  void ObserveObjects(const scene::Objects& objects);
  Recognition ObserveHands(const scene::Hands& hands);

  /// True once objects have been reported.
  bool knows_objects() const { return has_objects_; }
  std::size_t remembered_objects() const { return objects_.size(); }

 private:
  struct TrackedHand {
    TrackedHand(const MotionConfig& motion_config, std::unique_ptr<HandRecogniser> judge)
        : history(motion_config), recogniser(std::move(judge)) {}
    MotionHistory history;
    std::unique_ptr<HandRecogniser> recogniser;
    Timestamp last_seen;
    int person_id = -1;
    std::optional<scene::Gesture> open;  // Whose hold goes on.
    Eigen::Vector2d held_px = Eigen::Vector2d::Zero();
  };

  void ForgetIfTimeJumps(Timestamp now, Recognition& result);
  void ForgetLostHands(const scene::Hands& hands, Recognition& result);
  TrackedHand& Track(const scene::Hand& hand, const scene::Hands& hands, double px_per_m);
  void Rejoin(const scene::Hand& hand, const scene::Hands& hands, double px_per_m);
  void Judge(const scene::Hand& hand, const scene::Hands& hands, Recognition& result);
  void Surround(const scene::Hand& hand, Timestamp now, double px_per_m);
  scene::GestureHypothesis Hypothesis(const scene::Hand& hand, const Assessment& assessment,
                                      double px_per_m) const;
  std::vector<scene::Candidate> Candidates(const Assessment& assessment) const;
  scene::Gesture Begin(const scene::Hand& hand, Timestamp now, const Assessment& assessment);
  void End(TrackedHand& track, Timestamp now, Recognition& result) const;

  PointingRecogniserConfig config_;
  std::vector<GestureModel> models_;
  ImageScale scale_;
  std::map<int, scene::Object> objects_;
  bool has_objects_ = false;
  std::map<int, TrackedHand> hands_;
  Surroundings surroundings_;
  Timestamp last_time_;
  bool has_time_ = false;
  int events_ = 0;
};

}  // namespace deixis::gesture_recogniser
