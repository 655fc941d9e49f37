#include "test/support/message_properties.h"

#include <algorithm>
#include <deixis/message_types.hpp>
#include <optional>
#include <vector>

#include "common/messages/body_poses.h"
#include "common/messages/camera_calibration.h"
#include "common/messages/camera_pose.h"
#include "common/messages/depth_image.h"
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
#include "test/support/allocation_count.h"

namespace deixis::test {
namespace {

using messages::Bytes;
using messages::Codec;
using messages::Decoded;

// The largest share: a text of four bytes of length and its NUL becomes a std::string.
constexpr std::size_t kMostMemoryPerByte = 8;

template <typename Message>
std::string BrokenDecode(Bytes bytes) {
  const int size = static_cast<int>(bytes.size);
  Message message{};
  const std::size_t before = AllocatedBytes();
  const int used = message.decode(bytes.data, 0, size);
  const std::size_t memory = AllocatedBytes() - before;
  if (used != size) return "decode does not take all bytes";
  if (memory > kMostMemoryPerByte * bytes.size) return "decode takes too much memory";
  const auto again = messages::EncodeWire(message);
  const bool is_same = std::equal(again.begin(), again.end(), bytes.data, bytes.data + bytes.size);
  return is_same ? "" : "encodes to other bytes";
}

// `Messages` are the types that the codec of Value reads. Whether it takes the message.
template <typename Value, typename... Messages>
bool RequireSoundCodec(Bytes bytes) {
  if (((messages::Fingerprint(bytes) != Messages::getHash()) && ...)) return false;
  std::optional<Decoded<Value>> decoded;
  try {
    decoded = Codec<Value>::Decode(bytes);
  } catch (const messages::Rejected&) {
    return false;
  }
  const auto again =
      Codec<Value>::Encode(decoded->value, std::max(decoded->sequence, std::int64_t{0}));
  Codec<Value>::Decode({again.data(), again.size()});
  return true;
}

/// How many take the message.
int RequireSoundCodecs(Bytes bytes) {
  int takers = 0;
  takers += RequireSoundCodec<body_model::BodyPoses, body_poses_t>(bytes);
  takers +=
      RequireSoundCodec<geometry::CameraCalibration, camera_calibration_t, sensor_msgs::CameraInfo>(
          bytes);
  takers += RequireSoundCodec<geometry::CameraPose, bot_core::rigid_transform_t>(bytes);
  takers += RequireSoundCodec<geometry::FrameTransforms, tf2_msgs::TFMessage>(bytes);
  takers += RequireSoundCodec<images::DepthImage, sensor_msgs::Image>(bytes);
  takers += RequireSoundCodec<scene::Gesture, gesture_t>(bytes);
  takers += RequireSoundCodec<scene::GestureState, gesture_state_t>(bytes);
  takers += RequireSoundCodec<scene::Hands, hand_tracks_t>(bytes);
  takers += RequireSoundCodec<images::EncodedImage, bot_core::image_t>(bytes);
  takers += RequireSoundCodec<images::Image, bot_core::image_t, bot_core::images_t,
                              sensor_msgs::Image, sensor_msgs::CompressedImage>(bytes);
  takers += RequireSoundCodec<scene::Objects, objects_t>(bytes);
  takers += RequireSoundCodec<body_model::PersonModel, body_model_t>(bytes);
  takers += RequireSoundCodec<images::StereoImage, bot_core::images_t>(bytes);
  takers += RequireSoundCodec<images::StereoPair, bot_core::images_t>(bytes);
  takers += RequireSoundCodec<images::EncodedStereoPair, bot_core::images_t>(bytes);
  takers += RequireSoundCodec<images::RgbdImage, kinect::frame_msg_t>(bytes);
  takers += RequireSoundCodec<geometry::StereoCalibration, stereo_calibration_t>(bytes);
  takers += RequireSoundCodec<messages::ServiceStatus, service_status_t>(bytes);
  return takers;
}

std::string FirstBroken(Bytes bytes) {
  std::string broken;
  const bool is_accepted = messages::CheckWire(bytes) == messages::WireFault::kNone;
  deixis::VisitMessageTypes([&](auto type) {
    using Message = typename decltype(type)::type;
    if (is_accepted && messages::Fingerprint(bytes) == Message::getHash()) {
      broken = BrokenDecode<Message>(bytes);
    }
  });
  if (broken.empty() && bytes.size >= sizeof(std::int64_t)) RequireSoundCodecs(bytes);
  return broken;
}

}  // namespace

bool IsUnderstood(Bytes bytes) {
  return messages::CheckWire(bytes) == messages::WireFault::kNone && RequireSoundCodecs(bytes) > 0;
}

std::string BrokenProperty(Bytes bytes) {
  try {
    return FirstBroken(bytes);
  } catch (const std::exception& error) {
    return std::string("throws: ") + error.what();
  }
}

}  // namespace deixis::test
