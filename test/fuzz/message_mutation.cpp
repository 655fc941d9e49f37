#include "test/fuzz/message_mutation.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <random>
#include <vector>

#include "test/support/random_message.h"

extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t max_size);

namespace deixis::fuzz {
namespace {

constexpr std::size_t kFingerprintBytes = 8;

const std::vector<test::WireType>& Types() {
  static const std::vector<test::WireType> types = test::AllWireTypes();
  return types;
}

const test::WireType& AnyType(test::Random& random) { return Types()[random() % Types().size()]; }

bool HasType(const std::array<std::uint8_t, kFingerprintBytes>& head) {
  return std::any_of(Types().begin(), Types().end(), [&head](const test::WireType& type) {
    std::array<std::uint8_t, kFingerprintBytes> bytes{};
    test::SetFingerprint(type.fingerprint, bytes.data());
    return bytes == head;
  });
}

std::size_t MakeAnew(std::uint8_t* data, std::size_t max_size, test::Random& random) {
  const auto message = test::RandomMessage(AnyType(random).name, random);
  if (message.size() > max_size) return 0;
  std::copy(message.begin(), message.end(), data);
  return message.size();
}

void WriteLyingLength(std::uint8_t* data, std::size_t size, test::Random& random) {
  static constexpr std::array<std::uint32_t, 12> kLies{
      0,          1,          0x7F,       0xFF,       0x7FFF,     0xFFFF,
      0x1FFFFFFF, 0x20000001, 0x40000001, 0x7FFFFFFF, 0x80000000, 0xFFFFFFFF};
  if (size < kFingerprintBytes + 4) return;
  const std::uint32_t lie = kLies[random() % kLies.size()];
  std::uint8_t* const at = data + kFingerprintBytes + random() % (size - kFingerprintBytes - 3);
  for (int i = 0; i < 4; ++i) at[i] = static_cast<std::uint8_t>(lie >> (24 - 8 * i));
}

}  // namespace

std::size_t MutateMessage(std::uint8_t* data, std::size_t size, std::size_t max_size,
                          unsigned int seed) {
  test::Random random(seed);
  const unsigned choice = random() % 8;
  if (choice == 0 || size < kFingerprintBytes) {
    const std::size_t made = MakeAnew(data, max_size, random);
    if (made > 0) return made;
  }
  std::array<std::uint8_t, kFingerprintBytes> head{};
  if (size >= head.size()) std::memcpy(head.data(), data, head.size());
  if (choice <= 2) {
    WriteLyingLength(data, size, random);
  } else {
    size = LLVMFuzzerMutate(data, size, max_size);
  }
  if (size < head.size()) return size;
  if (HasType(head)) {
    std::memcpy(data, head.data(), head.size());
  } else {
    test::SetFingerprint(AnyType(random).fingerprint, data);
  }
  return size;
}

}  // namespace deixis::fuzz
