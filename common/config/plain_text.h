#pragma once
#include <algorithm>
#include <string>

namespace deixis::config {

/// What a name that is sent in messages must be; fits behind the key of a setting.
inline constexpr const char* kPlainTextRule =
    "must be 1 to 200 letters (bytes) without control characters";

/// Whether `text` can be sent: C receivers end a text at its first zero byte.
inline bool IsPlainText(const std::string& text) {
  constexpr std::size_t kLongest = 200;
  const auto is_control = [](unsigned char c) { return c < 0x20 || c == 0x7f; };
  return !text.empty() && text.size() <= kLongest &&
         std::none_of(text.begin(), text.end(), is_control);
}

}  // namespace deixis::config
