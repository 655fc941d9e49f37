#include "common/program/run_service.h"

#include <gmock/gmock.h>

#include <csignal>

#include "common/messages/service_status.h"
#include "test/support/temporary_folder.h"

namespace deixis::program {
namespace {

using testing::HasSubstr;

struct CountdownConfig {
  int steps = 3;  ///< Steps until the source is finished; 0: it never is.
  bool raises_signal = false;
  template <typename Visitor>
  void Visit(Visitor& v) {
    v("steps", steps);
    v("raises_signal", raises_signal);
  }
  void Validate() const {
    config::Faults faults;
    faults.Require(steps >= 0, "steps", "must not be negative");
    faults.ThrowIfAny();
  }
};

int steps_done = 0;

class Countdown {
 public:
  Countdown(const CountdownConfig& config, transport::Bus&, transport::Bus&) : config_(config) {
    if (config.steps == 98) std::raise(SIGTERM);
    if (config.steps == 99) throw std::runtime_error("device /dev/none is missing; plug it in");
    steps_done = 0;
  }
  StepResult Step() {
    if (config_.raises_signal && steps_done == 2) std::raise(SIGTERM);
    return ++steps_done == config_.steps ? StepResult::kFinished : StepResult::kIdle;
  }

 private:
  CountdownConfig config_;
};

class RunServiceTest : public testing::Test {
 protected:
  int Run(const std::string& yaml, std::vector<std::string> arguments) {
    const std::string file = folder_.Write("countdown.yaml", yaml).string();
    arguments.insert(arguments.begin(), "deixis-countdown");
    arguments.insert(arguments.end(), {"--config", file, "--lcm-url", "memq://"});
    std::vector<char*> argv;
    for (std::string& argument : arguments) argv.push_back(argument.data());
    testing::internal::CaptureStderr();
    testing::internal::CaptureStdout();
    const int code = RunService<Countdown, CountdownConfig>(
        {"countdown", "Counts down."}, static_cast<int>(argv.size()), argv.data());
    errors_ = testing::internal::GetCapturedStderr();
    output_ = testing::internal::GetCapturedStdout();
    return code;
  }
  test::TemporaryFolder folder_;
  std::string errors_;
  std::string output_;
};

TEST_F(RunServiceTest, EndsWithZeroWhenTheSourceIsFinished) {
  EXPECT_EQ(Run("steps: 4", {}), 0);
  EXPECT_EQ(steps_done, 4);
}

TEST_F(RunServiceTest, EndsAtOnceWhenTheSignalComesWhileTheServiceIsMade) {
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  EXPECT_EXIT(
      {
        Run("steps: 98", {});
        std::abort();
      },
      testing::ExitedWithCode(0), "");
}

TEST_F(RunServiceTest, TakesOverridesFromTheCommandLine) {
  EXPECT_EQ(Run("steps: 4", {"--set", "steps=6"}), 0);
  EXPECT_EQ(steps_done, 6);
}

TEST_F(RunServiceTest, NamesAWrongKeyInOneLineAndEndsWithOne) {
  EXPECT_EQ(Run("stpes: 4", {}), 1);
  EXPECT_THAT(errors_, HasSubstr("stpes"));
  EXPECT_EQ(std::count(errors_.begin(), errors_.end(), '\n'), 1);
}

TEST_F(RunServiceTest, NamesAMissingDeviceInOneLineAndEndsWithOne) {
  EXPECT_EQ(Run("steps: 99", {}), 1);
  EXPECT_THAT(errors_, HasSubstr("/dev/none is missing; plug it in"));
  EXPECT_EQ(std::count(errors_.begin(), errors_.end(), '\n'), 1);
}

TEST_F(RunServiceTest, EndsWithTwoOnAnUnknownOption) { EXPECT_EQ(Run("", {"--no-such"}), 2); }

TEST_F(RunServiceTest, EndsWithTwoOnASettingWithoutAValue) {
  EXPECT_EQ(Run("", {"--set", "steps"}), 2);
  EXPECT_THAT(errors_, HasSubstr("key=value"));
}

TEST_F(RunServiceTest, EndsWithTwoOnAnEmptyNameOfTheConfiguration) {
  EXPECT_EQ(Run("", {"-c", ""}), 2);
  EXPECT_THAT(errors_, HasSubstr("is empty"));
}

TEST_F(RunServiceTest, ExplainsItselfAndSaysItsVersion) {
  EXPECT_EQ(Run("", {"--help"}), 0);
  EXPECT_THAT(output_, HasSubstr("Counts down."));
  EXPECT_EQ(Run("", {"--version"}), 0);
  EXPECT_THAT(output_, HasSubstr(DEIXIS_VERSION));
}

// Last: the signal stays requested in this process.
TEST_F(RunServiceTest, StopsCleanlyOnASignal) {
  const auto start = std::chrono::steady_clock::now();
  EXPECT_EQ(Run("{steps: 0, raises_signal: true}", {}), 0);
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(1));
  EXPECT_THAT(errors_, HasSubstr("stopped"));
}

}  // namespace
}  // namespace deixis::program
