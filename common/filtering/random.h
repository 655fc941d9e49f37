#pragma once
#include <cstdint>

namespace deixis::filtering {

/// Random numbers as a function of (seed, stream, counter) instead of a state: the same ones come
/// out in whatever order, and by whatever number of threads, they are drawn (Salmon et al. 2011;
/// the mixing function is splitmix64's).
class CounterRandom {
 public:
  CounterRandom(std::uint64_t seed, std::uint64_t stream)
      : key_(Mix(seed ^ Mix(stream + kGolden))) {}

  std::uint64_t Bits(std::uint64_t counter) const { return Mix(key_ + counter * kGolden); }

  /// In [0, 1).
  float Uniform(std::uint64_t counter) const { return UniformFrom(Bits(counter)); }

  static float UniformFrom(std::uint64_t bits) { return static_cast<float>(bits >> 40) * 0x1p-24F; }

  /// Mean 0, variance 1: the sum of four uniform numbers (Irwin-Hall), whose tails end at 3.46.
  float Normal(std::uint64_t counter) const { return NormalFrom(Bits(counter)); }

  static float NormalFrom(std::uint64_t bits) {
    const auto sum =
        (bits & 0xFFFFU) + (bits >> 16 & 0xFFFFU) + (bits >> 32 & 0xFFFFU) + (bits >> 48 & 0xFFFFU);
    constexpr float kScale = 1.7320508F / 65536.0F;  // sqrt(12 / 4) per 16-bit step.
    return (static_cast<float>(static_cast<std::uint32_t>(sum)) - 131070.0F) * kScale;
  }

 private:
  static constexpr std::uint64_t kGolden = 0x9E3779B97F4A7C15U;

  static std::uint64_t Mix(std::uint64_t x) {
    x = (x ^ x >> 30) * 0xBF58476D1CE4E5B9U;
    x = (x ^ x >> 27) * 0x94D049BB133111EBU;
    return x ^ x >> 31;
  }

  std::uint64_t key_;
};

}  // namespace deixis::filtering
