#include "common/transport/bus.h"

#include <lcm/lcm.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <deque>
#include <map>
#include <new>
#include <optional>
#include <thread>
#include <utility>

#include "common/logging/log.h"
#include "common/transport/channel_name.h"
#include "common/transport/log_writer.h"
#include "common/transport/message_times.h"
#include "common/transport/pace.h"
#include "common/transport/publisher_sequences.h"
#include "common/transport/receive_buffer.h"
#include "common/transport/sample_window.h"
#include "common/transport/url.h"

namespace deixis::transport {
namespace {

using std::chrono::milliseconds;
using Clock = std::chrono::steady_clock;

// A peer that floods must not keep the newest pictures, the status and signals from their turn.
constexpr int kMostPerHandle = 2000;
constexpr milliseconds kLongestHandle{200};
// Results older than this come from a replayed log, not from a live camera.
constexpr double kOldestLiveAge_ms = 10'000.0;
constexpr std::chrono::seconds kWarnEvery{10};

double MillisecondsSince(Clock::time_point start) {
  return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

std::int64_t WallClock_us() {
  return std::chrono::duration_cast<std::chrono::microseconds>(
             std::chrono::system_clock::now().time_since_epoch())
      .count();
}

const char* Cure(const Url& url) {
  if (url.provider == "udpm") {
    return "; is there a multicast route? For this host alone: ip route add 224.0.0.0/4 dev lo";
  }
  if (url.provider == "file") return "; does the log exist and is it readable?";
  if (url.provider == "tcpq") {
    return ": no server answers there; start lcm-tcpq-server on that host and port, or take "
           "udpm://";
  }
  return "; known are udpm://, tcpq://, memq:// and file://";
}

void RequireChannelName(const std::string& wire_channel) {
  if (IsChannelName(wire_channel)) return;
  throw BusError("channel '" + wire_channel + "' (prefix included) " + kChannelNameRule +
                 "; rename it in the configuration");
}

/// Why an exception, the one being handled, kept a message from being used.
struct Fault {
  std::string reason;
  std::string detail;
  bool is_verdict = false;  ///< The message was judged; nothing failed.
};

Fault CurrentFault() {
  try {
    throw;
  } catch (const messages::Rejected& rejected) {
    return {rejected.what(), rejected.what(), /*is_verdict=*/true};
  } catch (const std::bad_alloc&) {
    return {"too_large", "out of memory"};
  } catch (const std::exception& error) {
    return {"malformed", error.what()};
  } catch (...) {
    return {"malformed", "unknown exception"};
  }
}

}  // namespace

struct Bus::Implementation {
  struct Subscription {
    Implementation* bus = nullptr;
    std::string channel;  // on the wire
    Delivery delivery = Delivery::kEvery;
    Receiver receive;                                    // decoded subscribers
    std::function<void(const RawMessage&)> receive_raw;  // raw ones
    messages::ChannelStatistics statistics;
    PublisherSequences sequences;
    MessageTimes times;
    std::int64_t skipped_since_delivery = 0;
    std::int64_t without_memory = 0;  // not handed on; counted without taking memory
    Pace pace;
    std::vector<std::uint8_t> newest;  // kLatest: bytes waiting for their turn
    bool is_waiting = false;
    Clock::time_point next_warning{};
    Clock::time_point next_warning_of_two{};
    Clock::time_point next_warning_of_jump{};

    std::string TwoPublishers(Clock::time_point now) const {
      if (!sequences.HasTwoPublishers(now)) return "";
      return "two publishers send on " + channel + " (" + std::to_string(sequences.out_of_turn()) +
             " messages out of turn): stop one of them, or give it another channel";
    }
    std::string Jump(Clock::time_point now) const {
      if (!times.HasJumped(now)) return "";
      return "the time on " + channel + " jumped by " +
             std::to_string(std::llround(times.last_jump_s())) + " s (" +
             std::to_string(times.jumps()) +
             " jumps): check its publisher's clock, unless a log is played";
    }
  };
  struct Output {
    messages::ChannelStatistics statistics;
    std::int64_t next_sequence = 0;
    bool has_warned_of_size = false;
  };

