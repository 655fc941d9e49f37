#include "services/offline/offline_host.h"

#include <utility>

#include "common/transport/status_reporter.h"

namespace deixis::offline {
namespace {

constexpr std::chrono::milliseconds kNoWait{0};

transport::BusOptions PrivateBus(const std::string& channel_prefix) {
  transport::BusOptions options;
  options.url = "memq://";
  options.channel_prefix = channel_prefix;
  options.deliver_every_message = true;
  options.queue_capacity = 1 << 20;  // nothing may be lost
  return options;
}

std::map<std::string, std::int64_t> DropsOf(const transport::Bus& bus) {
  std::map<std::string, std::int64_t> drops;
  for (const auto& channel : bus.statistics()) {
    for (const auto& [reason, count] : channel.drops) {
      drops[channel.channel + ": " + reason] += count;
    }
  }
  return drops;
}

std::map<std::string, std::int64_t> PublishedOn(const transport::Bus& bus,
                                                const std::set<std::string>& channels) {
  std::map<std::string, std::int64_t> published;
  for (const auto& channel : bus.statistics()) {
    const bool is_result =
        channel.direction == messages::Direction::kOut && channels.count(channel.channel) != 0;
    if (is_result) published[channel.channel] = channel.messages;
  }
  return published;
}

std::set<std::string> UnheardOn(const transport::Bus& bus) {
  std::set<std::string> unheard;
  for (const auto& channel : bus.statistics()) {
    const bool is_silent = channel.messages == 0 && channel.drops.empty();
    if (channel.direction == messages::Direction::kIn && is_silent) unheard.insert(channel.channel);
  }
  return unheard;
}

}  // namespace

OfflineHost::OfflineHost(const std::string& channel_prefix, ServiceTimes* times)
    : prefix_(channel_prefix), bus_(PrivateBus(channel_prefix)), times_(times) {
  bus_.SubscribeRaw(".*", [this](const transport::RawMessage& message) {
    Record(message);
    if (times_ != nullptr) times_->Begin();
  });
}

// LCM hands a message to subscribers in the order in which they came: what has passed when this one
// gets it was spent by the service that subscribed last.
void OfflineHost::Add(std::unique_ptr<HostedService> service, const std::string& name) {
  services_.push_back(std::move(service));
  if (times_ == nullptr) return;
  bus_.SubscribeRaw(".*", [this, name](const transport::RawMessage& message) {
    times_->Note(name, message.channel, event_time_us_);
  });
}

std::set<std::string> OfflineHost::ReplacedChannels() const {
  std::set<std::string> channels;
  for (const auto& service : services_) {
    for (const std::string& channel : service->OutputChannels()) channels.insert(prefix_ + channel);
  }
  return channels;
}

void OfflineHost::Record(const transport::RawMessage& message) {
  const bool is_result = replaced_.count(message.channel) != 0;
  if (content_ == OutputContent::kResultsOnly && !is_result) return;
  try {
    output_->PublishRaw(message.channel, message.bytes, {event_time_us_});
  } catch (const transport::BusError&) {
    failure_ = std::current_exception();  // A handler lets nothing out: Run() throws it.
  }
}

Summary OfflineHost::Run(LogReader& input, transport::Bus& output, OutputContent content,
                         const std::function<void(double)>& report_progress) {
  replaced_ = ReplacedChannels();
  output_ = &output;
  content_ = content;
  Summary summary;
  const std::string status_channel = prefix_ + transport::kStatusChannel;
  while (input.Next()) {
    const transport::RawMessage& event = input.event();
    ++summary.events_read;
    summary.input_channels.insert(event.channel);
    report_progress(input.progress());
    if (event.channel == status_channel) continue;
    if (replaced_.count(event.channel) != 0) {
      ++summary.events_replaced;
      continue;
    }
    event_time_us_ = event.received_us;
    bus_.PublishRaw(event.channel, event.bytes, {event_time_us_});
    while (bus_.Handle(kNoWait) > 0) {
    }
    if (failure_) std::rethrow_exception(failure_);
  }
  output.Flush();
  if (times_ != nullptr) times_->Flush();
  summary.nameless_events = input.nameless_events();
  summary.input_bytes = input.size_bytes();
  summary.damaged = input.damaged();
  summary.published = PublishedOn(bus_, replaced_);
  for (const std::string& channel : UnheardOn(bus_)) {
    if (replaced_.count(channel) == 0) summary.unheard_channels.insert(channel);
  }
  summary.drops = DropsOf(bus_);
  return summary;
}

}  // namespace deixis::offline
