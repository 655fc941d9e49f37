#include "common/text/utf8.h"

#include <cstddef>
#include <cstdint>

namespace deixis::text {
namespace {

// How many bytes follow the first one of a character, and between which bounds the second must be.
struct Tail {
  std::size_t size;
  std::uint8_t lowest = 0x80;
  std::uint8_t highest = 0xBF;
};

constexpr std::size_t kNoCharacter = ~std::size_t{0};  // longer than any message

// RFC 3629, section 4.
Tail TailOf(std::uint8_t first) {
  if (first < 0x80) return {first == 0 ? kNoCharacter : 0};
  if (first < 0xC2 || first > 0xF4) return {kNoCharacter};
  if (first < 0xE0) return {1};
  if (first == 0xE0) return {2, 0xA0};
  if (first == 0xED) return {2, 0x80, 0x9F};
  if (first < 0xF0) return {2};
  if (first == 0xF0) return {3, 0x90};
  return {3, 0x80, static_cast<std::uint8_t>(first == 0xF4 ? 0x8F : 0xBF)};
}

}  // namespace

bool IsUtf8(std::string_view text) {
  for (std::size_t at = 0; at < text.size();) {
    const Tail tail = TailOf(static_cast<std::uint8_t>(text[at]));
    if (tail.size >= text.size() - at) return false;
    for (std::size_t i = 1; i <= tail.size; ++i) {
      const auto byte = static_cast<std::uint8_t>(text[at + i]);
      const bool fits = i == 1 ? byte >= tail.lowest && byte <= tail.highest : byte >> 6 == 2;
      if (!fits) return false;
    }
    at += 1 + tail.size;
  }
  return true;
}

}  // namespace deixis::text
