#pragma once
#include <cstdint>
#include <deque>
#include <optional>
#include <string>

#include "common/transport/bus.h"
#include "common/transport/status_reporter.h"
#include "services/viewer/core/scene_history.h"
#include "services/viewer/film.h"
#include "services/viewer/picture_files.h"

namespace deixis::viewer {

struct ViewerServiceConfig {
  std::string image_channel = "CAMERA";         ///< Pictures to draw on (in, like all of these).
  std::string objects_channel = "OBJECTS";      ///< Objects and faces.
  std::string hands_channel = "HAND_TRACKS";    ///< Hand tracks.
  std::string state_channel = "GESTURE_STATE";  ///< What is thought of each hand.
  std::string gestures_channel = "GESTURES";    ///< Decisions.
  std::string poses_channel = "BODY_POSES";     ///< People's limbs; seen with depth only.
  std::string models_channel = "BODY_MODEL";    ///< Shapes of their limbs.
  std::string calibration_channel = "STEREO_CALIBRATION";  ///< By which limbs are seen.
  std::string save_folder;       ///< Pictures are written here; empty = none.
  double latest_period_s = 1.0;  ///< How often latest.png is written; 0 = never.
  double stills_period_s = 0.0;  ///< How often a picture is kept; 0 = never.
  std::string film;              ///< All pictures in one file, MP4; empty = none.
  double film_rate_hz = 30.0;    ///< Pictures per second when it is played.
  bool window = false;           ///< Shows the pictures in a window.
  SceneHistoryConfig history;    ///< How pictures and results are put together.

  template <typename Visitor>
  void Visit(Visitor& v) {
    v("image_channel", image_channel);
    v("objects_channel", objects_channel);
    v("hands_channel", hands_channel);
    v("state_channel", state_channel);
    v("gestures_channel", gestures_channel);
    v("poses_channel", poses_channel);
    v("models_channel", models_channel);
    v("calibration_channel", calibration_channel);
    v("save_folder", save_folder);
    v("latest_period_s", latest_period_s);
    v("stills_period_s", stills_period_s);
    v("film", film);
    v("film_rate_hz", film_rate_hz);
    v("window", window);
    v("history", history);
  }
  void Validate() const;
};

/// Whether it is time again, by the times of pictures.
class Periodic {
 public:
  explicit Periodic(double period_s) : period_s_(period_s) {}  ///< 0 = never.
  /// True at the first time, and when a period has passed since it was last true, to or fro.
  bool IsDue(Timestamp time);

 private:
  double period_s_;
  std::optional<Timestamp> last_;
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
  template <typename Write>
  void Save(std::string& trouble, Write write);

  ViewerServiceConfig config_;
  SceneHistory history_;
  std::optional<PictureFiles> files_;
  std::deque<scene::Gesture> unwritten_;  ///< Their pictures have not come yet.
  std::int64_t given_up_ = 0;             ///< Gestures whose picture did not come.
  std::optional<Film> film_;
  Periodic latest_;
  Periodic stills_;
  std::string trouble_;       ///< Why the last picture could not be written; empty = it was.
  std::string film_trouble_;  ///< The same of the film.
};

}  // namespace deixis::viewer
