// The shipped files are the parameter manual: each loads, and states every key with its default.
#include <gtest/gtest.h>

#include "common/config/config.h"
#include "services/camera_driver/camera_driver_service.h"
#include "services/gesture_recogniser/gesture_recogniser_service.h"
#include "services/hand_tracker/hand_tracker_service.h"
#include "services/object_detector/object_detector_service.h"
#include "services/viewer/viewer_service.h"

namespace deixis {
namespace {

template <typename Config>
Config LoadShipped(const std::string& name) {
  const auto path = std::filesystem::path(DEIXIS_SOURCE_DIR) / "config" / name;
  return config::Load<Config>(path, {}, config::Completeness::kEveryKey);
}

TEST(ShippedConfig, CameraDriver) {
  EXPECT_NO_THROW(LoadShipped<camera_driver::CameraDriverServiceConfig>("camera_driver.yaml"));
}
TEST(ShippedConfig, ObjectDetector) {
  EXPECT_NO_THROW(
      LoadShipped<object_detector::ObjectDetectorServiceConfig>("object_detector.yaml"));
}
TEST(ShippedConfig, HandTracker) {
  EXPECT_NO_THROW(LoadShipped<hand_tracker::HandTrackerServiceConfig>("hand_tracker.yaml"));
}
TEST(ShippedConfig, GestureRecogniser) {
  EXPECT_NO_THROW(
      LoadShipped<gesture_recogniser::GestureRecogniserServiceConfig>("gesture_recogniser.yaml"));
}
TEST(ShippedConfig, Viewer) {
  EXPECT_NO_THROW(LoadShipped<viewer::ViewerServiceConfig>("viewer.yaml"));
}

}  // namespace
}  // namespace deixis
