#include "common/transport/status_reporter.h"

#include <gmock/gmock.h>
#include <unistd.h>

#include "common/messages/hands.h"
#include "test/support/memory_bus.h"

namespace deixis::transport {
namespace {

using messages::ServiceStatus;
using scene::Hands;

TEST(Health, TextHoldsWhatThereIsToSay) {
  Health health;
  health.Say("");
  health.SayCount(0, "corrupt pictures");
  EXPECT_EQ(health.text, "");
  health.Say("guessed");
  health.SayCount(5, "corrupt pictures");
  EXPECT_EQ(health.text, "guessed; 5 corrupt pictures");
}

class StatusReporterTest : public testing::Test {
 protected:
  StatusReporterTest() {
    bus_.Subscribe<ServiceStatus>(
        kStatusChannel, Delivery::kEvery,
        [this](const ServiceStatus& status) { received_.push_back(status); });
  }
  Bus bus_{test::Memory()};
  std::vector<ServiceStatus> received_;
};

TEST_F(StatusReporterTest, SaysWhoAndHow) {
  StatusReporter reporter({"hand_tracker", "left"}, bus_, bus_);
  reporter.Report(messages::ServiceState::kDegraded, "no face");
  test::HandleAll(bus_);
  ASSERT_EQ(received_.size(), 1u);
  EXPECT_EQ(received_[0].service, "hand_tracker");
  EXPECT_EQ(received_[0].instance, "left");
  EXPECT_EQ(received_[0].pid, getpid());
  EXPECT_EQ(received_[0].version, DEIXIS_VERSION);
  EXPECT_EQ(received_[0].state, messages::ServiceState::kDegraded);
  EXPECT_EQ(received_[0].text, "no face");
}

TEST_F(StatusReporterTest, IsDegradedAndSaysSoWhileTwoPublishOnOneChannel) {
  bus_.Subscribe<Hands>("HANDS", Delivery::kEvery, [](const Hands&) {});
  for (int i = 0; i < 10; ++i) {
    for (const std::int64_t sequence : {100 + i, 500 + i}) {
      const auto bytes = messages::Codec<Hands>::Encode(Hands{{i}, "", "", {}}, sequence);
      bus_.PublishRaw("HANDS", {bytes.data(), bytes.size()}, {i});
    }
  }
  test::HandleAll(bus_);
  StatusReporter reporter({"x", ""}, bus_, bus_);
  reporter.Report(messages::ServiceState::kRunning, "well");
  test::HandleAll(bus_);
  ASSERT_EQ(received_.size(), 1u);
  EXPECT_EQ(received_[0].state, messages::ServiceState::kDegraded);
  EXPECT_THAT(received_[0].text, testing::StartsWith("well; two publishers send on HANDS"));
  for (const auto& channel : received_[0].channels) EXPECT_EQ(channel.gaps, 0);
}

TEST_F(StatusReporterTest, ReportsAtOnceAndThenNotBeforeASecond) {
  StatusReporter reporter({"x", ""}, bus_, bus_);
  for (int i = 0; i < 5; ++i) reporter.ReportIfDue(messages::ServiceState::kRunning, "");
  test::HandleAll(bus_);
  EXPECT_EQ(received_.size(), 1u);
}

TEST_F(StatusReporterTest, CarriesTheCountersOfEveryChannel) {
  bus_.Subscribe<Hands>("HANDS", Delivery::kEvery, [](const Hands&) {});
  bus_.Publish("HANDS", Hands{});
  bus_.PublishRaw("HANDS", {nullptr, 0}, {0});
  test::HandleAll(bus_);
  StatusReporter reporter({"x", ""}, bus_, bus_);
  reporter.Report(messages::ServiceState::kRunning, "");
  test::HandleAll(bus_);
  ASSERT_EQ(received_.size(), 1u);
  std::int64_t in = 0;
  std::int64_t out = 0;
  std::int64_t dropped = 0;
  for (const auto& channel : received_[0].channels) {
    if (channel.channel != "HANDS") continue;
    (channel.direction == messages::Direction::kIn ? in : out) += channel.messages;
    for (const auto& drop : channel.drops) dropped += drop.second;
  }
  EXPECT_EQ(in, 1);
  EXPECT_EQ(out, 2);
  EXPECT_EQ(dropped, 1);
}

}  // namespace
}  // namespace deixis::transport
