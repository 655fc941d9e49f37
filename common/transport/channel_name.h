#pragma once
#include <string>
#include <utility>
#include <vector>

namespace deixis::transport {

/// What a channel's name must be; fits behind the key of a setting.
inline constexpr const char* kChannelNameRule =
    "must be a channel name: 1 to 63 of the characters A-Z a-z 0-9 _ . / - #";

/// Whether `name` can be a channel on the wire (prefix included): LCM takes no more bytes, and
/// takes other characters of a subscriber's channel for a regular expression.
bool IsChannelName(const std::string& name);

/// What is wrong with a service's channels, given by the keys of their settings, as pairs of key
/// and fault: no channel names, and two that are the same, since each carries messages of one type.
std::vector<std::pair<std::string, std::string>> ChannelFaults(
    const std::vector<std::pair<std::string, std::string>>& channels);

/// The regular expression, as LCM's subscribers want it, that matches `name` alone.
std::string ChannelPattern(const std::string& name);

}  // namespace deixis::transport