  explicit Implementation(const BusOptions& bus_options)
      : options(bus_options), url(ResolveUrl(options.url, options.receive_buffer_bytes)) {
    if (url.provider == "udpm") {
      receive_buffer_bytes = ExpectedReceiveBuffer(std::atoi(url.option("recv_buf_size").c_str()));
    }
    if (url.provider == "file" && url.option("mode") == "w") {
      writer.emplace(url.network);
      return;
    }
    lcm = lcm_create(url.text.c_str());
    if (!IsOpen()) {
      Close();
      throw BusError("cannot open LCM at '" + url.text + "'" + Cure(url));
    }
  }
  ~Implementation() { Close(); }

  // LCM makes a tcpq handle without a server, too; waiting on its socket, -1, would end the
  // program.
  bool IsOpen() const {
    return lcm != nullptr && (url.provider != "tcpq" || lcm_get_fileno(lcm) >= 0);
  }

  void Close() {
    if (lcm != nullptr) lcm_destroy(lcm);
    lcm = nullptr;
  }

  Subscription& Add(const std::string& wire_channel) {
    if (lcm == nullptr)
      throw BusError("'" + url.text + "' is being written: nothing can be received");
    subscriptions.emplace_back();
    Subscription& subscription = subscriptions.back();
    subscription.bus = this;
    subscription.channel = wire_channel;
    subscription.statistics.channel = wire_channel;
    subscription.statistics.direction = messages::Direction::kIn;
    return subscription;
  }

  void Connect(Subscription& subscription, const std::string& pattern) {
    lcm_subscription_t* handle =
        lcm_subscribe(lcm, pattern.c_str(), &Implementation::OnMessage, &subscription);
    if (handle == nullptr) {
      throw BusError("cannot subscribe to '" + subscription.channel + "' at '" + url.text + "'" +
                     Cure(url));
    }
    lcm_subscription_set_queue_capacity(handle, subscription.delivery == Delivery::kLatest
                                                    ? options.latest_queue_capacity
                                                    : options.queue_capacity);
  }

  // LCM's C code calls this: nothing may escape.
  static void OnMessage(const lcm_recv_buf_t* received, const char* channel, void* user) {
    auto& subscription = *static_cast<Subscription*>(user);
    subscription.bus->arrived++;
    try {
      const RawMessage raw{channel,
                           {static_cast<const std::uint8_t*>(received->data), received->data_size},
                           received->recv_utime};
      if (subscription.delivery == Delivery::kLatest) {
        subscription.bus->KeepNewest(subscription, raw);
      } else {
        subscription.bus->Deliver(subscription, raw);
      }
    } catch (...) {  // Deliver has dealt with all but a lack of memory.
      ++subscription.without_memory;
    }
  }

  void KeepNewest(Subscription& subscription, const RawMessage& raw) {
    subscription.pace.NoteArrival(raw.received_us);
    if (subscription.is_waiting && subscription.pace.CatchesUp()) {
      DeliverNewest(subscription);
    } else if (subscription.is_waiting) {
      ++subscription.statistics.skipped;
      ++subscription.skipped_since_delivery;
    }
    subscription.newest.assign(raw.bytes.data, raw.bytes.data + raw.bytes.size);
    if (!subscription.is_waiting) waiting.push_back(&subscription);
    subscription.is_waiting = true;
  }

  void Deliver(Subscription& subscription, const RawMessage& raw) {
    const Clock::time_point start = Clock::now();
    bool is_accepted = false;
    const Accept accept = [&](const std::optional<Stamp>& stamp) {
      is_accepted = true;
      ++subscription.statistics.messages;
      if (!stamp) return;
      FollowSequence(subscription, *stamp, start);
      if (!options.deliver_every_message) FollowTime(subscription, stamp->time, start);
    };
    try {
      Hand(subscription, raw, accept);
    } catch (...) {
      const Fault fault = CurrentFault();
      const bool has_failed = is_accepted && !fault.is_verdict;
      Drop(subscription, has_failed ? "handler_failed" : fault.reason, fault.detail);
    }
    const double work_ms = MillisecondsSince(start);
    subscription.pace.NoteWork(work_ms);
    if (is_accepted && !subscription.receive_raw) processing.Add(work_ms);
  }

  static void Hand(Subscription& subscription, const RawMessage& raw, const Accept& accept) {
    if (subscription.receive_raw) {
      accept(std::nullopt);
      subscription.receive_raw(raw);
    } else {
      subscription.receive(raw.bytes, accept);
    }
  }

