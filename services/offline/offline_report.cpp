#include "services/offline/offline_report.h"

#include "common/config/config.h"
#include "common/logging/log.h"

namespace deixis::offline {
namespace {

using config::ConfigError;

constexpr std::size_t kMostParts = 10;  // That are told one by one.

std::string Listed(const std::set<std::string>& names) {
  std::string list;
  for (const std::string& name : names) list += (list.empty() ? "" : ", ") + name;
  return list;
}

std::int64_t BytesIn(const std::vector<DamagedPart>& parts) {
  std::int64_t bytes = 0;
  for (const DamagedPart& part : parts) bytes += part.bytes;
  return bytes;
}

void TellDamage(const Summary& summary, const std::string& input) {
  for (std::size_t i = 0; i < summary.damaged.size() && i < kMostParts; ++i) {
    logging::Warn("input_damaged", {{"log", input},
                                    {"offset", summary.damaged[i].offset},
                                    {"skipped_bytes", summary.damaged[i].bytes}});
  }
  if (!summary.damaged.empty()) {
    logging::Warn("input_incomplete", {{"log", input},
                                       {"damaged_parts", summary.damaged.size()},
                                       {"skipped_bytes", BytesIn(summary.damaged)},
                                       {"of_bytes", summary.input_bytes},
                                       {"used_events", summary.events_read}});
  }
  if (summary.nameless_events > 0) {
    logging::Warn("nameless_events_skipped", {{"log", input}, {"count", summary.nameless_events}});
  }
}

void TellMessages(const Summary& summary) {
  for (const auto& [what, count] : summary.drops) {
    logging::Warn("messages_dropped", {{"what", what}, {"count", count}});
  }
  if (summary.events_replaced > 0) {
    logging::Info("input_replaced", {{"messages", summary.events_replaced}});
  }
  for (const auto& [channel, count] : summary.published) {
    logging::Info("published", {{"channel", channel}, {"messages", count}});
  }
}

bool HasResult(const Summary& summary) {
  for (const auto& [channel, count] : summary.published) {
    if (count > 0) return true;
  }
  return false;
}

}  // namespace

void Report(const Summary& summary, const std::string& input) {
  TellDamage(summary, input);
  TellMessages(summary);
  if (summary.events_read == 0) throw ConfigError("log '" + input + "' holds no messages");
  if (!HasResult(summary)) {
    const std::string channels = Listed(summary.input_channels);
    if (summary.unheard_channels.empty()) {
      throw ConfigError("log '" + input + "' gave no result; it has: " + channels);
    }
    throw ConfigError("nothing in log '" + input + "' is on " + Listed(summary.unheard_channels) +
                      "; it has: " + channels +
                      "; name the services by --services, or set their channels to fit, as --set"
                      " object_detector.image_channel=STEREO; or --channel-prefix");
  }
  if (2 * BytesIn(summary.damaged) > summary.input_bytes) {
    throw ConfigError("most of log '" + input + "' cannot be read; record it again");
  }
}

}  // namespace deixis::offline
