#pragma once
#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

#include "common/time/timestamp.h"

namespace deixis::messages {

/// A message that must not be used. `what()` is a short reason out of a small set ("truncated",
/// "not_finite"), fit to be a counter's name.
class Rejected : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Encoded message, as it lies in a packet or a log.
struct Bytes {
  const std::uint8_t* data = nullptr;
  std::size_t size = 0;
};

/// A message that makes sense, and its number among those of its publisher.
template <typename T>
struct Decoded {
  T value;
  std::int64_t sequence = -1;  ///< -1: it carries none.
};

/// How a plain struct travels. Each specialisation (one file per type in this folder) offers
///   static Decoded<T> Decode(Bytes bytes);                     // throws Rejected
///   static std::vector<std::uint8_t> Encode(const T& value, std::int64_t sequence);
///   static Timestamp Time(const T& value);
template <typename T>
struct Codec;

}  // namespace deixis::messages
