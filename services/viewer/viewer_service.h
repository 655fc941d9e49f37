#pragma once
#include <cstdint>
#include <deque>
#include <optional>
#include <string>

#include "common/transport/bus.h"
#include "common/transport/status_reporter.h"
#include "services/viewer/core/scene_history.h"
#include "services/viewer/picture_files.h"

namespace deixis::viewer {

struct ViewerServiceConfig {
  std::string image_channel = "CAMERA";         ///< Pictures to draw on (in, like all of these).
  std::string objects_channel = "OBJECTS";      ///< Objects and faces.
  std::string hands_channel = "HAND_TRACKS";    ///< Hand tracks.
  std::string state_channel = "GESTURE_STATE";  ///< What is thought of each hand.
  std::string gestures_channel = "GESTURES";    ///< Decisions.
  std::string save_folder;                      ///< Pictures are written here; empty = none.
  double latest_period_s = 1.0;                 ///< How often latest.png is written; 0 = never.
  bool window = false;                          ///< Shows the pictures in a window.
  SceneHistoryConfig history;                   ///< How pictures and results are put together.

  template <typename Visitor>
  void Visit(Visitor& v) {
    v("image_channel", image_channel);
    v("objects_channel", objects_channel);
    v("hands_channel", hands_channel);
    v("state_channel", state_channel);
    v("gestures_channel", gestures_channel);
    v("save_folder", save_folder);
    v("latest_period_s", latest_period_s);
    v("window", window);
    v("history", history);
  }
  void Validate() const;
};

/// Draws on the camera's pictures what the other services make of them.
class ViewerService {
 public:
  /// Throws ConfigError when there is no display for the window or no folder for the pictures.
  ViewerService(const ViewerServiceConfig& config, transport::Bus& input, transport::Bus& output);

  /// Degraded while pictures cannot be written; says how many gestures went without theirs.
  transport::Health health() const;

 private:
  template <typename Message>
  void Collect(transport::Bus& input, const std::string& channel, transport::Delivery delivery);
  void OnGesture(const scene::Gesture& gesture);
  void WriteGestures();
  void GiveUp(const scene::Gesture& gesture);
  void ShowWhatIsReady();
  bool IsLatestDue(Timestamp time) const;
  template <typename Write>
  void Save(Write write);

  ViewerServiceConfig config_;
  SceneHistory history_;
  std::optional<PictureFiles> files_;
  std::deque<scene::Gesture> unwritten_;  ///< Their pictures have not come yet.
  std::int64_t given_up_ = 0;             ///< Gestures whose picture did not come.
  std::optional<Timestamp> latest_written_;
  std::string trouble_;  ///< Why the last picture could not be written; empty = it was.
};

}  // namespace deixis::viewer
