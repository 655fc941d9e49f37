#include "test/support/message_properties.h"

#include <algorithm>
#include <deixis/message_types.hpp>
#include <vector>

#include "common/messages/camera_calibration.h"
#include "common/messages/gesture.h"
#include "common/messages/gesture_state.h"
#include "common/messages/hands.h"
#include "common/messages/image.h"
#include "common/messages/objects.h"
#include "common/messages/service_status.h"
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

template <typename Value>
std::string BrokenCodec(Bytes bytes) {
  Decoded<Value> decoded;
  try {
    decoded = Codec<Value>::Decode(bytes);
  } catch (const messages::Rejected&) {
    return "";
  }
  const auto again =
      Codec<Value>::Encode(decoded.value, std::max(decoded.sequence, std::int64_t{0}));
  Codec<Value>::Decode({again.data(), again.size()});
  return "";
}

template <typename... Values>
std::string FirstBrokenCodec(Bytes bytes) {
  std::string broken;
  ((broken = broken.empty() ? BrokenCodec<Values>(bytes) : broken), ...);
  return broken;
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
  if (!broken.empty()) return broken;
  return FirstBrokenCodec<geometry::CameraCalibration, scene::Gesture, scene::GestureState,
                          scene::Hands, images::EncodedImage, images::Image, scene::Objects,
                          messages::ServiceStatus>(bytes);
}

}  // namespace

std::string BrokenProperty(Bytes bytes) {
  try {
    return FirstBroken(bytes);
  } catch (const std::exception& error) {
    return std::string("throws: ") + error.what();
  }
}

}  // namespace deixis::test
