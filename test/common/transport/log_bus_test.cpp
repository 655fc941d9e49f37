// Buses on log files.
#include <gmock/gmock.h>

#include "common/messages/hands.h"
#include "common/transport/bus.h"
#include "test/support/temporary_folder.h"

namespace deixis::transport {
namespace {

using scene::Hands;
using testing::ElementsAre;

BusOptions File(const std::filesystem::path& path, const std::string& options) {
  BusOptions bus;
  bus.url = "file://" + path.string() + "?" + options;
  return bus;
}

void WriteLog(const std::filesystem::path& path, std::initializer_list<std::int64_t> times) {
  Bus bus(File(path, "mode=w"));
  for (const std::int64_t time : times) bus.Publish("HANDS", Hands{{time}, "CAMERA", "", {}});
  bus.Flush();
}

TEST(LogBus, ReadsBackWhatItWrote) {
  test::TemporaryFolder folder;
  WriteLog(folder.path() / "a.lcmlog", {10, 20, 30});
  Bus bus(File(folder.path() / "a.lcmlog", "speed=0"));
  std::vector<std::int64_t> times;
  bus.Subscribe<Hands>("HANDS", Delivery::kEvery,
                       [&](const Hands& hands) { times.push_back(hands.time.microseconds); });
  for (int i = 0; i < 100 && !bus.is_exhausted(); ++i) bus.Handle(std::chrono::milliseconds{50});
  EXPECT_TRUE(bus.is_exhausted());
  EXPECT_THAT(times, ElementsAre(10, 20, 30));
}

TEST(LogBus, SameMessagesGiveTheSameBytes) {
  test::TemporaryFolder folder;
  WriteLog(folder.path() / "a.lcmlog", {10, 20});
  WriteLog(folder.path() / "b.lcmlog", {10, 20});
  const std::string bytes = test::FileContent(folder.path() / "a.lcmlog");
  EXPECT_GT(bytes.size(), 100u);
  EXPECT_EQ(bytes, test::FileContent(folder.path() / "b.lcmlog"));
}

TEST(LogBus, SaysThatALogCannotBeWritten) {
  EXPECT_THROW(Bus(File("/no/such/folder/a.lcmlog", "mode=w")), BusError);
}

TEST(LogBus, SaysThatADiskIsFull) {
  Bus bus(File("/dev/full", "mode=w"));
  bus.Publish("HANDS", Hands{});
  EXPECT_THROW(bus.Flush(), BusError);
}

TEST(LogBus, SaysThatALogCannotBeRead) {
  EXPECT_THROW(Bus(File("/no/such/folder/a.lcmlog", "speed=0")), BusError);
}

TEST(LogBus, NothingIsReceivedFromALogThatIsWritten) {
  test::TemporaryFolder folder;
  Bus bus(File(folder.path() / "a.lcmlog", "mode=w"));
  EXPECT_THROW(bus.Subscribe<Hands>("HANDS", Delivery::kEvery, [](const Hands&) {}), BusError);
}

}  // namespace
}  // namespace deixis::transport
