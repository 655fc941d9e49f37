// Runs the program: what its command line answers.
#include <gmock/gmock.h>
#include <sys/wait.h>

#include <cstdlib>

#include "test/support/temporary_folder.h"

namespace deixis::gesture_recogniser {
namespace {

class EvaluatePointingTest : public testing::Test {
 protected:
  int Run(const std::string& options) {
    const std::string program = std::string(DEIXIS_BINARY_DIR) + "/bin/deixis-evaluate-pointing";
    const std::string command = "DEIXIS_CONFIG_DIR=\"" + std::string(DEIXIS_SOURCE_DIR) +
                                "/config\" \"" + program + "\" --recordings \"" +
                                folder_.path().string() + "\" " + options + " > /dev/null 2>&1";
    return WEXITSTATUS(std::system(command.c_str()));
  }
  void AddRecording() { folder_.Write("a.recording", "recording a someone\nframe 0\n"); }
  test::TemporaryFolder folder_;
};

TEST_F(EvaluatePointingTest, RunsColumnsOverRecordings) {
  AddRecording();
  EXPECT_EQ(Run("--seeds 1"), 0);
  EXPECT_EQ(Run("--seeds 1 --column plain --column other:recogniser.hands=acting"), 0);
}

TEST_F(EvaluatePointingTest, FailsOnAFolderWithoutRecordings) { EXPECT_EQ(Run("--seeds 1"), 1); }

TEST_F(EvaluatePointingTest, FailsOnASettingThatIsNotKnown) {
  AddRecording();
  EXPECT_EQ(Run("--seeds 1 --column a:no_such_key=1"), 1);
}

TEST_F(EvaluatePointingTest, RefusesACommandLineThatIsWrong) {
  AddRecording();
  for (const std::string options :
       {"--set foo", "--column foo:bad", "--column :a=1", "--column \"\"", "--seeds 0",
        "--noise-px -1", "--config \"\""}) {
    EXPECT_EQ(Run(options), 2) << options;
  }
}

}  // namespace
}  // namespace deixis::gesture_recogniser
