#pragma once
#include <cstdint>
#include <map>
#include <string>

#include "common/messages/service_status.h"
#include "common/transport/bus.h"

namespace deixis::transport {

/// What a service says of itself beside its counters.
struct Health {
  bool is_degraded = false;  ///< It works, but something is wrong.
  std::string text;          ///< One line for people: what is wrong and the cure.

  /// Adds a part to the text, unless it is empty.
  void Say(const std::string& part) {
    if (!part.empty()) text += (text.empty() ? "" : "; ") + part;
  }
  /// Adds "5 corrupt pictures", unless there are none.
  void SayCount(std::int64_t count, const std::string& what) {
    if (count > 0) Say(std::to_string(count) + " " + what);
  }
};

/// Who a process is, in its status messages.
struct Identity {
  std::string service;
  std::string instance;  ///< Tells two processes of one service apart; empty = the only one.
};

/// Publishes SERVICE_STATUS once per second of wall clock.
class StatusReporter {
 public:
  /// Reports on what passes through `input` and `output` (they may be one), by way of `output`.
  StatusReporter(Identity identity, const Bus& input, Bus& output);

  /// What troubles the bus is added to `text`, and makes a running service a degraded one.
  void ReportIfDue(messages::ServiceState state, const std::string& text);
  void Report(messages::ServiceState state, const std::string& text);

 private:
  std::vector<messages::ChannelStatistics> ChannelsWithRates(double elapsed_s);

  Identity identity_;
  const Bus& input_;
  Bus& output_;
  std::string host_;
  std::int64_t last_report_us_ = 0;
  std::map<std::string, std::int64_t> last_counts_;
};

/// Channel of status messages.
inline constexpr const char* kStatusChannel = "SERVICE_STATUS";

}  // namespace deixis::transport
