#include "common/transport/url.h"

#include <charconv>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <set>

#include "common/transport/bus.h"
#include "common/transport/receive_buffer.h"

namespace deixis::transport {
namespace {

// Which of two values counts would depend on the reader, and so does what an empty one means.
void RequireKeysOnceWithValues(const std::string& text) {
  std::set<std::string> keys;
  for (auto at = text.find('?'); at != std::string::npos; at = text.find('&', at + 1)) {
    const auto end = text.find_first_of("=&", at + 1);
    const std::string key = text.substr(at + 1, end - at - 1);
    const bool has_value = end != std::string::npos && text[end] == '=' && end + 1 < text.size() &&
                           text[end + 1] != '&';
    if (!key.empty() && !has_value) {
      throw BusError("LCM URL '" + text + "' gives '" + key + "' no value; give one or remove it");
    }
    if (!key.empty() && !keys.insert(key).second) {
      throw BusError("LCM URL '" + text + "' gives '" + key + "' twice; remove one");
    }
  }
}

void RequireInRange(const Url& url, const std::string& name, const std::string& value,
                    std::int64_t least, std::int64_t most) {
  std::int64_t number = 0;
  const char* end = value.data() + value.size();
  const auto [stop, error] = std::from_chars(value.data(), end, number);
  if (error == std::errc() && stop == end && number >= least && number <= most) return;
  throw BusError("LCM URL '" + url.text + "': " + name + " must be a whole number from " +
                 std::to_string(least) + " to " + std::to_string(most));
}

// LCM itself takes any number for another one, or says nothing of why it does not open.
void RequirePort(const Url& url) {
  const auto colon = url.network.find(':');
  if (colon == std::string::npos) return;
  RequireInRange(url, "the port", url.network.substr(colon + 1), 1, 65535);
}

void RequireGroup(const Url& url) {
  const std::string group = url.network.substr(0, url.network.find(':'));
  int first = 0;
  const auto [stop, error] = std::from_chars(group.data(), group.data() + group.size(), first);
  const bool is_multicast = error == std::errc() && *stop == '.' && first >= 224 && first <= 239;
  if (url.network.empty() || is_multicast) return;
  throw BusError("LCM URL '" + url.text + "': '" + group +
                 "' is no multicast group (224.0.0.0 to 239.255.255.255)");
}

void RequireUdpmOptions(const Url& url) {
  RequireGroup(url);
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
    throw BusError("LCM URL '" + text +
                   "' has no provider; write e.g. udpm://239.255.76.67:7667?ttl=0 or memq://");
  }
  Url url;
  url.text = text;
  url.provider = text.substr(0, separator);
  url.network = text.substr(separator + 3, text.find('?') - separator - 3);
  RequireKeysOnceWithValues(text);
  if (url.provider == "udpm" || url.provider == "tcpq") RequirePort(url);
  if (url.provider == "udpm") RequireUdpmOptions(url);
  return url;
}

}  // namespace

std::string Url::option(const std::string& key) const {
  for (auto at = text.find('?'); at != std::string::npos; at = text.find('&', at + 1)) {
    if (text.compare(at + 1, key.size() + 1, key + "=") == 0) {
      const auto begin = at + key.size() + 2;
      return text.substr(begin, text.find('&', begin) - begin);
    }
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
