#include "common/transport/status_reporter.h"

#include <unistd.h>

#include <array>
#include <chrono>
#include <utility>

namespace deixis::transport {
namespace {

constexpr std::int64_t kPeriod_us = 1'000'000;

std::int64_t Steady_us() {
  return std::chrono::duration_cast<std::chrono::microseconds>(
             std::chrono::steady_clock::now().time_since_epoch())
      .count();
}

Timestamp WallClock() {
  return {std::chrono::duration_cast<std::chrono::microseconds>(
              std::chrono::system_clock::now().time_since_epoch())
              .count()};
}

// A service that works is degraded when its bus is in trouble.
void Blame(const std::string& trouble, messages::ServiceStatus& status) {
  if (trouble.empty()) return;
  status.text += (status.text.empty() ? "" : "; ") + trouble;
  if (status.state == messages::ServiceState::kRunning) {
    status.state = messages::ServiceState::kDegraded;
  }
}

std::string HostName() {
  std::array<char, 256> name{};
  gethostname(name.data(), name.size() - 1);
  return name.data();
}

}  // namespace

StatusReporter::StatusReporter(Identity identity, const Bus& input, Bus& output)
    : identity_(std::move(identity)), input_(input), output_(output), host_(HostName()) {}

void StatusReporter::ReportIfDue(messages::ServiceState state, const std::string& text) {
  if (Steady_us() - last_report_us_ >= kPeriod_us) Report(state, text);
}

void StatusReporter::Report(messages::ServiceState state, const std::string& text) {
  const std::int64_t now_us = Steady_us();
  const double elapsed_s =
      last_report_us_ == 0 ? 0.0 : 1e-6 * static_cast<double>(now_us - last_report_us_);
  last_report_us_ = now_us;

  messages::ServiceStatus status;
  status.time = WallClock();
  status.service = identity_.service;
  status.instance = identity_.instance;
  status.host = host_;
  status.pid = getpid();
  status.version = DEIXIS_VERSION;
  status.state = state;
  status.text = text;
  Blame(input_.trouble(), status);
  status.channels = ChannelsWithRates(elapsed_s);
  status.processing_ms_p50 = input_.processing_ms().p50;
  status.processing_ms_p99 = input_.processing_ms().p99;
  status.age_ms_p50 = output_.age_ms().p50;
  status.age_ms_p99 = output_.age_ms().p99;
  status.receive_buffer_bytes = input_.receive_buffer_bytes();
  output_.Publish(kStatusChannel, status);
}

std::vector<messages::ChannelStatistics> StatusReporter::ChannelsWithRates(double elapsed_s) {
  std::vector<messages::ChannelStatistics> channels = input_.statistics();
  if (&input_ != &output_) {
    for (auto& channel : output_.statistics()) channels.push_back(std::move(channel));
  }
  for (auto& channel : channels) {
    const bool is_input = channel.direction == messages::Direction::kIn;
    std::int64_t& last = last_counts_[(is_input ? "<" : ">") + channel.channel];
    if (elapsed_s > 0.0) {
      channel.rate_hz = static_cast<double>(channel.messages - last) / elapsed_s;
    }
    last = channel.messages;
  }
  return channels;
}

}  // namespace deixis::transport
