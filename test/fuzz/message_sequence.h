#pragma once
#include <cstdint>
#include <vector>

#include "common/messages/codec.h"

namespace deixis::fuzz {

/// One message of a fuzzer's input.
struct SequenceMessage {
  std::uint8_t channel = 0;  ///< Index, taken modulo the number of channels.
  std::vector<std::uint8_t> bytes;
};

/// Messages as a fuzzer's input holds them: channel (one byte), size (two, high one first), bytes,
/// and so on. Any input is one: a size that reaches beyond the end ends there.
std::vector<SequenceMessage> ReadSequence(messages::Bytes input);
std::vector<std::uint8_t> WriteSequence(const std::vector<SequenceMessage>& sequence);

}  // namespace deixis::fuzz
