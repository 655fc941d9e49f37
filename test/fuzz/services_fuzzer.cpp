// Any messages on all channels of all services that listen. Services keep what they heard before,
// so an input that fails may need those before it: the same -seed gives the same inputs again.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <memory>

#include "test/fuzz/good_messages.h"
#include "test/fuzz/hosted_services.h"
#include "test/fuzz/message_mutation.h"
#include "test/fuzz/message_sequence.h"
#include "test/support/random_message.h"

namespace {

using deixis::fuzz::GoodMessages;
using deixis::fuzz::HostedServices;
using deixis::fuzz::ReadSequence;
using deixis::fuzz::SequenceMessage;
using deixis::test::Random;

constexpr int kInputsPerLife = 500;
constexpr std::size_t kMostBytes = 4096;
constexpr std::size_t kMostMessages = 8;

// Fresh services every now and then: what they write and remember stays bounded.
HostedServices& Services() {
  static std::unique_ptr<HostedServices> services;
  static int inputs = 0;
  if (inputs++ % kInputsPerLife == 0) {
    services.reset();
    services = std::make_unique<HostedServices>();
  }
  return *services;
}

/// On its own channel; of what no service listens to, on any, where it is of the wrong type.
std::uint8_t ChannelFor(const std::string& name, Random& random) {
  static const std::vector<std::string> channels = HostedServices().channels();
  const auto found = std::find(channels.begin(), channels.end(), name);
  if (found == channels.end()) return static_cast<std::uint8_t>(random() % channels.size());
  return static_cast<std::uint8_t>(found - channels.begin());
}

SequenceMessage AnyGoodMessage(Random& random) {
  static const auto messages = GoodMessages();
  const auto& message = messages[random() % messages.size()];
  return {ChannelFor(message.channel, random), message.bytes};
}

void Mutate(SequenceMessage& message, Random& random) {
  const std::size_t size = message.bytes.size();
  const auto seed = static_cast<unsigned>(random());
  message.bytes.resize(std::max(size, kMostBytes));
  message.bytes.resize(
      deixis::fuzz::MutateMessage(message.bytes.data(), size, message.bytes.size(), seed));
}

void Mutate(std::vector<SequenceMessage>& sequence, Random& random) {
  const unsigned choice = random() % 8;
  if (sequence.empty() || (choice == 0 && sequence.size() < kMostMessages)) {
    sequence.push_back(AnyGoodMessage(random));
  }
  const std::size_t index = random() % sequence.size();
  if (choice == 1 && sequence.size() > 1) {
    sequence.erase(sequence.begin() + static_cast<std::ptrdiff_t>(index));
  } else if (choice == 2) {
    std::swap(sequence[index], sequence[random() % sequence.size()]);
  } else if (choice == 3) {
    sequence[index].channel = static_cast<std::uint8_t>(random());
  } else {
    Mutate(sequence[index], random);
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  HostedServices& services = Services();
  const auto& channels = services.channels();
  for (const SequenceMessage& message : ReadSequence({data, size})) {
    services.Send(channels[message.channel % channels.size()],
                  {message.bytes.data(), message.bytes.size()});
  }
  const std::string complaint = services.Complaint();
  if (complaint.empty()) return 0;
  std::fprintf(stderr, "broken: %s\n", complaint.c_str());
  std::abort();
}

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size,
                                               std::size_t max_size, unsigned int seed) {
  Random random(seed);
  auto sequence = ReadSequence({data, size});
  Mutate(sequence, random);
  const auto output = WriteSequence(sequence);
  const std::size_t written = std::min(output.size(), max_size);
  std::copy_n(output.begin(), written, data);
  return written;
}
