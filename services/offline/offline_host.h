#pragma once
#include <cstdint>
#include <exception>
#include <functional>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "common/transport/bus.h"
#include "services/offline/log_reader.h"
#include "services/offline/service_times.h"

namespace deixis::offline {

/// A service that lives on the host's bus; destroying it ends its subscriptions' use.
class HostedService {
 public:
  virtual ~HostedService() = default;
  /// Channels that it publishes, without prefix.
  virtual std::vector<std::string> OutputChannels() const = 0;
};

/// What happened in a run.
struct Summary {
  std::int64_t events_read = 0;
  std::int64_t events_replaced = 0;  ///< Input on channels that a hosted service publishes itself.
  std::int64_t nameless_events = 0;  ///< Passed over since their channel has no name.
  std::int64_t input_bytes = 0;      ///< Size of the input.
  std::vector<DamagedPart> damaged;  ///< Parts of the input that were passed over.
  std::set<std::string> input_channels;    ///< On the wire, as the input has them.
  std::set<std::string> unheard_channels;  ///< What services listen to and the input has not.
  std::map<std::string, std::int64_t> published;  ///< Messages by channel.
  std::map<std::string, std::int64_t> drops;      ///< Refused messages by "channel: reason".
};

enum class OutputContent { kEverything, kResultsOnly };

/// Feeds a log, event by event, to services on one private bus.
class OfflineHost {
 public:
  /// `times` outlives the host; null: nobody wants to know.
  explicit OfflineHost(const std::string& channel_prefix, ServiceTimes* times = nullptr);

  transport::Bus& bus() { return bus_; }
  /// Takes a service that was made on bus() after all that were added before.
  void Add(std::unique_ptr<HostedService> service, const std::string& name = "");

  /// Runs `input` through the services into `output`. `report_progress` gets the share that is
  /// done. Throws BusError when the output cannot be written.
  Summary Run(LogReader& input, transport::Bus& output, OutputContent content,
              const std::function<void(double)>& report_progress);

 private:
  void Record(const transport::RawMessage& message);
  std::set<std::string> ReplacedChannels() const;

  std::string prefix_;
  transport::Bus bus_;
  ServiceTimes* times_ = nullptr;
  std::vector<std::unique_ptr<HostedService>> services_;
  std::set<std::string> replaced_;
  transport::Bus* output_ = nullptr;
  OutputContent content_ = OutputContent::kEverything;
  std::int64_t event_time_us_ = 0;
  std::exception_ptr failure_;  ///< Of writing the output.
};

}  // namespace deixis::offline