  // Sequence numbers are -1 (none) or 0..2^60, so differences do not overflow.
  static void FollowSequence(Subscription& subscription, const Stamp& stamp,
                             Clock::time_point now) {
    PublisherSequences& sequences = subscription.sequences;
    sequences.Observe(stamp.sequence, stamp.time, subscription.skipped_since_delivery, now);
    subscription.skipped_since_delivery = 0;
    subscription.statistics.gaps = sequences.gaps();
    if (now < subscription.next_warning_of_two || !sequences.HasTwoPublishers(now)) return;
    subscription.next_warning_of_two = now + kWarnEvery;
    logging::Warn("two_publishers", {{"channel", subscription.channel},
                                     {"out_of_turn", sequences.out_of_turn()},
                                     {"cure", "stop one of them, or give it another channel"}});
  }

  static void FollowTime(Subscription& subscription, Timestamp time, Clock::time_point now) {
    MessageTimes& times = subscription.times;
    if (!times.Jumps(time, now) || now < subscription.next_warning_of_jump) return;
    subscription.next_warning_of_jump = now + kWarnEvery;
    logging::Warn("time_jumped", {{"channel", subscription.channel},
                                  {"by_s", times.last_jump_s()},
                                  {"count", times.jumps()}});
  }

  static void Drop(Subscription& subscription, const std::string& reason, const std::string& what) {
    const std::int64_t count = ++subscription.statistics.drops[reason];
    if (Clock::now() < subscription.next_warning) return;
    subscription.next_warning = Clock::now() + kWarnEvery;
    logging::Warn("message_dropped", {{"channel", subscription.channel},
                                      {"reason", reason},
                                      {"count", count},
                                      {"detail", what}});
  }

  void DeliverNewest(Subscription& subscription) {
    Deliver(subscription,
            {subscription.channel, {subscription.newest.data(), subscription.newest.size()}, 0});
  }

  void DeliverWaiting() {
    for (std::size_t i = 0; i < waiting.size(); ++i) {
      Subscription& subscription = *waiting[i];
      subscription.is_waiting = false;
      DeliverNewest(subscription);
      subscription.pace.NoteCaughtUp();
    }
    waiting.clear();
  }

  // A signal that interrupts the wait is no lost connection.
  int HandleOne(milliseconds timeout) {
    errno = 0;
    const int result = lcm_handle_timeout(lcm, static_cast<int>(timeout.count()));
    return result < 0 && errno == EINTR ? 0 : result;
  }

  int HandleArrived(milliseconds timeout) {
    arrived = 0;
    int result = HandleOne(timeout);
    const Clock::time_point end = Clock::now() + kLongestHandle;
    for (int i = 1; result > 0 && i < kMostPerHandle && Clock::now() < end; ++i) {
      result = HandleOne(milliseconds{0});
    }
    DeliverWaiting();
    if (result < 0 && url.provider == "file") is_exhausted = true;
    if (result < 0 && url.provider != "file")
      throw BusError("connection to '" + url.text + "' is lost");
    return arrived;
  }

  Output& OutputOf(const std::string& wire_channel) {
    const auto [entry, is_new] = outputs.try_emplace(wire_channel);
    if (is_new) {
      entry->second.statistics.channel = wire_channel;
      entry->second.statistics.direction = messages::Direction::kOut;
    }
    return entry->second;
  }

  void Send(const std::string& wire_channel, messages::Bytes bytes, Timestamp time) {
    Output& output = OutputOf(wire_channel);
    if (writer) {
      writer->Write(wire_channel, bytes, time);
    } else if (lcm_publish(lcm, wire_channel.c_str(), bytes.data,
                           static_cast<unsigned int>(bytes.size)) != 0) {
      ++output.statistics.drops["publish_failed"];
      return;
    }
    ++output.statistics.messages;
    WarnOfSize(output, bytes.size);
  }

  void WarnOfSize(Output& output, std::size_t size) {
    if (url.provider != "udpm" || output.has_warned_of_size) return;
    if (size <= static_cast<std::size_t>(receive_buffer_bytes)) return;
    output.has_warned_of_size = true;
    logging::Warn("message_exceeds_receive_buffer",
                  {{"channel", output.statistics.channel},
                   {"bytes", size},
                   {"receive_buffer_bytes", receive_buffer_bytes},
                   {"cure", "sysctl -w net.core.rmem_max=4194304, or smaller messages"}});
  }

  std::int64_t KernelDrops() const {
    return url.provider == "udpm" && lcm != nullptr ? DroppedByKernel(url.network) : 0;
  }

