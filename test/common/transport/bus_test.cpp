#include "common/transport/bus.h"

#include <gmock/gmock.h>

#include <limits>
#include <stdexcept>

#include "common/messages/hands.h"
#include "common/messages/objects.h"
#include "test/support/memory_bus.h"

namespace deixis::transport {
namespace {

using scene::Hands;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::ThrowsMessage;

constexpr std::chrono::milliseconds kSoon{100};

Hands At(std::int64_t time) { return {{time}, "CAMERA", "", {}}; }

messages::ChannelStatistics Received(const Bus& bus, const std::string& channel) {
  for (const auto& statistics : bus.statistics()) {
    if (statistics.channel == channel && statistics.direction == messages::Direction::kIn) {
      return statistics;
    }
  }
  ADD_FAILURE() << "no statistics of " << channel;
  return {};
}

messages::Bytes BytesOf(const std::vector<std::uint8_t>& bytes) {
  return {bytes.data(), bytes.size()};
}

class BusTest : public testing::Test {
 protected:
  void Collect(Delivery delivery, const std::string& channel = "HANDS") {
    bus_.Subscribe<Hands>(channel, delivery, [this](const Hands& hands) {
      times_.push_back(hands.time.microseconds);
    });
  }
  Bus bus_{test::Memory()};
  std::vector<std::int64_t> times_;
};

TEST_F(BusTest, DeliversEveryMessageInOrder) {
  Collect(Delivery::kEvery);
  for (int i = 1; i <= 5; ++i) bus_.Publish("HANDS", At(i));
  test::HandleAll(bus_);
  EXPECT_THAT(times_, ElementsAre(1, 2, 3, 4, 5));
}

TEST_F(BusTest, DeliversOnlyTheNewestAndCountsTheRest) {
  Collect(Delivery::kLatest);
  for (int i = 1; i <= 5; ++i) bus_.Publish("HANDS", At(i));
  test::HandleAll(bus_);
  EXPECT_THAT(times_, ElementsAre(5));
  EXPECT_EQ(Received(bus_, "HANDS").skipped, 4);
}

TEST_F(BusTest, SkippedMessagesAreGapsToNobody) {
  Collect(Delivery::kLatest);
  bus_.Publish("HANDS", At(1));
  test::HandleAll(bus_);
  for (int i = 2; i <= 4; ++i) bus_.Publish("HANDS", At(i));
  test::HandleAll(bus_);
  EXPECT_EQ(Received(bus_, "HANDS").gaps, 0);
  EXPECT_EQ(Received(bus_, "HANDS").skipped, 2);
}

TEST_F(BusTest, OfflineEveryPictureIsDelivered) {
  BusOptions options = test::Memory();
  options.deliver_every_message = true;
  Bus bus(options);
  int count = 0;
  bus.Subscribe<Hands>("HANDS", Delivery::kLatest, [&](const Hands&) { ++count; });
  for (int i = 1; i <= 5; ++i) bus.Publish("HANDS", At(i));
  test::HandleAll(bus);
  EXPECT_EQ(count, 5);
}

TEST_F(BusTest, SurvivesAnExceptionInAHandler) {
  int calls = 0;
  bus_.Subscribe<Hands>("HANDS", Delivery::kEvery, [&](const Hands&) {
    if (++calls == 1) throw std::runtime_error("our own bug");
  });
  bus_.Publish("HANDS", At(1));
  bus_.Publish("HANDS", At(2));
  test::HandleAll(bus_);
  EXPECT_EQ(calls, 2);
  EXPECT_EQ(Received(bus_, "HANDS").drops.at("handler_failed"), 1);
}

TEST_F(BusTest, CountsWhatAHandlerRefusesByItsReason) {
  bus_.Subscribe<Hands>("HANDS", Delivery::kEvery,
                        [](const Hands&) { throw messages::Rejected("late_hands"); });
  bus_.Publish("HANDS", At(1));
  bus_.Publish("HANDS", At(2));
  test::HandleAll(bus_);
  EXPECT_EQ(Received(bus_, "HANDS").drops.at("late_hands"), 2);
  EXPECT_EQ(Received(bus_, "HANDS").drops.count("handler_failed"), 0U);
}

TEST_F(BusTest, SurvivesAnExceptionThatIsNoStandardOne) {
  int calls = 0;
  bus_.Subscribe<Hands>("HANDS", Delivery::kEvery, [&](const Hands&) {
    if (++calls == 1) throw 42;
  });
  bus_.Publish("HANDS", At(1));
  bus_.Publish("HANDS", At(2));
  test::HandleAll(bus_);
  EXPECT_EQ(calls, 2);
}

TEST_F(BusTest, DropsAndCountsWhatIsOfAnotherType) {
  Collect(Delivery::kEvery);
  bus_.Publish("HANDS", scene::Objects{});
  bus_.Publish("HANDS", At(2));
  test::HandleAll(bus_);
  EXPECT_THAT(times_, ElementsAre(2));
  EXPECT_EQ(Received(bus_, "HANDS").drops.at("wrong_type"), 1);
}

TEST_F(BusTest, DropsAndCountsWhatIsTooShortOrTooLong) {
  Collect(Delivery::kEvery);
  bus_.PublishRaw("HANDS", BytesOf({1, 2, 3}), {0});
  auto bytes = messages::Codec<Hands>::Encode(At(1), 0);
  bytes.push_back(0);
  bus_.PublishRaw("HANDS", BytesOf(bytes), {0});
  bus_.Publish("HANDS", At(2));
  test::HandleAll(bus_);
  EXPECT_THAT(times_, ElementsAre(2));
  EXPECT_EQ(Received(bus_, "HANDS").drops.at("truncated"), 1);
  EXPECT_EQ(Received(bus_, "HANDS").drops.at("trailing_bytes"), 1);
}

TEST_F(BusTest, DropsANegativeLength) {
  Collect(Delivery::kEvery);
  auto bytes = messages::Codec<Hands>::Encode(At(1), 0);
  for (std::size_t i = bytes.size() - 4; i < bytes.size(); ++i) bytes[i] = 0xFF;  // n_hands = -1
  bus_.PublishRaw("HANDS", BytesOf(bytes), {0});
  bus_.Publish("HANDS", At(2));
  test::HandleAll(bus_);
  EXPECT_THAT(times_, ElementsAre(2));
}

TEST_F(BusTest, CountsGapsBetweenSequenceNumbers) {
  Collect(Delivery::kEvery);
  for (const std::int64_t sequence : {0, 1, 4, 5}) {
    bus_.PublishRaw("HANDS", BytesOf(messages::Codec<Hands>::Encode(At(1), sequence)), {0});
  }
  test::HandleAll(bus_);
  EXPECT_EQ(Received(bus_, "HANDS").gaps, 2);
}

TEST_F(BusTest, APublisherThatStartsAnewLeavesNoGap) {
  Collect(Delivery::kEvery);
  for (const std::int64_t sequence : {100, 0, 1}) {
    bus_.PublishRaw("HANDS", BytesOf(messages::Codec<Hands>::Encode(At(1), sequence)), {0});
  }
  test::HandleAll(bus_);
  EXPECT_EQ(Received(bus_, "HANDS").gaps, 0);
}

TEST_F(BusTest, NumbersThatCannotBeLeaveTheCountersAlone) {
  Collect(Delivery::kEvery);
  constexpr std::int64_t kLargest = std::numeric_limits<std::int64_t>::max();
  for (const std::int64_t sequence : {std::int64_t{0}, kLargest, -kLargest - 1, std::int64_t{1}}) {
    bus_.PublishRaw("HANDS", BytesOf(messages::Codec<Hands>::Encode(At(1), sequence)), {0});
  }
  test::HandleAll(bus_);
  EXPECT_EQ(Received(bus_, "HANDS").drops.at("out_of_range"), 2);
  EXPECT_EQ(Received(bus_, "HANDS").gaps, 0);
}

TEST_F(BusTest, AForgedNumberIsNoLoss) {
  Collect(Delivery::kEvery);
  for (const std::int64_t sequence :
       {std::int64_t{0}, std::int64_t{1} << 60, std::int64_t{1}, std::int64_t{100'003},
        std::int64_t{2}, std::int64_t{100'003}}) {
    bus_.PublishRaw("HANDS", BytesOf(messages::Codec<Hands>::Encode(At(1), sequence)), {0});
  }
  test::HandleAll(bus_);
  EXPECT_EQ(Received(bus_, "HANDS").gaps, 100'000);  // Of the last step alone.
}

TEST(Bus, SaysThatNoServerAnswers) {
  BusOptions options;
  options.url = "tcpq://localhost:1";
  EXPECT_THAT([&options] { Bus bus(options); },
              ThrowsMessage<BusError>(HasSubstr("lcm-tcpq-server")));
}

TEST_F(BusTest, TakesAChannelNameByItsLetters) {
  Collect(Delivery::kEvery, "/cup#sensor_msgs.Image");
  bus_.Publish("/cup#sensor_msgs.Image", At(1));
  bus_.Publish("/cup#sensor_msgs_Image", At(2));
  test::HandleAll(bus_);
  EXPECT_THAT(times_, ElementsAre(1));
}

TEST_F(BusTest, RefusesChannelNamesThatCannotTravel) {
  for (const std::string& name : {std::string(), std::string("HANDS.*"), std::string(64, 'A')}) {
    EXPECT_THAT([&] { Collect(Delivery::kEvery, name); },
                ThrowsMessage<BusError>(HasSubstr("63 of the characters")));
    EXPECT_THROW(bus_.Publish(name, At(1)), BusError) << name;
  }
  Collect(Delivery::kEvery, std::string(63, 'A'));
}

TEST_F(BusTest, NumbersEachChannelByItself) {
  Collect(Delivery::kEvery, "A");
  Collect(Delivery::kEvery, "B");
  for (int i = 0; i < 3; ++i) {
    bus_.Publish("A", At(i));
    bus_.Publish("B", At(i));
  }
  test::HandleAll(bus_);
  EXPECT_EQ(Received(bus_, "A").gaps, 0);
  EXPECT_EQ(Received(bus_, "B").gaps, 0);
}

TEST_F(BusTest, SetsThePrefixInFrontOfEveryChannel) {
  BusOptions options = test::Memory();
  options.channel_prefix = "ROBOT_";
  Bus bus(options);
  std::vector<std::string> channels;
  int count = 0;
  bus.SubscribeRaw(".*", [&](const RawMessage& raw) { channels.push_back(raw.channel); });
  bus.Subscribe<Hands>("HANDS", Delivery::kEvery, [&](const Hands&) { ++count; });
  bus.Publish("HANDS", At(1));
  test::HandleAll(bus);
  EXPECT_THAT(channels, ElementsAre("ROBOT_HANDS"));
  EXPECT_EQ(count, 1);
}

TEST_F(BusTest, LeavesTheNamesOfForeignChannelsAsTheyAre) {
  constexpr const char* kForeign = "/hands#package.Hands";
  BusOptions options = test::Memory();
  options.channel_prefix = "ROBOT_";
  Bus bus(options);
  bus.SubscribeForeign<Hands>(kForeign, Delivery::kEvery, [this](const Hands& hands) {
    times_.push_back(hands.time.microseconds);
  });
  bus.PublishRaw(kForeign, BytesOf(messages::Codec<Hands>::Encode(At(7), 0)), {7});
  bus.Publish(kForeign, At(8));
  test::HandleAll(bus);
  EXPECT_THAT(times_, ElementsAre(7));
  EXPECT_EQ(Received(bus, kForeign).messages, 1);
}

TEST_F(BusTest, RefusesAForeignChannelThatIsNoName) {
  EXPECT_THROW(bus_.SubscribeForeign<Hands>("/all.*", Delivery::kEvery, [](const Hands&) {}),
               BusError);
}

TEST_F(BusTest, RawSubscribersSeeUndecodableMessages) {
  std::size_t size = 0;
  bus_.SubscribeRaw("ODD", [&](const RawMessage& raw) { size = raw.bytes.size; });
  bus_.PublishRaw("ODD", BytesOf({9, 9}), {0});
  test::HandleAll(bus_);
  EXPECT_EQ(size, 2u);
}

TEST_F(BusTest, MeasuresProcessingTimeOfHandledMessages) {
  Collect(Delivery::kEvery);
  EXPECT_EQ(bus_.processing_ms().p50, -1.0);
  bus_.Publish("HANDS", At(1));
  test::HandleAll(bus_);
  EXPECT_GE(bus_.processing_ms().p50, 0.0);
  EXPECT_EQ(bus_.age_ms().p50, -1.0);  // a memory bus is not live
}

TEST_F(BusTest, WaitsNoLongerThanAskedFor) {
  Collect(Delivery::kEvery);
  const auto start = std::chrono::steady_clock::now();
  EXPECT_EQ(bus_.Handle(kSoon), 0);
  EXPECT_LT(std::chrono::steady_clock::now() - start, 10 * kSoon);
}

}  // namespace
}  // namespace deixis::transport
