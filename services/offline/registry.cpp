#include "services/offline/registry.h"

#include <functional>
#include <set>
#include <utility>

#include "common/config/config.h"
#include "services/gesture_recogniser/gesture_recogniser_service.h"
#include "services/hand_tracker/hand_tracker_service.h"
#include "services/object_detector/object_detector_service.h"
#include "services/pose_fitter/pose_fitter_service.h"
#include "services/stereo_driver/stereo_driver_service.h"

namespace deixis::offline {
namespace {

using gesture_recogniser::GestureRecogniserService;
using gesture_recogniser::GestureRecogniserServiceConfig;
using hand_tracker::HandTrackerService;
using hand_tracker::HandTrackerServiceConfig;
using object_detector::ObjectDetectorService;
using object_detector::ObjectDetectorServiceConfig;
using pose_fitter::PoseFitterService;
using pose_fitter::PoseFitterServiceConfig;
using stereo_driver::StereoDriverService;
using stereo_driver::StereoDriverServiceConfig;

template <typename Service, typename Config>
class Hosted final : public HostedService {
 public:
  using Channels = std::vector<std::string> (*)(const Config&);
  Hosted(const Config& config, Channels channels, transport::Bus& bus)
      : channels_(channels(config)), service_(config, bus, bus) {}
  std::vector<std::string> OutputChannels() const override { return channels_; }

 private:
  std::vector<std::string> channels_;
  Service service_;
};

using Maker = std::function<std::unique_ptr<HostedService>(
    const std::string& file, const std::vector<std::string>& overrides, transport::Bus& bus)>;

/// Sets what a service has to do otherwise when its input is a log.
template <typename Config>
void SuitLog(Config&) {}

// Cameras are not there: pairs come from the log, unless frames of a depth camera do.
void SuitLog(StereoDriverServiceConfig& config) {
  auto& kind = config.driver.source.kind;
  if (!stereo_driver::ComesFromBus(kind)) kind = stereo_driver::FrameSourceKind::kPairChannel;
  config.publishes_pairs = false;
}

template <typename Service, typename Config>
Maker MakerOf(typename Hosted<Service, Config>::Channels channels) {
  return [channels](const std::string& file, const std::vector<std::string>& overrides,
                    transport::Bus& bus) {
    auto config = config::Load<Config>(config::FindConfig(file), overrides);
    SuitLog(config);
    return std::make_unique<Hosted<Service, Config>>(config, channels, bus);
  };
}

enum class Hosting { kByDefault, kWhenNamed };

struct Entry {
  std::string name;
  Maker make;
  Hosting hosting = Hosting::kByDefault;
};

const std::vector<Entry>& Entries() {
  static const std::vector<Entry> entries{
      {"object_detector", MakerOf<ObjectDetectorService, ObjectDetectorServiceConfig>(
                              [](const ObjectDetectorServiceConfig& config) {
                                return std::vector<std::string>{config.objects_channel};
                              })},
      {"hand_tracker", MakerOf<HandTrackerService, HandTrackerServiceConfig>(
                           [](const HandTrackerServiceConfig& config) {
                             return std::vector<std::string>{config.hands_channel};
                           })},
      {"gesture_recogniser",
       MakerOf<GestureRecogniserService, GestureRecogniserServiceConfig>(
           [](const GestureRecogniserServiceConfig& config) {
             return std::vector<std::string>{config.state_channel, config.gestures_channel};
           })},
      {"stereo_driver",
       MakerOf<StereoDriverService, StereoDriverServiceConfig>(
           [](const StereoDriverServiceConfig& config) {
             return std::vector<std::string>{config.calibration_channel, config.stereo_channel};
           }),
       Hosting::kWhenNamed},
      {"pose_fitter",
       MakerOf<PoseFitterService, PoseFitterServiceConfig>(
           [](const PoseFitterServiceConfig& config) {
             return std::vector<std::string>{config.model_channel, config.poses_channel};
           }),
       Hosting::kWhenNamed},
  };
  return entries;
}

}  // namespace

std::vector<std::string> KnownServices() {
  std::vector<std::string> names;
  for (const Entry& entry : Entries()) names.push_back(entry.name);
  return names;
}

std::vector<std::string> DefaultServices() {
  std::vector<std::string> names;
  for (const Entry& entry : Entries()) {
    if (entry.hosting == Hosting::kByDefault) names.push_back(entry.name);
  }
  return names;
}

std::unique_ptr<HostedService> MakeService(const std::string& name,
                                           const Configuration& configuration,
                                           transport::Bus& bus) {
  std::string known;
  for (const Entry& entry : Entries()) {
    known += (known.empty() ? "" : ", ") + entry.name;
    if (entry.name != name) continue;
    const auto file = configuration.files.find(name);
    const auto overrides = configuration.overrides.find(name);
    return entry.make(
        file == configuration.files.end() ? name + ".yaml" : file->second,
        overrides == configuration.overrides.end() ? std::vector<std::string>{} : overrides->second,
        bus);
  }
  throw config::ConfigError("service '" + name + "' cannot be hosted; known are: " + known);
}

}  // namespace deixis::offline
