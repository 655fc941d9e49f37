#include "services/offline/offline_host.h"

#include <gmock/gmock.h>

#include <ctime>
#include <filesystem>
#include <fstream>

#include "common/messages/camera_pose.h"
#include "common/messages/hands.h"
#include "common/messages/objects.h"
#include "test/support/temporary_folder.h"

namespace deixis::offline {
namespace {

using scene::Hands;
using scene::Objects;
using testing::ElementsAre;
using transport::Bus;
using transport::Delivery;

// Answers every message of `input` with one on `output` at the same time.
class Echo final : public HostedService {
 public:
  Echo(const std::string& input, const std::string& output, Bus& bus) : output_(output) {
    bus.Subscribe<Hands>(input, Delivery::kLatest,
                         [&bus, output](const Hands& hands) { bus.Publish(output, hands); });
  }
  std::vector<std::string> OutputChannels() const override { return {output_}; }

 private:
  std::string output_;
};

// Works for five milliseconds on every message of `input`.
class Busy final : public HostedService {
 public:
  Busy(const std::string& input, Bus& bus) {
    bus.Subscribe<Hands>(input, Delivery::kEvery, [](const Hands&) {
      const std::clock_t end = std::clock() + CLOCKS_PER_SEC / 200;
      while (std::clock() < end) {
      }
    });
  }
  std::vector<std::string> OutputChannels() const override { return {}; }
};

class OfflineHostTest : public testing::Test {
 protected:
  std::string Path(const std::string& name) { return (folder_.path() / name).string(); }
  static transport::BusOptions Log(const std::string& path) {
    transport::BusOptions options;
    options.url = "file://" + path + "?mode=w";
    return options;
  }
  void WriteInput(const std::vector<std::pair<std::string, std::int64_t>>& events) {
    Bus bus(Log(Path("in.lcmlog")));
    for (const auto& [channel, time] : events) bus.Publish(channel, Hands{{time}, "C", "", {}});
    bus.Flush();
  }
  Summary Run(OutputContent content = OutputContent::kEverything,
              const std::string& output = "out.lcmlog", const std::string& prefix = "") {
    LogReader input(Path("in.lcmlog"));
    OfflineHost host(prefix);
    host.Add(std::make_unique<Echo>("A", "B", host.bus()));
    host.Add(std::make_unique<Echo>("B", "C", host.bus()));
    Bus log(Log(Path(output)));
    return host.Run(input, log, content, [](double) {});
  }
  /// Of each of the `count` events of the input, all being alike.
  std::int64_t EventBytes(int count) {
    return static_cast<std::int64_t>(std::filesystem::file_size(Path("in.lcmlog"))) / count;
  }
  void Overwrite(std::int64_t offset, const std::string& bytes) {
    std::fstream file(Path("in.lcmlog"), std::ios::in | std::ios::out | std::ios::binary);
    file.seekp(offset);
    file << bytes;
  }
  std::vector<std::string> Events(const std::string& name = "out.lcmlog") {
    std::vector<std::string> events;
    LogReader reader(Path(name));
    while (reader.Next()) {
      events.push_back(reader.event().channel + "@" + std::to_string(reader.event().received_us));
    }
    return events;
  }
  test::TemporaryFolder folder_;
};

TEST_F(OfflineHostTest, FinishesAllThatFollowsBeforeTheNextInput) {
  WriteInput({{"A", 10}, {"A", 20}});
  const Summary summary = Run();
  EXPECT_THAT(Events(), ElementsAre("A@10", "B@10", "C@10", "A@20", "B@20", "C@20"));
  EXPECT_EQ(summary.events_read, 2);
  EXPECT_EQ(summary.published.at("C"), 2);
}

TEST_F(OfflineHostTest, TellsWhichServiceSpentTheTime) {
  WriteInput({{"A", 10}, {"A", 20}});
  {
    LogReader input(Path("in.lcmlog"));
    ServiceTimes times(Path("times.csv"));
    OfflineHost host("", &times);
    host.Add(std::make_unique<Busy>("A", host.bus()), "busy");
    host.Add(std::make_unique<Echo>("A", "B", host.bus()), "idle");
    Bus log(Log(Path("out.lcmlog")));
    host.Run(input, log, OutputContent::kEverything, [](double) {});
  }
  std::ifstream file(Path("times.csv"));
  std::string line;
  std::getline(file, line);
  EXPECT_EQ(line, "service,channel,time_us,cpu_us");
  std::map<std::string, std::int64_t> spent_us;
  while (std::getline(file, line)) {
    const auto last = line.rfind(',');
    spent_us[line.substr(0, last)] += std::stoll(line.substr(last + 1));
  }
  for (const char* of_busy : {"busy,A,10", "busy,A,20"}) EXPECT_GE(spent_us[of_busy], 5000);
  for (const auto& [of, time_us] : spent_us) {
    if (of.rfind("busy,A", 0) == 0) continue;
    EXPECT_LT(time_us, 3000) << of;
  }
}

TEST_F(OfflineHostTest, SaysWhenTimesCannotBeWritten) {
  EXPECT_THROW(ServiceTimes(Path("no/such/folder/times.csv")), transport::BusError);
}

TEST_F(OfflineHostTest, LeavesTheInputOutOnRequest) {
  WriteInput({{"A", 10}, {"OTHER", 20}});
  Run(OutputContent::kResultsOnly);
  EXPECT_THAT(Events(), ElementsAre("B@10", "C@10"));
}

TEST_F(OfflineHostTest, KeepsChannelsThatNobodyReads) {
  WriteInput({{"OTHER", 20}});
  Run();
  EXPECT_THAT(Events(), ElementsAre("OTHER@20"));
}

using Contents = std::vector<std::pair<std::string, std::vector<std::uint8_t>>>;

Contents ReadContents(const std::string& path) {
  Contents contents;
  LogReader reader(path);
  while (reader.Next()) {
    const transport::RawMessage& event = reader.event();
    contents.emplace_back(
        event.channel,
        std::vector<std::uint8_t>(event.bytes.data, event.bytes.data + event.bytes.size));
  }
  return contents;
}

TEST_F(OfflineHostTest, PassesPosesAndUnknownTypesThroughByteByByte) {
  const geometry::CameraPose pose{{10},
                                  {Eigen::Quaterniond(0.5, -0.5, 0.5, -0.5), {0.1, -0.2, 1.4}}};
  const std::vector<std::uint8_t> unknown{0, 1, 2, 255, 254, 3, 4, 5, 6, 7};
  {
    Bus bus(Log(Path("in.lcmlog")));
    bus.Publish("CAMERA_POSE", pose);
    bus.PublishRaw("/robot#nobody.Knows", {unknown.data(), unknown.size()}, {20});
    bus.Flush();
  }
  Run();
  EXPECT_THAT(ReadContents(Path("out.lcmlog")),
              ElementsAre(testing::Pair("CAMERA_POSE",
                                        messages::Codec<geometry::CameraPose>::Encode(pose, -1)),
                          testing::Pair("/robot#nobody.Knows", unknown)));
  EXPECT_THAT(Events(), ElementsAre("CAMERA_POSE@10", "/robot#nobody.Knows@20"));
}

TEST_F(OfflineHostTest, ReplacesOldResultsOfTheServicesItHosts) {
  WriteInput({{"A", 10}, {"B", 11}});
  const Summary summary = Run();
  EXPECT_THAT(Events(), ElementsAre("A@10", "B@10", "C@10"));
  EXPECT_EQ(summary.events_replaced, 1);
}

TEST_F(OfflineHostTest, LeavesStatusMessagesOut) {
  WriteInput({{"SERVICE_STATUS", 10}});
  Run();
  EXPECT_TRUE(Events().empty());
}

TEST_F(OfflineHostTest, HandlesEveryOneOfManyMessages) {
  std::vector<std::pair<std::string, std::int64_t>> events;
  for (int i = 0; i < 3000; ++i) events.emplace_back("A", i);
  WriteInput(events);
  EXPECT_EQ(Run().published.at("C"), 3000);
}

TEST_F(OfflineHostTest, SameLogGivesTheSameBytes) {
  WriteInput({{"A", 10}, {"A", 20}, {"OTHER", 30}});
  Run(OutputContent::kEverything, "one.lcmlog");
  Run(OutputContent::kEverything, "two.lcmlog");
  const std::string bytes = test::FileContent(Path("one.lcmlog"));
  EXPECT_FALSE(bytes.empty());
  EXPECT_EQ(bytes, test::FileContent(Path("two.lcmlog")));
}

TEST_F(OfflineHostTest, TakesAPrefixedLog) {
  WriteInput({{"ROBOT_A", 10}});
  Run(OutputContent::kResultsOnly, "out.lcmlog", "ROBOT_");
  EXPECT_THAT(Events(), ElementsAre("ROBOT_B@10", "ROBOT_C@10"));
}

TEST_F(OfflineHostTest, CountsWhatDoesNotDecode) {
  {
    Bus bus(Log(Path("in.lcmlog")));
    bus.Publish("A", Objects{});
  }
  EXPECT_EQ(Run().drops.at("A: wrong_type"), 1);
}

TEST_F(OfflineHostTest, UsesALogThatIsCutOffUpToItsLastWholeEvent) {
  WriteInput({{"A", 10}, {"A", 20}});
  const auto size = std::filesystem::file_size(Path("in.lcmlog"));
  std::filesystem::resize_file(Path("in.lcmlog"), size - 5);
  const Summary summary = Run();
  EXPECT_EQ(summary.events_read, 1);
  ASSERT_EQ(summary.damaged.size(), 1u);
  EXPECT_EQ(summary.damaged[0].offset, static_cast<std::int64_t>(size) / 2);
  EXPECT_EQ(summary.damaged[0].bytes, static_cast<std::int64_t>(size) / 2 - 5);
}

TEST_F(OfflineHostTest, GoesOnBehindNoiseInTheMiddle) {
  WriteInput({{"A", 10}, {"A", 20}, {"A", 30}, {"A", 40}});
  const std::int64_t event = EventBytes(4);
  Overwrite(event + 3, "noise over the second event's head");
  const Summary summary = Run(OutputContent::kResultsOnly);
  EXPECT_THAT(Events(), ElementsAre("B@30", "C@30", "B@40", "C@40"));  // The first may be short.
  ASSERT_EQ(summary.damaged.size(), 1u);
  EXPECT_EQ(summary.damaged[0].offset, 0);
  EXPECT_EQ(summary.damaged[0].bytes, 2 * event);
}

TEST_F(OfflineHostTest, GoesOnBehindALengthThatIsWrong) {
  WriteInput({{"A", 10}, {"A", 20}, {"A", 30}, {"A", 40}});
  const std::int64_t event = EventBytes(4);
  Overwrite(event + 24, std::string("\x7f\0\0\0", 4));
  const Summary summary = Run();
  EXPECT_EQ(summary.events_read, 3);
  ASSERT_EQ(summary.damaged.size(), 1u);
  EXPECT_EQ(summary.damaged[0].offset, event);
  EXPECT_EQ(summary.damaged[0].bytes, event);
}

TEST_F(OfflineHostTest, GoesOnBehindNoiseAtTheFront) {
  WriteInput({{"A", 10}, {"A", 20}});
  const std::string log = test::FileContent(Path("in.lcmlog"));
  folder_.Write("in.lcmlog", std::string(5000, '\x5a') + log);
  const Summary summary = Run();
  EXPECT_EQ(summary.events_read, 2);
  ASSERT_EQ(summary.damaged.size(), 1u);
  EXPECT_EQ(summary.damaged[0].bytes, 5000);
}

TEST_F(OfflineHostTest, PassesOverEventsWithoutAChannel) {
  WriteInput({{"A", 10}, {"A", 20}});
  const std::string log = test::FileContent(Path("in.lcmlog"));
  const std::string nameless = std::string("\xED\xA1\xDA\x01", 4) + std::string(24, '\0');
  folder_.Write("in.lcmlog", log + nameless + log);
  const Summary summary = Run();
  EXPECT_EQ(summary.events_read, 4);
  EXPECT_EQ(summary.nameless_events, 1);
  EXPECT_TRUE(summary.damaged.empty());
}

TEST_F(OfflineHostTest, ReadsALogOfNothingButEventHeads) {
  std::string heads;
  for (int i = 0; i < 20'000; ++i) heads += std::string("\xED\xA1\xDA\x01", 4);
  folder_.Write("in.lcmlog", heads);
  const Summary summary = Run();
  EXPECT_EQ(summary.events_read, 0);
  ASSERT_EQ(summary.damaged.size(), 1u);
  EXPECT_EQ(summary.damaged[0].bytes, 80'000);
}

TEST_F(OfflineHostTest, NamesChannelsThatTheInputHasNot) {
  WriteInput({{"OTHER", 10}});
  const Summary summary = Run();
  EXPECT_THAT(summary.unheard_channels, ElementsAre("A"));  // B comes from a service.
  EXPECT_THAT(summary.input_channels, ElementsAre("OTHER"));
}

TEST_F(OfflineHostTest, StopsAtOnceWhenTheOutputCannotBeWritten) {
  std::vector<std::pair<std::string, std::int64_t>> events(3000, {"A", 10});
  WriteInput(events);
  LogReader input(Path("in.lcmlog"));
  OfflineHost host("");
  Bus log(Log("/dev/full"));
  EXPECT_THROW(host.Run(input, log, OutputContent::kEverything, [](double) {}),
               transport::BusError);
  EXPECT_LT(input.progress(), 0.9);
}

TEST_F(OfflineHostTest, SaysThatALogIsMissing) {
  EXPECT_THROW(LogReader("/no/such/log"), transport::BusError);
  EXPECT_THROW(LogReader(folder_.path().string()), transport::BusError);
}

}  // namespace
}  // namespace deixis::offline
