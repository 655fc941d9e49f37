#include "services/offline/offline_report.h"

#include <gmock/gmock.h>

#include "common/config/config.h"

namespace deixis::offline {
namespace {

using config::ConfigError;
using testing::AllOf;
using testing::HasSubstr;
using testing::ThrowsMessage;

class OfflineReportTest : public testing::Test {
 protected:
  OfflineReportTest() {
    summary_.events_read = 3;
    summary_.input_bytes = 1000;
    summary_.input_channels = {"CAMERA"};
    summary_.published = {{"HAND_TRACKS", 3}};
  }
  std::string Said() {
    testing::internal::CaptureStderr();
    Report(summary_, "in.lcmlog");
    return testing::internal::GetCapturedStderr();
  }
  auto Reporting() {
    return [this] { Report(summary_, "in.lcmlog"); };
  }
  Summary summary_;
};

TEST_F(OfflineReportTest, SaysWhatWasPublished) {
  EXPECT_THAT(Said(), HasSubstr("channel=HAND_TRACKS messages=3"));
}

TEST_F(OfflineReportTest, SaysWhereAndHowMuchIsLost) {
  summary_.damaged = {{100, 50}, {300, 7}};
  summary_.nameless_events = 2;
  EXPECT_THAT(Said(), AllOf(HasSubstr("offset=100 skipped_bytes=50"),
                            HasSubstr("offset=300 skipped_bytes=7"),
                            HasSubstr("skipped_bytes=57 of_bytes=1000 used_events=3"),
                            HasSubstr("nameless_events_skipped")));
}

TEST_F(OfflineReportTest, RefusesALogThatIsMostlyLost) {
  summary_.damaged = {{100, 501}};
  EXPECT_THAT(Reporting(), ThrowsMessage<ConfigError>(HasSubstr("most of log 'in.lcmlog'")));
}

TEST_F(OfflineReportTest, RefusesALogWithoutTheChannelsThatAreHeard) {
  summary_.published = {{"HAND_TRACKS", 0}};
  summary_.unheard_channels = {"FOOCAMERA", "FOOOBJECTS"};
  EXPECT_THAT(Reporting(), ThrowsMessage<ConfigError>(AllOf(
                               HasSubstr("nothing in log 'in.lcmlog' is on FOOCAMERA, FOOOBJECTS"),
                               HasSubstr("it has: CAMERA"), HasSubstr("--channel-prefix"))));
}

TEST_F(OfflineReportTest, RefusesALogWithoutMessages) {
  summary_.events_read = 0;
  EXPECT_THAT(Reporting(), ThrowsMessage<ConfigError>(HasSubstr("holds no messages")));
}

}  // namespace
}  // namespace deixis::offline
