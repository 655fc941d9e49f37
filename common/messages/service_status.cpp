#include "common/messages/service_status.h"

#include <deixis/service_status_t.hpp>

#include "common/messages/wire.h"

namespace deixis::messages {
namespace {

ChannelStatistics ToChannel(const channel_status_t& message) {
  RequireCount(message.n_drops, kMostReasons);
  ChannelStatistics channel;
  channel.channel = Text(message.name);
  channel.direction = Enumeration(message.direction, Direction::kOut);
  channel.messages = Count(message.messages);
  channel.rate_hz = Finite(message.rate_hz);
  channel.gaps = Count(message.gaps);
  channel.skipped = Count(message.skipped);
  for (const drop_count_t& drop : message.drops)
    channel.drops[Text(drop.reason)] = Count(drop.count);
  return channel;
}

channel_status_t FromChannel(const ChannelStatistics& channel) {
  channel_status_t message{};
  message.name = channel.channel;
  message.direction = Number(channel.direction);
  message.messages = channel.messages;
  message.rate_hz = Outgoing(channel.rate_hz);
  message.gaps = channel.gaps;
  message.skipped = channel.skipped;
  for (const auto& [reason, count] : channel.drops) {
    drop_count_t drop{};
    drop.reason = reason;
    drop.count = count;
    message.drops.push_back(drop);
  }
  message.n_drops = static_cast<std::int32_t>(message.drops.size());
  return message;
}

}  // namespace

Decoded<ServiceStatus> Codec<ServiceStatus>::Decode(Bytes bytes) {
  const auto message = DecodeWire<service_status_t>(bytes);
  RequireCount(message.n_channels, kMostChannels);
  ServiceStatus status;
  status.time = ToTimestamp(message.utime);
  status.service = Text(message.service);
  status.instance = Text(message.instance);
  status.host = Text(message.host);
  status.pid = message.pid;
  status.version = Text(message.version);
  status.state = Enumeration(message.state, ServiceState::kStopping);
  status.text = Text(message.text);
  for (const auto& channel : message.channels) status.channels.push_back(ToChannel(channel));
  status.processing_ms_p50 = Finite(message.processing_ms_p50);
  status.processing_ms_p99 = Finite(message.processing_ms_p99);
  status.age_ms_p50 = Finite(message.age_ms_p50);
  status.age_ms_p99 = Finite(message.age_ms_p99);
  status.receive_buffer_bytes = message.receive_buffer_bytes;
  return {std::move(status), Count(message.sequence)};
}

std::vector<std::uint8_t> Codec<ServiceStatus>::Encode(const ServiceStatus& status,
                                                       std::int64_t sequence) {
  service_status_t message{};
  message.utime = status.time.microseconds;
  message.sequence = sequence;
  message.service = status.service;
  message.instance = status.instance;
  message.host = status.host;
  message.pid = status.pid;
  message.version = status.version;
  message.state = Number(status.state);
  message.text = Shortened(status.text);
  for (const auto& channel : status.channels) message.channels.push_back(FromChannel(channel));
  message.n_channels = static_cast<std::int32_t>(message.channels.size());
  message.processing_ms_p50 = Outgoing(status.processing_ms_p50);
  message.processing_ms_p99 = Outgoing(status.processing_ms_p99);
  message.age_ms_p50 = Outgoing(status.age_ms_p50);
  message.age_ms_p99 = Outgoing(status.age_ms_p99);
  message.receive_buffer_bytes = status.receive_buffer_bytes;
  return EncodeWire(message);
}

}  // namespace deixis::messages
