#pragma once
#include <cstdint>
#include <string>
#include <vector>

namespace deixis::fuzz {

/// A message that services accept, and where they expect it.
struct GoodMessage {
  std::string name;     ///< Fit for a file's name.
  std::string channel;  ///< As shipped configurations have it.
  std::vector<std::uint8_t> bytes;
};

/// One of each kind: pictures of every format, objects, hands, bodies, gestures, a lens, a status.
/// `utime_us` is their capture time.
std::vector<GoodMessage> GoodMessages(std::int64_t utime_us = 1'000'000);

}  // namespace deixis::fuzz
