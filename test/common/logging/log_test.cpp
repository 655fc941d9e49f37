#include "common/logging/log.h"

#include <gmock/gmock.h>

#include <algorithm>

namespace deixis::logging {
namespace {

using testing::HasSubstr;

std::string Logged(const std::string& value) {
  testing::internal::CaptureStderr();
  SetService("hand_tracker");
  Warn("message_dropped", {{"count", 3}, {"detail", value}});
  return testing::internal::GetCapturedStderr();
}

TEST(Log, WritesTimeLevelServiceEventAndFieldsInOneLine) {
  EXPECT_THAT(Logged("short"), testing::MatchesRegex("[0-9-]+T[0-9:.]+ warning hand_tracker "
                                                     "message_dropped count=3 detail=short\n"));
}

TEST(Log, QuotesValuesWithBlanks) {
  EXPECT_THAT(Logged("no \"face\" here"), HasSubstr("detail=\"no \\\"face\\\" here\""));
}

TEST(Log, StaysOneLineWhateverTheValueHolds) {
  const std::string text = Logged("a\nb\x1b[2J");
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 1);
  EXPECT_EQ(text.find('\x1b'), std::string::npos);
}

TEST(Log, DoesNotTakeValuesForFormats) { EXPECT_THAT(Logged("{}%s"), HasSubstr("detail={}%s")); }

}  // namespace
}  // namespace deixis::logging
