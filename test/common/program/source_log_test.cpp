#include "common/program/source_log.h"

#include <gmock/gmock.h>

namespace deixis::program {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

std::string LoggedBy(SourceLog& log, const std::string& remark, const std::string& trouble) {
  testing::internal::CaptureStderr();
  log.Note(remark, trouble);
  return testing::internal::GetCapturedStderr();
}

TEST(SourceLog, TellsEachThingOnce) {
  SourceLog log;
  EXPECT_EQ(LoggedBy(log, "", ""), "");
  EXPECT_THAT(LoggedBy(log, "guessed", ""), AllOf(HasSubstr("calibration"), HasSubstr("guessed")));
  EXPECT_EQ(LoggedBy(log, "guessed", ""), "");
}

TEST(SourceLog, TellsThatACalibrationHasBecomeKnown) {
  SourceLog log;
  LoggedBy(log, "guessed", "");
  EXPECT_THAT(LoggedBy(log, "", ""),
              AllOf(HasSubstr("calibration_known"), Not(HasSubstr("remark"))));
  EXPECT_EQ(LoggedBy(log, "", ""), "");
}

TEST(SourceLog, TellsThatASourceIsLostAndThatItIsThereAgain) {
  SourceLog log;
  EXPECT_THAT(LoggedBy(log, "", "device lost"),
              AllOf(HasSubstr("warning"), HasSubstr("source_lost"), HasSubstr("device lost")));
  EXPECT_EQ(LoggedBy(log, "", "device lost, trying again in 2 s"), "");
  EXPECT_THAT(LoggedBy(log, "", ""), HasSubstr("source_recovered"));
  EXPECT_EQ(LoggedBy(log, "", ""), "");
}

}  // namespace
}  // namespace deixis::program
