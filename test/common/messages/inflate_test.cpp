#include "common/messages/inflate.h"

#include <gtest/gtest.h>

#include <random>
#include <string>

namespace deixis::messages {
namespace {

using Block = std::vector<std::uint8_t>;

Bytes View(const Block& block) { return {block.data(), block.size()}; }

// Neither constant nor noise, as depth is.
Block Content(std::size_t size) {
  std::mt19937 random(7);
  Block content(size);
  for (std::size_t i = 0; i < size; ++i) {
    content[i] = static_cast<std::uint8_t>(i / 40 + random() % 4);
  }
  return content;
}

std::string ReasonFor(const Block& stream, std::size_t expected_size) {
  try {
    InflateExactly(View(stream), expected_size);
  } catch (const Rejected& rejected) {
    return rejected.what();
  }
  return "accepted";
}

TEST(InflateExactly, GivesBackWhatWasDeflated) {
  for (const int level : {0, 1, 6, 9}) {
    for (const std::size_t size : {0u, 1u, 1000u, 153600u}) {
      const Block content = Content(size);
      EXPECT_EQ(InflateExactly(View(Deflate(View(content), level)), size), content)
          << level << ' ' << size;
    }
  }
}

TEST(InflateExactly, RejectsContentOfAnotherSize) {
  const Block stream = Deflate(View(Content(1000)), 1);
  EXPECT_EQ(ReasonFor(stream, 1000), "accepted");
  EXPECT_EQ(ReasonFor(stream, 1001), "zlib_too_short");
  EXPECT_EQ(ReasonFor(stream, 2000), "zlib_too_short");
  EXPECT_EQ(ReasonFor(stream, 999), "zlib_too_long");
  EXPECT_EQ(ReasonFor(stream, 0), "zlib_too_long");
}

TEST(InflateExactly, RejectsEveryTruncation) {
  const Block whole = Deflate(View(Content(300)), 9);
  for (std::size_t size = 0; size < whole.size(); ++size) {
    const Block part(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(size));
    EXPECT_EQ(ReasonFor(part, 300), "zlib_too_short") << size;
  }
}

TEST(InflateExactly, RejectsBytesBehindTheStream) {
  Block stream = Deflate(View(Content(1000)), 1);
  stream.push_back(0);
  EXPECT_EQ(ReasonFor(stream, 1000), "zlib_trailing_bytes");
}

// The checksums see to it; only the bits that fill up the last byte of the code mean nothing.
TEST(InflateExactly, RejectsEveryDamagedBit) {
  const Block whole = Deflate(View(Content(300)), 6);
  int accepted = 0;
  for (std::size_t at = 0; at < whole.size(); ++at) {
    for (int bit = 0; bit < 8; ++bit) {
      Block damaged = whole;
      damaged[at] = static_cast<std::uint8_t>(damaged[at] ^ 1 << bit);
      if (ReasonFor(damaged, 300) == "accepted") ++accepted;
    }
  }
  EXPECT_LE(accepted, 7);
}

TEST(InflateExactly, RejectsGarbage) {
  EXPECT_EQ(ReasonFor(Block(100, 0x5A), 1000), "zlib_damaged");
  EXPECT_EQ(ReasonFor(Block(100, 0x00), 1000), "zlib_damaged");
}

TEST(InflateExactly, RejectsAZipBombWithoutTakingItsContent) {
  const Block bomb = Deflate(View(Block(std::size_t{64} << 20, 0)), 9);
  EXPECT_LT(bomb.size(), 70000u);
  EXPECT_EQ(ReasonFor(bomb, 614400), "zlib_too_long");
}

// 4 GB less one byte: taken, this would show.
TEST(InflateExactly, TakesNoMemoryForMoreThanSoFewBytesCanHold) {
  EXPECT_EQ(ReasonFor(Deflate(View(Content(1000)), 1), 0xFFFFFFFF), "zlib_too_short");
  EXPECT_EQ(ReasonFor(Deflate(View(Content(1000)), 1), ~std::size_t{0}), "too_large");
}

TEST(Deflate, RefusesLevelsThatZlibHasNot) {
  EXPECT_THROW(Deflate({}, 10), std::logic_error);
  EXPECT_THROW(Deflate({}, -1), std::logic_error);
}

}  // namespace
}  // namespace deixis::messages
