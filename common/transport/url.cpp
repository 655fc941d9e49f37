#include "common/transport/url.h"

#include <cstdlib>
#include <set>

#include "common/transport/bus.h"

namespace deixis::transport {
namespace {

// Which of two values counts would depend on the reader.
void RequireKeysOnce(const std::string& text) {
  std::set<std::string> keys;
  for (auto at = text.find('?'); at != std::string::npos; at = text.find('&', at + 1)) {
    const std::string key = text.substr(at + 1, text.find_first_of("=&", at + 1) - at - 1);
    if (!key.empty() && !keys.insert(key).second) {
      throw BusError("LCM URL '" + text + "' gives '" + key + "' twice; remove one");
    }
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
  RequireKeysOnce(text);
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
    url.text += "recv_buf_size=" + std::to_string(receive_buffer_bytes);
  }
  return url;
}

}  // namespace deixis::transport
