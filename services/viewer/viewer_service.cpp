#include "services/viewer/viewer_service.h"

#include <cmath>

#include "common/logging/log.h"
#include "common/messages/body_poses.h"
#include "common/messages/gesture.h"
#include "common/messages/gesture_state.h"
#include "common/messages/hands.h"
#include "common/messages/image.h"
#include "common/messages/objects.h"
#include "common/messages/person_model.h"
#include "common/messages/stereo_calibration.h"
#include "common/transport/channel_name.h"
#include "services/viewer/core/overlay.h"
#include "services/viewer/window.h"

namespace deixis::viewer {

using transport::Delivery;

namespace {
constexpr std::size_t kMostUnwritten = 16;  // Gestures that wait for their picture.
}  // namespace

void ViewerServiceConfig::Validate() const {
  config::Faults faults;
  const auto channel_faults =
      transport::ChannelFaults({{"image_channel", image_channel},
                                {"objects_channel", objects_channel},
                                {"hands_channel", hands_channel},
                                {"state_channel", state_channel},
                                {"gestures_channel", gestures_channel},
                                {"poses_channel", poses_channel},
                                {"models_channel", models_channel},
                                {"calibration_channel", calibration_channel}});
  for (const auto& [key, fault] : channel_faults) faults.Require(false, key, fault);
  faults.Require(latest_period_s >= 0.0, "latest_period_s", "must not be negative");
  faults.Require(stills_period_s >= 0.0, "stills_period_s", "must not be negative");
  faults.Require(film_rate_hz >= 1.0 && film_rate_hz <= 1000.0, "film_rate_hz",
                 "must lie in 1..1000");
  history.Check(faults);
  faults.ThrowIfAny();
}

ViewerService::ViewerService(const ViewerServiceConfig& config, transport::Bus& input,
                             transport::Bus&)
    : config_(config),
      history_(config.history),
      latest_(config.latest_period_s),
      stills_(config.stills_period_s) {
  if (config.window) OpenWindow();
  if (!config.save_folder.empty()) files_.emplace(config.save_folder);
  if (!config.film.empty()) film_.emplace(config.film, config.film_rate_hz);
  if (!config.window && config.save_folder.empty() && config.film.empty()) {
    logging::Warn("nothing_to_show", {{"cure", "set save_folder or film, or window to true"}});
  }
  Collect<images::Image>(input, config.image_channel, film_ ? Delivery::kEvery : Delivery::kLatest);
  Collect<scene::Objects>(input, config.objects_channel, Delivery::kEvery);
  Collect<scene::Hands>(input, config.hands_channel, Delivery::kEvery);
  Collect<scene::GestureState>(input, config.state_channel, Delivery::kEvery);
  Collect<body_model::BodyPoses>(input, config.poses_channel, Delivery::kEvery);
  Collect<body_model::PersonModel>(input, config.models_channel, Delivery::kEvery);
  Collect<geometry::StereoCalibration>(input, config.calibration_channel, Delivery::kEvery);
  input.Subscribe<scene::Gesture>(config.gestures_channel, Delivery::kEvery,
                                  [this](const scene::Gesture& gesture) { OnGesture(gesture); });
}

template <typename Message>
void ViewerService::Collect(transport::Bus& input, const std::string& channel, Delivery delivery) {
  input.Subscribe<Message>(channel, delivery, [this](const Message& message) {
    history_.Add(message);
    WriteGestures();
    ShowWhatIsReady();
  });
}

void ViewerService::OnGesture(const scene::Gesture& gesture) {
  // The same event comes a second time when the gesture ends, which is no news.
  if (gesture.end.microseconds != 0) return;
  history_.Add(gesture);
  if (!files_) return;
  unwritten_.push_back(gesture);
  WriteGestures();
  if (unwritten_.size() <= kMostUnwritten) return;
  GiveUp(unwritten_.front());
  unwritten_.pop_front();
}

/// A gesture may be told before its picture comes, or of a picture that was passed over.
void ViewerService::WriteGestures() {
  for (auto gesture = unwritten_.begin(); gesture != unwritten_.end();) {
    auto scene = history_.From(gesture->time);
    if (!scene && !history_.HasPassed(gesture->time)) {
      ++gesture;
      continue;
    }
    if (!scene) {
      GiveUp(*gesture);
    } else {
      scene->decision = *gesture;
      Save(trouble_, [&] { files_->WriteGesture(*gesture, DrawOverlay(*scene)); });
    }
    gesture = unwritten_.erase(gesture);
  }
}

/// Told in the log once; how many they are stands in the status.
void ViewerService::GiveUp(const scene::Gesture& gesture) {
  if (given_up_++ > 0) return;
  logging::Warn("gesture_without_picture",
                {{"event_id", gesture.event_id},
                 {"utime", gesture.time.microseconds},
                 {"cure", "listen to the pictures that the gestures come from (image_channel)"}});
}

transport::Health ViewerService::health() const {
  std::string lost;
  if (given_up_ > 0) lost = std::to_string(given_up_) + " gestures without a picture";
  transport::Health health{!trouble_.empty() || !film_trouble_.empty(), ""};
  for (const std::string& text : {trouble_, film_trouble_, lost}) {
    if (!health.text.empty() && !text.empty()) health.text += "; ";
    health.text += text;
  }
  return health;
}

void ViewerService::ShowWhatIsReady() {
  const auto scene = history_.Take();
  if (!scene) return;
  const bool is_latest_due = files_ && latest_.IsDue(scene->image.time);
  const bool is_still_due = files_ && stills_.IsDue(scene->image.time);
  if (!config_.window && !film_ && !is_latest_due && !is_still_due) return;
  const cv::Mat picture = DrawOverlay(*scene);
  if (config_.window) ShowInWindow(picture);
  if (film_) Save(film_trouble_, [&] { film_->Add(picture); });
  if (is_latest_due) Save(trouble_, [&] { files_->WriteLatest(picture); });
  if (is_still_due) Save(trouble_, [&] { files_->WriteStill(scene->image.time, picture); });
}

/// Says once, not with every picture, that pictures are lost.
template <typename Write>
void ViewerService::Save(std::string& trouble, Write write) {
  try {
    write();
    trouble.clear();
  } catch (const PictureNotWritten& loss) {
    if (trouble.empty()) logging::Warn("picture_not_written", {{"reason", loss.what()}});
    trouble = loss.what();
  }
}

bool Periodic::IsDue(Timestamp time) {
  if (period_s_ <= 0.0) return false;
  if (last_ && std::abs(SecondsBetween(*last_, time)) < period_s_) return false;
  last_ = time;
  return true;
}

}  // namespace deixis::viewer
