#pragma once
#include <algorithm>
#include <string>

#include "common/text/utf8.h"

namespace deixis::config {

/// What a name that is sent in messages must be; fits behind the key of a setting.
inline constexpr const char* kPlainTextRule =
    "must be 1 to 200 letters (bytes) of UTF-8 without control characters";

/// Whether `name` can be sent: receivers take UTF-8 only, those in C end a text at its first zero
/// byte.
inline bool IsPlainText(const std::string& name) {
  constexpr std::size_t kLongest = 200;
  const auto is_control = [](unsigned char c) { return c < 0x20 || c == 0x7f; };
  return !name.empty() && name.size() <= kLongest && text::IsUtf8(name) &&
         std::none_of(name.begin(), name.end(), is_control);
}

}  // namespace deixis::config
