#include "common/transport/url.h"

#include <arpa/inet.h>
#include <netinet/in.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <set>
#include <string_view>
#include <vector>

#include "common/transport/bus.h"
#include "common/transport/receive_buffer.h"

namespace deixis::transport {
namespace {

constexpr std::array<std::string_view, 2> kUdpmKeys{"ttl", "recv_buf_size"};

struct Parameter {
  std::string key;
  std::string value;
};

[[noreturn]] void Fail(const std::string& text, const std::string& fault) {
  throw BusError("LCM URL '" + text + "' " + fault);
}

std::vector<Parameter> Parameters(const std::string& text) {
  std::vector<Parameter> parameters;
  for (auto at = text.find('?'); at != std::string::npos; at = text.find('&', at + 1)) {
    const auto begin = at + 1;
    const std::string part = text.substr(begin, text.find('&', begin) - begin);
    if (part.empty()) continue;
    const auto equals = part.find('=');
    if (equals == 0) Fail(text, "gives no key for '" + part + "'; name one or remove it");
    const std::string key = part.substr(0, equals);
    const std::string value = equals == std::string::npos ? "" : part.substr(equals + 1);
    // What it would mean depends on the reader.
    if (value.empty()) Fail(text, "gives '" + key + "' no value; give one or remove it");
    parameters.push_back({key, value});
  }
  return parameters;
}

// Which of two values counts would depend on the reader.
void RequireKeysOnce(const std::string& text) {
  std::set<std::string> keys;
  for (const Parameter& parameter : Parameters(text)) {
    if (keys.insert(parameter.key).second) continue;
    Fail(text, "gives '" + parameter.key + "' twice; remove one");
  }
}

void RequireInRange(const Url& url, const std::string& name, const std::string& value,
                    std::int64_t least, std::int64_t most) {
  std::int64_t number = 0;
  const char* end = value.data() + value.size();
  const auto [stop, error] = std::from_chars(value.data(), end, number);
  if (error == std::errc() && stop == end && number >= least && number <= most) return;
  Fail(url.text, "is wrong: " + name + " must be a whole number from " + std::to_string(least) +
                     " to " + std::to_string(most));
}

// LCM itself takes any number for another one, or says nothing of why it does not open.
void RequirePort(const Url& url) {
  const auto colon = url.network.find(':');
  if (colon == std::string::npos) return;
  RequireInRange(url, "the port", url.network.substr(colon + 1), 1, 65535);
}

void RequireGroup(const Url& url) {
  if (url.network.empty()) return;
  const auto colon = url.network.find(':');
  const std::string group = url.network.substr(0, colon);
  in_addr address{};
  const bool is_address = inet_pton(AF_INET, group.c_str(), &address) == 1;
  if (!is_address || !IN_MULTICAST(ntohl(address.s_addr))) {
    Fail(url.text, "is of '" + group + "', no multicast group (224.0.0.0 to 239.255.255.255)");
  }
  // LCM would take any that is free, which nobody else has.
  if (colon == std::string::npos) Fail(url.text, "has no port; write e.g. " + group + ":7667");
}

void RequireUdpmOptions(const Url& url) {
  for (const auto& [key, value] : Parameters(url.text)) {
    if (std::find(kUdpmKeys.begin(), kUdpmKeys.end(), key) != kUdpmKeys.end()) continue;
    Fail(url.text, "has the unknown key '" + key + "'; known are ttl and recv_buf_size");
  }
  const std::string ttl = url.option("ttl");
  if (!ttl.empty()) RequireInRange(url, "ttl", ttl, 0, 255);
  const std::string buffer = url.option("recv_buf_size");
  if (!buffer.empty()) {
    RequireInRange(url, "recv_buf_size", buffer, 1, std::numeric_limits<std::int32_t>::max());
  }
}

Url TakeApart(const std::string& text) {
  const auto separator = text.find("://");
  if (separator == std::string::npos) {
    Fail(text, "has no provider; write e.g. udpm://239.255.76.67:7667?ttl=0 or memq://");
  }
  Url url;
  url.text = text;
  url.provider = text.substr(0, separator);
  url.network = text.substr(separator + 3, text.find('?') - separator - 3);
  RequireKeysOnce(text);
  if (url.provider == "udpm" || url.provider == "tcpq") RequirePort(url);
  if (url.provider == "udpm") {
    RequireGroup(url);
    RequireUdpmOptions(url);
  }
  return url;
}

}  // namespace

std::string Url::option(const std::string& key) const {
  for (const Parameter& parameter : Parameters(text)) {
    if (parameter.key == key) return parameter.value;
  }
  return "";
}

Url ResolveUrl(const std::string& text, int receive_buffer_bytes) {
  std::string resolved = text;
  if (resolved.empty()) {
    if (const char* fallback = std::getenv("LCM_DEFAULT_URL")) resolved = fallback;
  }
  if (resolved.empty()) resolved = "udpm://239.255.76.67:7667?ttl=0";
  Url url = TakeApart(resolved);
  if (url.provider == "udpm" && url.option("recv_buf_size").empty()) {
    url.text += (resolved.find('?') == std::string::npos ? "?" : "&");
    url.text += "recv_buf_size=" + std::to_string(ExpectedReceiveBuffer(receive_buffer_bytes));
  }
  return url;
}

}  // namespace deixis::transport
