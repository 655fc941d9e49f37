#include "test/fuzz/message_sequence.h"

#include <algorithm>

namespace deixis::fuzz {

std::vector<SequenceMessage> ReadSequence(messages::Bytes input) {
  constexpr std::size_t kHeadBytes = 3;
  std::vector<SequenceMessage> sequence;
  while (input.size > kHeadBytes) {
    const std::size_t stated = static_cast<std::size_t>(input.data[1] << 8 | input.data[2]);
    const std::size_t size = std::min(stated, input.size - kHeadBytes);
    const std::uint8_t* const begin = input.data + kHeadBytes;
    sequence.push_back({input.data[0], {begin, begin + size}});
    input.data += kHeadBytes + size;
    input.size -= kHeadBytes + size;
  }
  return sequence;
}

std::vector<std::uint8_t> WriteSequence(const std::vector<SequenceMessage>& sequence) {
  std::vector<std::uint8_t> output;
  for (const SequenceMessage& message : sequence) {
    output.push_back(message.channel);
    output.push_back(static_cast<std::uint8_t>(message.bytes.size() >> 8));
    output.push_back(static_cast<std::uint8_t>(message.bytes.size()));
    output.insert(output.end(), message.bytes.begin(), message.bytes.end());
  }
  return output;
}

}  // namespace deixis::fuzz
