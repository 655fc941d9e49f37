#include "test/fuzz/hosted_services.h"

#include <cstdlib>
#include <set>

#include "common/config/config.h"
#include "common/program/run_service.h"
#include "services/camera_driver/camera_driver_service.h"
#include "services/gesture_recogniser/gesture_recogniser_service.h"
#include "services/hand_tracker/hand_tracker_service.h"
#include "services/object_detector/object_detector_service.h"
#include "services/pose_fitter/pose_fitter_service.h"
#include "services/stereo_driver/stereo_driver_service.h"
#include "services/viewer/viewer_service.h"
#include "test/fuzz/good_messages.h"
#include "test/services/stereo_driver/synthetic_rig.h"
#include "test/support/memory_bus.h"

namespace deixis::fuzz {

using messages::ServiceStatus;

namespace {

// What asks for all answers; a robot's pictures wait for its lens, depth for that of its camera.
const std::vector<std::string> kAsked{
    "picture_jpeg", "hands",       "stereo_calibration", "kinect", "stereo_pair", "dimos_info",
    "dimos_colour", "dimos_depth", "stereo_calibration", "stereo"};
const std::vector<std::string> kAnswers{"OBJECTS",         "HAND_TRACKS",     "GESTURE_STATE",
                                        "STEREO",          "STEREO_OF_PAIRS", "STEREO_OF_DIMOS",
                                        "CAMERA_OF_DIMOS", "BODY_POSES"};

}  // namespace

class HostedServices::Host {
 public:
  virtual ~Host() = default;
  virtual void Step() = 0;  ///< What the service does between messages.
};

template <typename Service, typename Config>
void HostedServices::Add(const std::string& file, const std::vector<std::string>& overrides) {
  struct Holder final : Host {
    Holder(const Config& config, transport::Bus& bus)
        : service(config, bus, bus), hosted(program::HostedBy(service)) {}
    void Step() override {
      if (hosted.step) hosted.step();
    }
    Service service;
    program::Hosted hosted;
  };
  const auto config = config::Load<Config>(config::FindConfig(file), overrides);
  hosts_.push_back(std::make_unique<Holder>(config, bus_));
}

HostedServices::HostedServices() : bus_(test::Memory()) {
  setenv("DEIXIS_CONFIG_DIR", DEIXIS_SOURCE_DIR "/config", 1);
  Add<object_detector::ObjectDetectorService, object_detector::ObjectDetectorServiceConfig>(
      "object_detector.yaml");
  Add<hand_tracker::HandTrackerService, hand_tracker::HandTrackerServiceConfig>(
      "hand_tracker.yaml");
  Add<gesture_recogniser::GestureRecogniserService,
      gesture_recogniser::GestureRecogniserServiceConfig>("gesture_recogniser.yaml");
  Add<viewer::ViewerService, viewer::ViewerServiceConfig>(
      "viewer.yaml", {"save_folder=" + folder_.path().string(), "latest_period_s=0.1"});
  Add<stereo_driver::StereoDriverService, stereo_driver::StereoDriverServiceConfig>(
      "stereo_driver.yaml", {"source.kind=kinect_channel"});
  NoteNewChannels();
  AddDrivers();
  bus_.Subscribe<ServiceStatus>(transport::kStatusChannel, transport::Delivery::kEvery,
                                [this](const ServiceStatus&) { ++statuses_; });
}

HostedServices::~HostedServices() = default;

void HostedServices::AddDrivers() {
  const geometry::StereoCalibration rig = stereo_driver::SyntheticRig();
  const std::string in = folder_.Write("in.yml", stereo_driver::IntrinsicsText(rig)).string();
  const std::string ex = folder_.Write("ex.yml", stereo_driver::ExtrinsicsText(rig)).string();
  Add<camera_driver::CameraDriverService, camera_driver::CameraDriverServiceConfig>(
      "camera_driver.yaml",
      {"source.kind=dimos", "image_channel=CAMERA_OF_DIMOS",
       "calibration.mount.parent_frame=base_link", "dimos.camera_frame=camera"});
  NoteNewChannels();
  Add<stereo_driver::StereoDriverService, stereo_driver::StereoDriverServiceConfig>(
      "stereo_driver.yaml", {"source.kind=dimos", "stereo_channel=STEREO_OF_DIMOS"});
  Add<stereo_driver::StereoDriverService, stereo_driver::StereoDriverServiceConfig>(
      "stereo_driver.yaml", {"source.kind=pair_channel", "stereo_channel=STEREO_OF_PAIRS",
                             "calibration.intrinsics=" + in, "calibration.extrinsics=" + ex});
  NoteNewChannels();
  Add<pose_fitter::PoseFitterService, pose_fitter::PoseFitterServiceConfig>("pose_fitter.yaml");
  NoteNewChannels();
}

// Inputs of the corpus name channels by their place: new ones go to the end.
void HostedServices::NoteNewChannels() {
  std::set<std::string> heard;
  for (const auto& channel : bus_.statistics()) heard.insert(channel.channel);
  for (const std::string& known : channels_) heard.erase(known);
  channels_.insert(channels_.end(), heard.begin(), heard.end());
}

void HostedServices::Send(const std::string& channel, messages::Bytes bytes) {
  bus_.PublishRaw(channel, bytes, {0});
  HandleAll();
}

void HostedServices::HandleAll() {
  test::HandleAll(bus_);
  for (const auto& host : hosts_) host->Step();
  test::HandleAll(bus_);
}

void HostedServices::SendGood(const std::string& name) {
  for (const GoodMessage& message : GoodMessages(time_us_)) {
    if (message.name == name) Send(message.channel, {message.bytes.data(), message.bytes.size()});
  }
}

std::map<std::string, std::int64_t> HostedServices::Published() const {
  std::map<std::string, std::int64_t> published;
  for (const auto& channel : bus_.statistics()) {
    if (channel.direction == messages::Direction::kOut) {
      published[channel.channel] += channel.messages;
    }
  }
  return published;
}

std::string HostedServices::FirstSilent(std::int64_t step_us) {
  auto before = Published();
  time_us_ += step_us;
  for (const std::string& name : kAsked) SendGood(name);
  auto after = Published();
  for (const std::string& answer : kAnswers) {
    if (after[answer] == before[answer]) return answer;
  }
  return "";
}

std::string HostedServices::Complaint() {
  std::string silent = FirstSilent(33'333);
  // What came before may have been later by less than a clock that jumps.
  if (!silent.empty()) silent = FirstSilent(2'000'000);
  if (!silent.empty()) return "nothing is published on " + silent;
  for (const auto& channel : bus_.statistics()) {
    for (const char* reason : {"handler_failed", "malformed"}) {
      if (channel.drops.count(reason) != 0) return channel.channel + ": " + reason;
    }
  }
  const int statuses = statuses_;
  transport::StatusReporter({"fuzz", ""}, bus_, bus_)
      .Report(messages::ServiceState::kRunning, "under fire");
  HandleAll();
  return statuses_ == statuses + 1 ? "" : "the status does not go out";
}

}  // namespace deixis::fuzz
