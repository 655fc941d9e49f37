#pragma once
#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "common/messages/codec.h"
#include "common/messages/service_status.h"

namespace deixis::transport {

/// The bus cannot be opened or written. The message says why and what to do.
class BusError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// What a subscriber wants of a channel whose messages come faster than it works.
enum class Delivery {
  kEvery,  ///< All of them, in order: tracks, poses, events.
  kLatest  ///< Only the newest: pictures. What is passed over is counted as skipped. A handler that
           ///< was held up for a moment, and is quick, handles the few that wait.
};

/// Stands in statistics for what cannot be told by channel; no channel has such a name.
inline constexpr const char* kAllChannels = "*";

struct BusOptions {
  std::string url;                             ///< Empty: $LCM_DEFAULT_URL, else LCM's own default.
  std::string channel_prefix;                  ///< Set in front of every channel name.
  int receive_buffer_bytes = 4 * 1024 * 1024;  ///< Wanted of the kernel unless the URL says so.
  int queue_capacity = 500;                    ///< Messages that may wait per channel (kEvery).
  int latest_queue_capacity = 30;              ///< The same for kLatest, whose messages are large.
  bool deliver_every_message = false;          ///< Offline: kLatest behaves as kEvery.
};

/// An undecoded message, valid during the call that hands it over.
struct RawMessage {
  std::string channel;  ///< As on the wire, prefix included.
  messages::Bytes bytes;
  std::int64_t received_us = 0;  ///< When it arrived.
};

/// Percentiles over the last 512 values, in milliseconds; -1 when there are none.
struct Percentiles {
  double p50 = -1.0;
  double p99 = -1.0;
};

/// One connection to LCM: the only code that touches it. Not for use from several threads.
///
/// URLs: udpm://, tcpq://, memq:// (private to this object: services in one process share it),
/// file:// (a log is read as liblcm paces it; with `?mode=w` one is written, its event times being
/// the messages' own, so that the same messages give the same bytes).
///
/// Subscribers get plain structs. What does not decode, or makes no sense, is dropped and counted
/// by reason; so is what a handler refuses by throwing messages::Rejected. Any other exception that
/// leaves a handler is counted ("handler_failed") and logged, and goes no further, since LCM would
/// abort. Gaps in a publisher's sequence numbers are counted, and two
/// publishers on one channel noticed (see publisher_sequences.h). What waits is bounded by the
/// queues' capacities, and one Handle() by a fifth of a second, however much is sent.
class Bus {
 public:
  explicit Bus(const BusOptions& options);  ///< Throws BusError.
  ~Bus();
  Bus(const Bus&) = delete;
  Bus& operator=(const Bus&) = delete;

  /// Calls `handler(const T&)` from Handle() for every accepted message of `channel`. Throws
  /// BusError when that, behind the prefix, is no channel name (see channel_name.h), as Publish
  /// does.
  template <typename T, typename Handler>
  void Subscribe(const std::string& channel, Delivery delivery, Handler handler) {
    SubscribeBytes(Prefixed(channel), delivery, ReceiverFor<T>(std::move(handler)));
  }

  /// The same for a channel of another system: its name stands as it is, without the prefix.
  template <typename T, typename Handler>
  void SubscribeForeign(const std::string& wire_channel, Delivery delivery, Handler handler) {
    SubscribeBytes(wire_channel, delivery, ReceiverFor<T>(std::move(handler)));
  }

  /// Calls `handler` for every message whose wire channel matches the regular expression
  /// `channels`.
  void SubscribeRaw(const std::string& channels, std::function<void(const RawMessage&)> handler);

  template <typename T>
  void Publish(const std::string& channel, const T& value) {
    PublishBytes(channel, messages::Codec<T>::Encode(value, NextSequence(channel)),
                 messages::Codec<T>::Time(value));
    if constexpr (!std::is_same_v<T, messages::ServiceStatus>) {
      NoteAge(messages::Codec<T>::Time(value));
    }
  }
  void PublishRaw(const std::string& wire_channel, messages::Bytes bytes, Timestamp time);

  /// Waits up to `timeout` for a message, then handles what is there. Returns how many messages
  /// arrived. Throws BusError when the connection is lost.
  int Handle(std::chrono::milliseconds timeout);

  /// Writes out what is buffered (a log being written). Throws BusError when the disk is full.
  void Flush();

  bool is_exhausted() const;  ///< A log that is being read has come to its end.
  bool is_live() const;       ///< Other processes listen: udpm or tcpq.
  bool can_receive() const;   ///< Not a log that is being written: Subscribe would throw.
  /// Since the start. Datagrams that the kernel dropped since its buffer was full cannot be told by
  /// channel: they stand under kAllChannels as "kernel_buffer_full", when there are any.
  std::vector<messages::ChannelStatistics> statistics() const;
  Percentiles processing_ms() const;  ///< Decoding and handling, per message.
  Percentiles age_ms() const;         ///< Capture to publication, of published messages; live only.
  int receive_buffer_bytes() const;   ///< Granted by the kernel; 0 without a socket.
  /// What is wrong with the channels, as one line with its cure; empty when nothing is: that two
  /// publishers send on one, or that its times have just jumped.
  std::string trouble() const;
  const std::string& url() const;

 private:
  /// What the messages of a channel's one publisher are followed by.
  struct Stamp {
    std::int64_t sequence = -1;  ///< -1: it carries none.
    Timestamp time;
  };
  /// Nothing is followed where many publish by right.
  using Accept = std::function<void(const std::optional<Stamp>& stamp)>;
  using Receiver = std::function<void(messages::Bytes, const Accept&)>;

  template <typename T, typename Handler>
  static Receiver ReceiverFor(Handler handler) {
    return [handler = std::move(handler)](messages::Bytes bytes, const Accept& accept) {
      const auto message = messages::Codec<T>::Decode(bytes);
      if constexpr (std::is_same_v<T, messages::ServiceStatus>) {
        accept(std::nullopt);  // Every service speaks there, each by its own clock.
      } else {
        accept(Stamp{message.sequence, messages::Codec<T>::Time(message.value)});
      }
      handler(message.value);
    };
  }
  std::string Prefixed(const std::string& channel) const;
  void SubscribeBytes(const std::string& wire_channel, Delivery delivery, Receiver receiver);
  void PublishBytes(const std::string& channel, const std::vector<std::uint8_t>& bytes,
                    Timestamp time);
  void NoteAge(Timestamp time);
  std::int64_t NextSequence(const std::string& channel);

  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace deixis::transport
