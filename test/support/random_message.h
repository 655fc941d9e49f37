#pragma once
#include <cstdint>
#include <random>
#include <string>
#include <vector>

namespace deixis::test {

/// Cheap to seed, which fuzzers do for every message.
using Random = std::minstd_rand;

/// A message type, as the generated table knows it.
struct WireType {
  std::string name;  ///< package.struct
  std::int64_t fingerprint = 0;
};

/// All types, in the order of their names.
std::vector<WireType> AllWireTypes();

/// A whole message of type `name` with random content: arrays of up to `most_elements`, texts,
/// numbers that are zero as often as not.
std::vector<std::uint8_t> RandomMessage(const std::string& name, Random& random,
                                        unsigned most_elements = 3);

/// Writes `fingerprint` at the head of `message`, which has eight bytes or more.
void SetFingerprint(std::int64_t fingerprint, std::uint8_t* message);

}  // namespace deixis::test
