// The shipped files are the parameter manual: each loads, and states every key with its default.
#include <gmock/gmock.h>

#include <map>
#include <sstream>

#include "common/config/config.h"
#include "services/camera_driver/camera_driver_service.h"
#include "services/gesture_recogniser/gesture_recogniser_service.h"
#include "services/hand_tracker/hand_tracker_service.h"
#include "services/object_detector/object_detector_service.h"
#include "services/pose_fitter/pose_fitter_service.h"
#include "services/stereo_driver/stereo_driver_service.h"
#include "services/viewer/viewer_service.h"

namespace deixis {
namespace {

/// Collects every field of a configuration, nested ones too, as key and value.
class Values {
 public:
  template <typename T>
  void operator()(const char* name, T& field) {
    const std::string outer = key_;
    key_ += (key_.empty() ? "" : ".") + std::string(name);
    Take(field);
    key_ = outer;
  }
  const std::map<std::string, std::string>& all() const { return all_; }

 private:
  template <typename T>
  void Take(T& field) {
    if constexpr (std::is_enum_v<T>) {
      all_[key_] = std::to_string(static_cast<int>(field));
    } else if constexpr (std::is_arithmetic_v<T> || std::is_same_v<T, std::string>) {
      std::ostringstream text;
      text.precision(9);  // Files do not write out 1/15.
      text << field;
      all_[key_] = text.str();
    } else {
      field.Visit(*this);
    }
  }
  template <typename T>
  void Take(std::vector<T>& list) {
    all_[key_] = std::to_string(list.size()) + " elements";
    for (std::size_t i = 0; i < list.size(); ++i) {
      (*this)(std::to_string(i).c_str(), list[i]);
    }
  }

  std::string key_;
  std::map<std::string, std::string> all_;
};

template <typename Config>
std::map<std::string, std::string> ValuesOf(Config config) {
  Values values;
  config.Visit(values);
  return values.all();
}

template <typename Config>
void ExpectDefaults(const std::string& name) {
  const auto path = std::filesystem::path(DEIXIS_SOURCE_DIR) / "config" / name;
  const auto shipped = ValuesOf(config::Load<Config>(path, {}, config::Completeness::kEveryKey));
  const auto defaults = ValuesOf(Config{});
  ASSERT_GT(shipped.size(), 2U);
  for (const auto& [key, value] : shipped) {
    ASSERT_EQ(defaults.count(key), 1U) << key;
    EXPECT_EQ(value, defaults.at(key)) << key;
  }
  EXPECT_EQ(shipped.size(), defaults.size());
}

TEST(ShippedConfig, StereoDriver) {
  ExpectDefaults<stereo_driver::StereoDriverServiceConfig>("stereo_driver.yaml");
}

TEST(ShippedConfig, CameraDriver) {
  ExpectDefaults<camera_driver::CameraDriverServiceConfig>("camera_driver.yaml");
}
TEST(ShippedConfig, ObjectDetector) {
  ExpectDefaults<object_detector::ObjectDetectorServiceConfig>("object_detector.yaml");
}
TEST(ShippedConfig, HandTracker) {
  ExpectDefaults<hand_tracker::HandTrackerServiceConfig>("hand_tracker.yaml");
}
TEST(ShippedConfig, GestureRecogniser) {
  ExpectDefaults<gesture_recogniser::GestureRecogniserServiceConfig>("gesture_recogniser.yaml");
}
TEST(ShippedConfig, PoseFitter) {
  ExpectDefaults<pose_fitter::PoseFitterServiceConfig>("pose_fitter.yaml");
}
TEST(ShippedConfig, Viewer) { ExpectDefaults<viewer::ViewerServiceConfig>("viewer.yaml"); }

}  // namespace
}  // namespace deixis
