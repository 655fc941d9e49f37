// Every plain struct survives its own encoding, with every field different from its default.
#include <gmock/gmock.h>

#include <opencv2/core.hpp>

#include "common/messages/camera_calibration.h"
#include "common/messages/gesture.h"
#include "common/messages/gesture_state.h"
#include "common/messages/hands.h"
#include "common/messages/image.h"
#include "common/messages/objects.h"
#include "common/messages/service_status.h"

namespace deixis::messages {
namespace {

constexpr Timestamp kTime{1'700'000'000'123'456};

template <typename T>
T RoundTrip(const T& value) {
  const auto bytes = Codec<T>::Encode(value, 42);
  const auto [decoded, sequence] = Codec<T>::Decode({bytes.data(), bytes.size()});
  EXPECT_EQ(sequence, 42);
  EXPECT_EQ(Codec<T>::Time(decoded), Codec<T>::Time(value));
  // What was decoded encodes to the same bytes: nothing was lost on the way.
  EXPECT_EQ(Codec<T>::Encode(decoded, 42), bytes);
  return decoded;
}

Eigen::Matrix3d Covariance3(double scale) {
  Eigen::Matrix3d matrix;
  matrix << 3, 1, 0.5, 1, 4, 0.25, 0.5, 0.25, 5;
  return scale * matrix;
}

TEST(RoundTrip, Objects) {
  scene::Object face;
  face.id = 1001;
  face.label = "face";
  face.kind = scene::ObjectKind::kFace;
  face.person_id = 3;
  face.box = scene::Box{1.5, 2.5, 30.0, 40.0};
  face.score = 0.75;
  face.visibility = scene::Visibility::kOccluded;
  face.last_seen = {17};
  scene::Object cup;
  cup.kind = scene::ObjectKind::kPlace;
  cup.position = scene::ObjectPosition{{1, 2, 3}, Covariance3(0.1), {0.1, 0.2, 0.3}};
  const auto decoded =
      RoundTrip(scene::Objects{kTime, "CAMERA", "camera", "object_detector", {face, cup}});
  ASSERT_EQ(decoded.objects.size(), 2u);
  EXPECT_EQ(decoded.camera, "CAMERA");
  EXPECT_EQ(decoded.source, "object_detector");
  EXPECT_EQ(decoded.objects[0].label, "face");
  EXPECT_EQ(decoded.objects[0].kind, scene::ObjectKind::kFace);
  EXPECT_EQ(decoded.objects[0].box->height_px, 40.0);
  EXPECT_EQ(decoded.objects[0].visibility, scene::Visibility::kOccluded);
  EXPECT_FALSE(decoded.objects[0].position);
  EXPECT_FALSE(decoded.objects[1].box);
  EXPECT_EQ(decoded.objects[1].position->covariance_m2, Covariance3(0.1));
}

TEST(RoundTrip, Hands) {
  scene::Hand hand;
  hand.id = 5;
  hand.person_id = 2;
  hand.side = scene::Side::kRight;
  hand.side_probability = 0.9;
  hand.is_acting = true;
  hand.state = scene::HandState::kMerged;
  hand.centre_px = {320.25, 200.5};
  hand.velocity_px_per_s = {-50.0, 20.0};
  hand.covariance = Eigen::Vector4d(1, 2, 3, 4).asDiagonal();
  hand.covariance(2, 0) = hand.covariance(0, 2) = 0.5;
  hand.box = {300, 180, 40, 41};
  hand.fingertip_px = Eigen::Vector2d(310.0, 190.0);
  hand.position = scene::HandPosition{{1, 2, 3}, {4, 5, 6}, Covariance3(1.0)};
  const auto decoded = RoundTrip(scene::Hands{kTime, "CAMERA", "camera", {hand}});
  ASSERT_EQ(decoded.hands.size(), 1u);
  EXPECT_EQ(decoded.hands[0].side, scene::Side::kRight);
  EXPECT_EQ(decoded.hands[0].state, scene::HandState::kMerged);
  EXPECT_TRUE(decoded.hands[0].is_acting);
  EXPECT_EQ(decoded.hands[0].covariance, hand.covariance);
  EXPECT_EQ(*decoded.hands[0].fingertip_px, Eigen::Vector2d(310.0, 190.0));
  EXPECT_EQ(decoded.hands[0].position->velocity_m_per_s, Eigen::Vector3d(4, 5, 6));
}

TEST(RoundTrip, NoHandsAtAll) {
  EXPECT_TRUE(RoundTrip(scene::Hands{kTime, "C", "", {}}).hands.empty());
}

TEST(RoundTrip, GestureState) {
  scene::GestureHypothesis hypothesis;
  hypothesis.hand_id = 5;
  hypothesis.person_id = 1;
  hypothesis.side = scene::Side::kLeft;
  hypothesis.model = "approach";
  hypothesis.phase = 0.8;
  hypothesis.end_probability = 0.4;
  hypothesis.context = scene::ContextArea{{10, 20}, 80.0, -0.5, 0.5};
  hypothesis.candidates = {{1, "cup", 0.6}, {2, "lamp", 0.3}};
  hypothesis.none_probability = 0.1;
  const auto decoded = RoundTrip(scene::GestureState{kTime, "CAMERA", "camera", {hypothesis}});
  ASSERT_EQ(decoded.hypotheses.size(), 1u);
  EXPECT_EQ(decoded.hypotheses[0].context->radius_px, 80.0);
  EXPECT_EQ(decoded.hypotheses[0].candidates[1].label, "lamp");
  EXPECT_EQ(decoded.hypotheses[0].none_probability, 0.1);
}

TEST(RoundTrip, Gesture) {
  scene::Gesture gesture;
  gesture.time = kTime;
  gesture.event_id = 7;
  gesture.person_id = 1;
  gesture.hand_id = 5;
  gesture.side = scene::Side::kLeft;
  gesture.name = "pointing";
  gesture.start = {100};
  gesture.end = {200};
  gesture.outcome = scene::GestureOutcome::kAmbiguous;
  gesture.object_id = 2;
  gesture.object_label = "lamp";
  gesture.candidates = {{2, "lamp", 0.9}};
  gesture.ray =
      scene::PointingRay{"camera", {1, 2, 3}, {0, 0.6, 0.8}, Covariance3(0.1), Covariance3(0.01)};
  const auto decoded = RoundTrip(gesture);
  EXPECT_EQ(decoded.event_id, 7);
  EXPECT_EQ(decoded.outcome, scene::GestureOutcome::kAmbiguous);
  EXPECT_EQ(decoded.end.microseconds, 200);
  EXPECT_EQ(decoded.ray->frame, "camera");
  EXPECT_EQ(decoded.ray->direction_covariance, Covariance3(0.01));
}

TEST(RoundTrip, CameraCalibration) {
  geometry::CameraCalibration calibration = geometry::GuessCalibration(640, 480, 1.0);
  calibration.time = kTime;
  calibration.camera = "CAMERA";
  calibration.distortion_model = geometry::DistortionModel::kPlumbBob;
  calibration.distortion = {0.1, -0.2, 0.001, 0.002, 0.3};
  calibration.rectification << 0, -1, 0, 1, 0, 0, 0, 0, 1;
  calibration.is_calibrated = true;
  const auto decoded = RoundTrip(calibration);
  EXPECT_EQ(decoded.rectification, calibration.rectification);
  EXPECT_EQ(decoded.distortion, calibration.distortion);
  EXPECT_EQ(decoded.distortion_model, geometry::DistortionModel::kPlumbBob);
  EXPECT_TRUE(decoded.is_calibrated);
}

TEST(RoundTrip, ServiceStatus) {
  ServiceStatus status;
  status.time = kTime;
  status.service = "hand_tracker";
  status.instance = "left";
  status.host = "robot";
  status.pid = 99;
  status.version = "1.2.3";
  status.state = ServiceState::kDegraded;
  status.text = "no face";
  status.channels = {{"CAMERA", Direction::kIn, 10, 29.9, 1, 2, {{"malformed", 3}}},
                     {"HAND_TRACKS", Direction::kOut, 9, 28.0, 0, 0, {}}};
  status.processing_ms_p50 = 4.0;
  status.receive_buffer_bytes = 4096;
  const auto decoded = RoundTrip(status);
  EXPECT_EQ(decoded.state, ServiceState::kDegraded);
  EXPECT_EQ(decoded.channels[0].drops.at("malformed"), 3);
  EXPECT_EQ(decoded.channels[1].direction, Direction::kOut);
  EXPECT_EQ(decoded.age_ms_p99, -1.0);
}

// What every receiver would refuse must not go out.
TEST(Encoding, CutsAStatusTextThatGrewTooLong) {
  ServiceStatus status;
  for (int i = 0; i < 700; ++i) status.text += "\u00e9x";
  const auto bytes = Codec<ServiceStatus>::Encode(status, 0);
  const std::string text = Codec<ServiceStatus>::Decode({bytes.data(), bytes.size()}).value.text;
  EXPECT_LE(text.size(), 1024u);
  EXPECT_GT(text.size(), 1000u);
  EXPECT_EQ(text.substr(text.size() - 4), " ...");
}

TEST(RoundTrip, RawImage) {
  images::Image image{kTime, "CAMERA", cv::Mat(3, 5, CV_8UC3)};
  cv::randu(image.bgr, 0, 255);
  const auto decoded = RoundTrip(image);
  EXPECT_EQ(decoded.camera, "CAMERA");
  EXPECT_EQ(cv::norm(decoded.bgr, image.bgr, cv::NORM_INF), 0.0);
}

TEST(RoundTrip, PartOfALargerPicture) {
  cv::Mat whole(10, 10, CV_8UC3);
  cv::randu(whole, 0, 255);
  const images::Image part{kTime, "CAMERA", whole(cv::Rect(2, 3, 4, 5))};
  EXPECT_EQ(cv::norm(RoundTrip(part).bgr, part.bgr, cv::NORM_INF), 0.0);
}

TEST(Encoding, RefusesValuesThatAreNotFinite) {
  scene::Hand hand;
  hand.centre_px.x() = std::nan("");
  EXPECT_THROW(Codec<scene::Hands>::Encode({kTime, "C", "", {hand}}, 0), std::logic_error);
}

}  // namespace
}  // namespace deixis::messages
