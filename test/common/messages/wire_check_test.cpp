// The check of bytes, over every type that there is.
#include "common/messages/wire_check.h"

#include <gmock/gmock.h>

#include <array>
#include <bot_core/images_t.hpp>
#include <deixis/body_poses_t.hpp>
#include <deixis/camera_calibration_t.hpp>
#include <deixis/hand_tracks_t.hpp>
#include <deixis/message_types.hpp>
#include <map>

#include "common/messages/wire.h"
#include "common/text/utf8.h"
#include "test/support/message_properties.h"
#include "test/support/random_message.h"

namespace deixis::messages {
namespace {

using Block = std::vector<std::uint8_t>;

Bytes View(const Block& block) { return {block.data(), block.size()}; }
std::string ReasonOf(const Block& block) { return Reason(CheckWire(View(block))); }

void WriteInt32(std::uint32_t value, Block& block, std::size_t at) {
  for (std::size_t i = 0; i < 4; ++i) {
    block[at + i] = static_cast<std::uint8_t>(value >> (24 - 8 * i));
  }
}

// Three whole messages of every type.
std::vector<std::pair<std::string, Block>> GoodMessages() {
  test::Random random(3);
  std::vector<std::pair<std::string, Block>> messages;
  for (const auto& type : test::AllWireTypes()) {
    for (int i = 0; i < 3; ++i) {
      messages.emplace_back(type.name, test::RandomMessage(type.name, random, 2));
    }
  }
  return messages;
}

TEST(WireTable, HasEveryTypeWithTheFingerprintOfTheGeneratedCode) {
  std::map<std::string, std::int64_t> generated;
  VisitMessageTypes(
      [&generated](auto type) { generated[type.name] = decltype(type)::type::getHash(); });
  std::map<std::string, std::int64_t> tabled;
  for (const auto& type : test::AllWireTypes()) tabled[type.name] = type.fingerprint;
  EXPECT_EQ(tabled, generated);
}

TEST(CheckWire, AcceptsWhatTheGeneratedCodeEncodes) {
  VisitMessageTypes([](auto type) {
    const typename decltype(type)::type message{};
    EXPECT_EQ(ReasonOf(EncodeWire(message)), "") << type.name;
  });
}

TEST(CheckWire, AcceptsWholeMessagesOfEveryTypeAndTheyDecode) {
  for (const auto& [name, message] : GoodMessages()) {
    EXPECT_EQ(ReasonOf(message), "") << name;
    EXPECT_EQ(test::BrokenProperty(View(message)), "") << name;
  }
}

TEST(CheckWire, FindsEveryTruncationOfEveryType) {
  for (const auto& [name, message] : GoodMessages()) {
    for (std::size_t size = 0; size < message.size(); ++size) {
      // A copy of its own, so that sanitisers see a step beyond its end.
      const Block part(message.begin(), message.begin() + static_cast<std::ptrdiff_t>(size));
      ASSERT_EQ(ReasonOf(part), "truncated") << name << ' ' << size;
    }
  }
}

TEST(CheckWire, FindsBytesBehindTheEndOfEveryType) {
  for (auto& [name, message] : GoodMessages()) {
    message.push_back(0);
    EXPECT_EQ(ReasonOf(message), "trailing_bytes") << name;
  }
}

// Wherever a length stands, it is among these.
TEST(CheckWire, SurvivesLiesInPlaceOfAnyFourBytesOfEveryType) {
  constexpr std::array<std::uint32_t, 9> kLies{0x00000100, 0x00010000, 0x01000000,
                                               0x1FFFFFFF, 0x20000001, 0x40000001,
                                               0x7FFFFFFF, 0x80000000, 0xFFFFFFFF};
  for (const auto& [name, message] : GoodMessages()) {
    for (std::size_t at = 8; at + 4 <= message.size(); ++at) {
      for (const std::uint32_t lie : kLies) {
        Block lying = message;
        WriteInt32(lie, lying, at);
        ASSERT_EQ(test::BrokenProperty(View(lying)), "") << name << ' ' << at << ' ' << lie;
      }
    }
  }
}

TEST(CheckWire, SurvivesRandomBytesBehindEveryFingerprint) {
  test::Random random(11);
  for (const auto& type : test::AllWireTypes()) {
    for (int i = 0; i < 500; ++i) {
      Block noise(8 + random() % 200);
      for (auto& byte : noise) byte = static_cast<std::uint8_t>(random());
      test::SetFingerprint(type.fingerprint, noise.data());
      ASSERT_EQ(test::BrokenProperty(View(noise)), "") << type.name << ' ' << i;
    }
  }
}

TEST(CheckWire, RefusesTwentyBytesThatClaimABillionImages) {
  Block message = EncodeWire(bot_core::images_t{});
  ASSERT_EQ(message.size(), 20u);
  WriteInt32(0x40000001, message, 16);
  EXPECT_EQ(ReasonOf(message), "truncated");
}

TEST(CheckWire, RefusesACalibrationThatClaimsGigabytesOfCoefficients) {
  const Block good = EncodeWire(camera_calibration_t{});
  Block message = good;
  const std::size_t count = 8 + 8 + 8 + 5 + 4 + 4 + 5;
  WriteInt32(0x20000001, message, count);
  EXPECT_EQ(ReasonOf(message), "truncated");
  message = good;
  WriteInt32(0xFFFFFFFF, message, count);
  EXPECT_EQ(ReasonOf(message), "bad_length");
}

// utime, sequence, then the text "ab" with its length at 24.
Block HandsFrom(const std::string& camera) {
  hand_tracks_t message{};
  message.camera = camera;
  return EncodeWire(message);
}

TEST(CheckWire, RefusesTextsThatTheirOnlyNulDoesNotEnd) {
  constexpr std::size_t kLength = 24;
  constexpr std::size_t kText = 28;
  const Block good = HandsFrom("ab");
  ASSERT_EQ(ReasonOf(good), "");
  Block message = good;
  message[kText + 2] = 'c';
  EXPECT_EQ(ReasonOf(message), "bad_string");
  message = good;
  message[kText] = 0;
  EXPECT_EQ(ReasonOf(message), "bad_string");
  message = good;
  WriteInt32(0, message, kLength);
  EXPECT_EQ(ReasonOf(message), "bad_string");
  WriteInt32(0xFFFFFFFF, message, kLength);
  EXPECT_EQ(ReasonOf(message), "bad_string");
  WriteInt32(0x7FFFFFFF, message, kLength);
  EXPECT_EQ(ReasonOf(message), "truncated");
}

TEST(CheckWire, RefusesTextsThatAreNoUtf8) {
  EXPECT_EQ(ReasonOf(HandsFrom("caf\xC3\xA9")), "");
  EXPECT_EQ(ReasonOf(HandsFrom("caf\xE9")), "bad_string");
}

TEST(CheckWire, RefusesBooleansThatAreNeither) {
  body_poses_t message{};
  message.has_floor = 1;
  EXPECT_EQ(ReasonOf(EncodeWire(message)), "");
  message.has_floor = 2;
  EXPECT_EQ(ReasonOf(EncodeWire(message)), "bad_boolean");
}

TEST(CheckWire, RefusesTypesThatItDoesNotKnow) { EXPECT_EQ(ReasonOf(Block(20, 0)), "wrong_type"); }

TEST(Utf8, IsTextByTheTableOfTheStandard) {
  const std::vector<std::string> good{"",
                                      "abc",
                                      "\x7F",
                                      "\xC2\x80",
                                      "\xDF\xBF",
                                      "\xE0\xA0\x80",
                                      "\xED\x9F\xBF",
                                      "\xEE\x80\x80",
                                      "\xF0\x90\x80\x80",
                                      "\xF4\x8F\xBF\xBF"};
  const std::vector<std::string> bad{std::string(1, '\0'),
                                     "\x80",
                                     "\xC0\x80",
                                     "\xC1\xBF",
                                     "\xC2",
                                     "\xC2\x41",
                                     "\xE0\x9F\xBF",
                                     "\xE1\x80",
                                     "\xED\xA0\x80",
                                     "\xEF\x80\x41",
                                     "\xF0\x8F\xBF\xBF",
                                     "\xF4\x90\x80\x80",
                                     "\xF5\x80\x80\x80",
                                     "\xF1\x80\x80",
                                     "\xFF"};
  const auto is_text = [](const std::string& content) { return text::IsUtf8(content); };
  EXPECT_THAT(good, testing::Each(testing::ResultOf(is_text, true)));
  EXPECT_THAT(bad, testing::Each(testing::ResultOf(is_text, false)));
}

}  // namespace
}  // namespace deixis::messages
