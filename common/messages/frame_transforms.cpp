#include "common/messages/frame_transforms.h"

#include <tf2_msgs/TFMessage.hpp>
#include <utility>

#include "common/messages/dimos_parts.h"
#include "common/messages/geometry_parts.h"

namespace deixis::messages {
namespace {

using geometry::FrameTransform;
using geometry::FrameTransforms;
using geometry_msgs::TransformStamped;

constexpr std::int32_t kMostTransforms = 1024;

const std::string& FrameName(const std::string& name) {
  if (name.empty()) throw Rejected("out_of_range");
  return Text(name);
}

FrameTransform ToFrameTransform(const TransformStamped& message) {
  const auto& [translation, rotation] = message.transform;
  const double translation_m[3] = {translation.x, translation.y, translation.z};
  const double rotation_wxyz[4] = {rotation.w, rotation.x, rotation.y, rotation.z};
  FrameTransform transform;
  transform.time = ToTimestamp(message.header.stamp);
  transform.parent = FrameName(message.header.frame_id);
  transform.child = FrameName(message.child_frame_id);
  if (transform.parent == transform.child) throw Rejected("out_of_range");
  transform.parent_from_child = ToTransform(translation_m, rotation_wxyz);
  return transform;
}

TransformStamped FromFrameTransform(const FrameTransform& transform) {
  double translation_m[3];
  double rotation_wxyz[4];
  FromTransform(transform.parent_from_child, translation_m, rotation_wxyz);
  TransformStamped message{};
  message.header = ToHeader(transform.time, transform.parent);
  message.child_frame_id = transform.child;
  message.transform.translation.x = translation_m[0];
  message.transform.translation.y = translation_m[1];
  message.transform.translation.z = translation_m[2];
  message.transform.rotation.w = rotation_wxyz[0];
  message.transform.rotation.x = rotation_wxyz[1];
  message.transform.rotation.y = rotation_wxyz[2];
  message.transform.rotation.z = rotation_wxyz[3];
  return message;
}

}  // namespace

Decoded<FrameTransforms> Codec<FrameTransforms>::Decode(Bytes bytes) {
  const auto message = DecodeWire<tf2_msgs::TFMessage>(bytes);
  RequireCount(message.transforms_length, kMostTransforms);
  FrameTransforms transforms;
  transforms.reserve(message.transforms.size());
  for (const auto& transform : message.transforms) {
    transforms.push_back(ToFrameTransform(transform));
  }
  return {std::move(transforms), -1};
}

std::vector<std::uint8_t> Codec<FrameTransforms>::Encode(const FrameTransforms& transforms,
                                                         std::int64_t) {
  tf2_msgs::TFMessage message{};
  for (const FrameTransform& transform : transforms) {
    message.transforms.push_back(FromFrameTransform(transform));
  }
  message.transforms_length = static_cast<std::int32_t>(message.transforms.size());
  return EncodeWire(message);
}

}  // namespace deixis::messages
