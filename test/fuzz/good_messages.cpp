#include "test/fuzz/good_messages.h"

#include <bot_core/images_t.hpp>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <sensor_msgs/CameraInfo.hpp>
#include <sensor_msgs/CompressedImage.hpp>
#include <sensor_msgs/Image.hpp>

#include "common/messages/body_poses.h"
#include "common/messages/camera_calibration.h"
#include "common/messages/camera_pose.h"
#include "common/messages/frame_transforms.h"
#include "common/messages/gesture.h"
#include "common/messages/gesture_state.h"
#include "common/messages/hands.h"
#include "common/messages/image.h"
#include "common/messages/objects.h"
#include "common/messages/person_model.h"
#include "common/messages/rgbd_image.h"
#include "common/messages/service_status.h"
#include "common/messages/stereo_calibration.h"
#include "common/messages/stereo_image.h"
#include "common/messages/stereo_pair.h"
#include "common/messages/wire.h"

namespace deixis::fuzz {
namespace {

using bot_core::image_t;
using bot_core::images_t;
using messages::Codec;

constexpr int kWidth_px = 32;
constexpr int kHeight_px = 24;
constexpr const char* kColour = "/color_image#sensor_msgs.Image";
constexpr const char* kDepth = "/depth_image#sensor_msgs.Image";
constexpr const char* kInfo = "/camera_info#sensor_msgs.CameraInfo";

template <typename T>
GoodMessage Of(const std::string& name, const std::string& channel, const T& value) {
  return {name, channel, Codec<T>::Encode(value, 0)};
}

cv::Mat Picture() {
  cv::Mat bgr(kHeight_px, kWidth_px, CV_8UC3, cv::Scalar(60, 90, 40));
  bgr(cv::Rect(10, 8, 8, 8)) = cv::Scalar(120, 150, 210);  // skin
  return bgr;
}

std::vector<std::uint8_t> Jpeg() {
  std::vector<std::uint8_t> jpeg;
  cv::imencode(".jpg", Picture(), jpeg, {cv::IMWRITE_JPEG_QUALITY, 60});
  return jpeg;
}

image_t Raw(std::int32_t format, int bytes_per_pixel, std::int64_t utime_us) {
  image_t message{};
  message.utime = utime_us;
  message.width = kWidth_px;
  message.height = kHeight_px;
  message.row_stride = kWidth_px * bytes_per_pixel;
  message.pixelformat = format;
  message.data.assign(static_cast<std::size_t>(message.row_stride) * kHeight_px, 100);
  message.size = static_cast<std::int32_t>(message.data.size());
  return message;
}

image_t JpegMessage(std::int64_t utime_us) {
  image_t message = Raw(image_t::PIXEL_FORMAT_MJPEG, 3, utime_us);
  message.data = Jpeg();
  message.size = static_cast<std::int32_t>(message.data.size());
  return message;
}

images_t Stereo(std::int64_t utime_us) {
  images_t message{};
  message.utime = utime_us;
  message.image_types = {images_t::LEFT, images_t::DEPTH_MM};
  message.images = {JpegMessage(utime_us), Raw(image_t::PIXEL_FORMAT_INVALID, 2, utime_us)};
  message.n_images = 2;
  return message;
}

scene::Objects Things(Timestamp time) {
  scene::Object face;
  face.id = 1;
  face.label = "face";
  face.kind = scene::ObjectKind::kFace;
  face.person_id = 1;
  face.box = scene::Box{8, 2, 10, 10};
  face.score = 0.9;
  face.last_seen = time;
  scene::Object cup = face;
  cup.id = 2;
  cup.label = "cup";
  cup.kind = scene::ObjectKind::kObject;
  cup.position = scene::ObjectPosition{{0.1, 0.2, 1.5}, Eigen::Matrix3d::Identity() * 0.01, {}};
  cup.position->extent_m.setConstant(0.1);
  return {time, "CAMERA", "camera", "object_detector", {face, cup}};
}

scene::Hands OneHand(Timestamp time) {
  scene::Hand hand;
  hand.id = 5;
  hand.person_id = 1;
  hand.side = scene::Side::kRight;
  hand.side_probability = 0.9;
  hand.is_acting = true;
  hand.centre_px = {14, 12};
  hand.covariance = Eigen::Vector4d(1, 1, 9, 9).asDiagonal();
  hand.box = {10, 8, 8, 8};
  hand.fingertip_px = Eigen::Vector2d(10, 12);
  return {time, "CAMERA", "", {hand}};
}

scene::GestureState State(Timestamp time) {
  scene::GestureHypothesis hypothesis;
  hypothesis.hand_id = 5;
  hypothesis.model = "approach";
  hypothesis.phase = 0.8;
  hypothesis.end_probability = 0.4;
  hypothesis.context = scene::ContextArea{{10, 12}, 8.0, -0.5, 0.5};
  hypothesis.candidates = {{2, "cup", 0.6}};
  hypothesis.none_probability = 0.4;
  return {time, "CAMERA", "", {hypothesis}};
}

scene::Gesture Pointing(Timestamp time) {
  scene::Gesture gesture;
  gesture.time = gesture.start = time;
  gesture.event_id = 1;
  gesture.hand_id = 5;
  gesture.name = "pointing";
  gesture.outcome = scene::GestureOutcome::kObject;
  gesture.object_id = 2;
  gesture.object_label = "cup";
  gesture.candidates = {{2, "cup", 0.9}};
  gesture.ray = scene::PointingRay{"camera", {0, 0, 1}, {0, 0.6, 0.8}, {}, {}};
  gesture.ray->origin_covariance_m2.setIdentity();
  gesture.ray->direction_covariance.setIdentity();
  return gesture;
}

geometry::CameraCalibration Lens(Timestamp time) {
  auto calibration = geometry::GuessCalibration(kWidth_px, kHeight_px, 1.0);
  calibration.time = time;
  calibration.camera = "CAMERA";
  calibration.distortion_model = geometry::DistortionModel::kPlumbBob;
  calibration.distortion = {0.1, -0.2, 0.001, 0.002, 0.3};
  return calibration;
}

cv::Mat Depth() { return {kHeight_px, kWidth_px, CV_16UC1, cv::Scalar(1500)}; }

images::EncodedImage Encoded(Timestamp time) {
  return {time, "STEREO", kWidth_px, kHeight_px, Jpeg()};
}

images::RgbdImage Rgbd(Timestamp time) {
  return {{time, "kinect", Picture()}, {time, "kinect", Depth()}};
}

geometry::StereoCalibration Rig(Timestamp time) {
  geometry::StereoCalibration rig;
  rig.time = time;
  rig.camera = "STEREO";
  rig.left = rig.right = rig.rectified = Lens(time);
  rig.right_from_left.translation_m.x() = -0.12;
  rig.disparity_sigma_px = 0.2;
  return rig;
}

std_msgs::Header RobotHeader(std::int64_t utime_us) {
  std_msgs::Header header{};
  header.stamp.sec = static_cast<std::int32_t>(utime_us / 1'000'000);
  header.stamp.nsec = static_cast<std::int32_t>(utime_us % 1'000'000 * 1000);
  header.frame_id = "camera";
  return header;
}

sensor_msgs::Image RobotPicture(const std::string& encoding, std::vector<std::uint8_t> data,
                                int row_bytes, std::int64_t utime_us) {
  sensor_msgs::Image message{};
  message.header = RobotHeader(utime_us);
  message.width = kWidth_px;
  message.height = kHeight_px;
  message.encoding = encoding;
  message.step = row_bytes;
  message.data = std::move(data);
  message.data_length = static_cast<std::int32_t>(message.data.size());
  return message;
}

sensor_msgs::Image RobotRaw(const std::string& encoding, int bytes_per_pixel,
                            std::int64_t utime_us) {
  const int row_bytes = kWidth_px * bytes_per_pixel;
  const auto bytes = static_cast<std::size_t>(row_bytes) * kHeight_px;
  return RobotPicture(encoding, std::vector<std::uint8_t>(bytes, 62), row_bytes, utime_us);
}

sensor_msgs::CompressedImage RobotJpeg(std::int64_t utime_us) {
  sensor_msgs::CompressedImage message{};
  message.header = RobotHeader(utime_us);
  message.format = "jpeg";
  message.data = Jpeg();
  message.data_length = static_cast<std::int32_t>(message.data.size());
  return message;
}

sensor_msgs::CameraInfo RobotLens(std::int64_t utime_us) {
  sensor_msgs::CameraInfo message{};
  message.header = RobotHeader(utime_us);
  message.width = kWidth_px;
  message.height = kHeight_px;
  message.distortion_model = "plumb_bob";
  message.D = {0.1, -0.2, 0.001, 0.002, 0.3};
  message.D_length = static_cast<std::int32_t>(message.D.size());
  message.K[0] = message.K[4] = 30.0;
  message.K[2] = 0.5 * (kWidth_px - 1);
  message.K[5] = 0.5 * (kHeight_px - 1);
  message.K[8] = 1.0;
  return message;
}

geometry::FrameTransforms Head(Timestamp time) {
  return {{time, "base_link", "neck", {Eigen::Quaterniond::Identity(), {0.0, 0.0, 1.0}}},
          {time, "neck", "camera", {Eigen::Quaterniond(0.5, -0.5, 0.5, -0.5), {0.1, 0.0, 0.0}}}};
}

// Trunk and an arm that turns by two swings and a twist.
body_model::BodyModel TrunkAndArm() {
  using body_model::DofKind;
  body_model::Limb trunk;
  trunk.name = "trunk";
  trunk.shape = {0.1, 0.15, 0.1, 0.15, 0.5};
  body_model::Limb arm = trunk;
  arm.name = "arm";
  arm.parent = 0;
  arm.rest_in_parent = {Eigen::Quaterniond(0.0, 1.0, 0.0, 0.0), {0.0, -0.2, 0.5}};
  arm.dofs = {{"flexion", DofKind::kSwing, Eigen::Vector3d::UnitY(), -1.0, 3.0, 20.0, 500.0},
              {"abduction", DofKind::kSwing, Eigen::Vector3d::UnitX(), -1.0, 3.0},
              {"rotation", DofKind::kTwist, Eigen::Vector3d::UnitZ(), -1.5, 1.5}};
  return {"sample", {trunk, arm}};
}

body_model::PersonModel Somebody(Timestamp time) {
  body_model::PersonModel person{time, TrunkAndArm()};
  person.person_id = 1;
  person.sex = anthropometry::Sex::kFemale;
  person.female_probability = 0.8;
  person.stature_m = 1.7;
  person.stature_variance_m2 = 0.0025;
  return person;
}

body_model::BodyPoses Standing(Timestamp time) {
  const body_model::BodyModel model = TrunkAndArm();
  body_model::TrackedBody body;
  body.person_id = 1;
  body.state = body_model::BodyState::kTracked;
  body.pose = RestPose(model);
  body.pose.frame_from_root.translation_m.z() = 2.0;
  body.rates_rad_per_s = Eigen::VectorXd::Zero(model.angle_count());
  body.covariance = 0.01 * Eigen::MatrixXd::Identity(9, 9);
  body_model::Kinematics kinematics(model);
  PlaceLimbs(kinematics, body);
  return {time,  "STEREO", "camera", "pose_fitter", body_model::Floor{{0.0, -1.0, 0.0}, 1.0},
          {body}};
}

messages::ServiceStatus Status(Timestamp time) {
  messages::ServiceStatus status;
  status.time = time;
  status.service = "hand_tracker";
  status.channels.resize(1);
  status.channels[0].channel = "CAMERA";
  status.channels[0].drops["truncated"] = 3;
  return status;
}

}  // namespace

std::vector<GoodMessage> GoodMessages(std::int64_t utime_us) {
  const Timestamp time{utime_us};
  const auto raw = [utime_us](std::int32_t format, int bytes_per_pixel) {
    return messages::EncodeWire(Raw(format, bytes_per_pixel, utime_us));
  };
  return {
      Of("calibration", "CAMERA_CALIBRATION", Lens(time)),
      Of("objects", "OBJECTS", Things(time)),
      {"picture_jpeg", "CAMERA", messages::EncodeWire(JpegMessage(utime_us))},
      {"picture_grey", "CAMERA", raw(image_t::PIXEL_FORMAT_GRAY, 1)},
      {"picture_yuyv", "CAMERA", raw(image_t::PIXEL_FORMAT_YUYV, 2)},
      {"picture_bgr", "CAMERA", raw(image_t::PIXEL_FORMAT_BGR, 3)},
      {"picture_rgb", "CAMERA", raw(image_t::PIXEL_FORMAT_RGB, 3)},
      {"picture_stereo", "CAMERA", messages::EncodeWire(Stereo(utime_us))},
      Of("stereo", "STEREO", images::StereoImage{Encoded(time), Depth()}),
      Of("stereo_pair", "STEREO_PAIR", images::EncodedStereoPair{Encoded(time), Encoded(time)}),
      Of("stereo_calibration", "STEREO_CALIBRATION", Rig(time)),
      Of("camera_pose", "CAMERA_POSE", geometry::CameraPose{time, Head(time)[1].parent_from_child}),
      Of("transforms", "/tf#tf2_msgs.TFMessage", Head(time)),
      Of("kinect", "KINECT_FRAME", Rgbd(time)),
      {"dimos_info", kInfo, messages::EncodeWire(RobotLens(utime_us))},
      {"dimos_jpeg", kColour, messages::EncodeWire(RobotPicture("jpeg", Jpeg(), 0, utime_us))},
      {"dimos_compressed", kColour, messages::EncodeWire(RobotJpeg(utime_us))},
      {"dimos_yuyv", kColour, messages::EncodeWire(RobotRaw("yuv422_yuy2", 2, utime_us))},
      {"dimos_colour", kColour, messages::EncodeWire(RobotRaw("rgb8", 3, utime_us))},
      {"dimos_depth_m", kDepth, messages::EncodeWire(RobotRaw("32FC1", 4, utime_us))},
      {"dimos_depth", kDepth, messages::EncodeWire(RobotRaw("16UC1", 2, utime_us))},
      Of("body_model", "BODY_MODEL", Somebody(time)),
      Of("body_poses", "BODY_POSES", Standing(time)),
      Of("hands", "HAND_TRACKS", OneHand(time)),
      Of("gesture_state", "GESTURE_STATE", State(time)),
      Of("gesture", "GESTURES", Pointing(time)),
      Of("status", "SERVICE_STATUS", Status(time)),
  };
}

}  // namespace deixis::fuzz