  BusOptions options;
  Url url;
  lcm_t* lcm = nullptr;
  std::optional<LogWriter> writer;
  std::deque<Subscription> subscriptions;  // LCM keeps their addresses
  std::vector<Subscription*> waiting;      // kLatest, in order of arrival
  std::map<std::string, Output> outputs;
  SampleWindow processing;
  SampleWindow age;
  int receive_buffer_bytes = 0;  // That subscribers may expect; udpm only.
  int arrived = 0;
  bool is_exhausted = false;
};

Bus::Bus(const BusOptions& options) : implementation_(std::make_unique<Implementation>(options)) {}
Bus::~Bus() = default;

std::string Bus::Prefixed(const std::string& channel) const {
  return implementation_->options.channel_prefix + channel;
}

void Bus::SubscribeBytes(const std::string& wire_channel, Delivery delivery, Receiver receiver) {
  RequireChannelName(wire_channel);
  auto& subscription = implementation_->Add(wire_channel);
  if (!implementation_->options.deliver_every_message) subscription.delivery = delivery;
  subscription.receive = std::move(receiver);
  implementation_->Connect(subscription, ChannelPattern(wire_channel));
}

void Bus::SubscribeRaw(const std::string& channels,
                       std::function<void(const RawMessage&)> handler) {
  auto& subscription = implementation_->Add(channels);
  subscription.receive_raw = std::move(handler);
  implementation_->Connect(subscription, channels);
}

void Bus::PublishRaw(const std::string& wire_channel, messages::Bytes bytes, Timestamp time) {
  implementation_->Send(wire_channel, bytes, time);
}

void Bus::PublishBytes(const std::string& channel, const std::vector<std::uint8_t>& bytes,
                       Timestamp time) {
  implementation_->Send(Prefixed(channel), {bytes.data(), bytes.size()}, time);
}

void Bus::NoteAge(Timestamp time) {
  if (!is_live()) return;
  const double age_ms = 1e3 * SecondsBetween(time, {WallClock_us()});
  if (age_ms >= 0.0 && age_ms < kOldestLiveAge_ms) implementation_->age.Add(age_ms);
}

std::int64_t Bus::NextSequence(const std::string& channel) {
  const std::string wire_channel = Prefixed(channel);
  RequireChannelName(wire_channel);
  return implementation_->OutputOf(wire_channel).next_sequence++;
}

int Bus::Handle(milliseconds timeout) {
  if (implementation_->lcm != nullptr && !implementation_->is_exhausted) {
    return implementation_->HandleArrived(timeout);
  }
  std::this_thread::sleep_for(timeout);
  return 0;
}

void Bus::Flush() {
  if (implementation_->writer) implementation_->writer->Flush();
}

bool Bus::is_exhausted() const { return implementation_->is_exhausted; }

bool Bus::can_receive() const { return implementation_->lcm != nullptr; }

bool Bus::is_live() const {
  return implementation_->url.provider == "udpm" || implementation_->url.provider == "tcpq";
}

std::vector<messages::ChannelStatistics> Bus::statistics() const {
  std::vector<messages::ChannelStatistics> all;
  for (const auto& subscription : implementation_->subscriptions) {
    if (!subscription.receive) continue;
    all.push_back(subscription.statistics);
    if (subscription.without_memory > 0) {
      all.back().drops["too_large"] += subscription.without_memory;
    }
  }
  if (const std::int64_t dropped = implementation_->KernelDrops(); dropped > 0) {
    all.emplace_back();
    all.back().channel = kAllChannels;
    all.back().drops["kernel_buffer_full"] = dropped;
  }
  for (const auto& output : implementation_->outputs) all.push_back(output.second.statistics);
  return all;
}

std::string Bus::trouble() const {
  const Clock::time_point now = Clock::now();
  std::string text;
  for (const auto& subscription : implementation_->subscriptions) {
    for (const std::string& part : {subscription.TwoPublishers(now), subscription.Jump(now)}) {
      if (!part.empty()) text += (text.empty() ? "" : "; ") + part;
    }
  }
  return text;
}

Percentiles Bus::processing_ms() const { return implementation_->processing.Summarise(); }
Percentiles Bus::age_ms() const { return implementation_->age.Summarise(); }

int Bus::receive_buffer_bytes() const {
  if (implementation_->url.provider != "udpm") return 0;
  return GrantedReceiveBuffer(implementation_->url.network);
}

const std::string& Bus::url() const { return implementation_->url.text; }

}  // namespace deixis::transport
