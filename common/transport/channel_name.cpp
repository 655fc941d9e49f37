#include "common/transport/channel_name.h"

#include <algorithm>

namespace deixis::transport {
namespace {

constexpr std::size_t kLongestName = 63;  // LCM_MAX_CHANNEL_NAME_LENGTH

bool IsAllowed(char c) {
  return (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') ||
         std::string("_./-#").find(c) != std::string::npos;
}

}  // namespace

bool IsChannelName(const std::string& name) {
  return !name.empty() && name.size() <= kLongestName &&
         std::all_of(name.begin(), name.end(), IsAllowed);
}

std::vector<std::pair<std::string, std::string>> ChannelFaults(
    const std::vector<std::pair<std::string, std::string>>& channels) {
  std::vector<std::pair<std::string, std::string>> faults;
  for (auto channel = channels.begin(); channel != channels.end(); ++channel) {
    const auto& [key, name] = *channel;
    if (!IsChannelName(name)) faults.emplace_back(key, kChannelNameRule);
    const auto same = std::find_if(channels.begin(), channel, [&name = name](const auto& earlier) {
      return earlier.second == name;
    });
    if (same != channel) faults.emplace_back(key, "must be another channel than " + same->first);
  }
  return faults;
}

std::string ChannelPattern(const std::string& name) {
  std::string pattern;
  for (const char c : name) pattern += c == '.' ? "\\." : std::string(1, c);
  return pattern;
}

}  // namespace deixis::transport
