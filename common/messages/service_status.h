#pragma once
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "common/messages/codec.h"

namespace deixis::messages {

enum class Direction { kIn, kOut };

/// What went through one channel since the start.
struct ChannelStatistics {
  std::string channel;
  Direction direction = Direction::kIn;
  std::int64_t messages = 0;  ///< Accepted (in) or published (out).
  double rate_hz = 0.0;       ///< Since the last statement, about a second ago.
  std::int64_t gaps = 0;      ///< Messages that are missing between sequence numbers.
  std::int64_t skipped = 0;   ///< Passed over because a newer one was there.
  std::map<std::string, std::int64_t> drops;  ///< Not used, by reason.
};

enum class ServiceState { kStarting, kRunning, kDegraded, kStopping };

/// How a service is doing, said once per second.
struct ServiceStatus {
  Timestamp time;  ///< Wall clock.
  std::string service;
  std::string instance;
  std::string host;
  std::int32_t pid = 0;
  std::string version;
  ServiceState state = ServiceState::kStarting;
  std::string text;
  std::vector<ChannelStatistics> channels;
  double processing_ms_p50 = -1.0;  ///< Per message, of the last 512; -1: none yet.
  double processing_ms_p99 = -1.0;
  double age_ms_p50 = -1.0;  ///< Capture to publication; -1: not live or nothing published.
  double age_ms_p99 = -1.0;
  std::int64_t receive_buffer_bytes = 0;
};

template <>
struct Codec<ServiceStatus> {
  static Decoded<ServiceStatus> Decode(Bytes bytes);
  static std::vector<std::uint8_t> Encode(const ServiceStatus& status, std::int64_t sequence);
  static Timestamp Time(const ServiceStatus& status) { return status.time; }
};

}  // namespace deixis::messages
