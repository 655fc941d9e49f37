#include "services/offline/offline_arguments.h"

#include <gmock/gmock.h>

namespace deixis::offline {
namespace {

using testing::ElementsAre;

class OfflineArgumentsTest : public testing::Test {
 protected:
  static ParsedArguments Parse(std::vector<const char*> options) {
    std::vector<const char*> argv{"deixis-offline", "in", "out"};
    argv.insert(argv.end(), options.begin(), options.end());
    testing::internal::CaptureStderr();
    testing::internal::CaptureStdout();
    ParsedArguments parsed = ParseArguments(static_cast<int>(argv.size()), argv.data());
    testing::internal::GetCapturedStderr();
    testing::internal::GetCapturedStdout();
    return parsed;
  }
};

TEST_F(OfflineArgumentsTest, TakesServicesAndTheirSettings) {
  const auto [arguments, exit_code] =
      Parse({"--services", "hand_tracker", "--set", "hand_tracker.tracker.a=1", "--set",
             "hand_tracker.b=*.jpg", "--config", "hand_tracker=h.yaml", "--threads", "2"});
  EXPECT_FALSE(exit_code);
  EXPECT_THAT(arguments.services, ElementsAre("hand_tracker"));
  EXPECT_THAT(arguments.configuration.overrides.at("hand_tracker"),
              ElementsAre("tracker.a=1", "b=*.jpg"));
  EXPECT_EQ(arguments.configuration.files.at("hand_tracker"), "h.yaml");
  EXPECT_EQ(arguments.threads, 2);
}

TEST_F(OfflineArgumentsTest, HostsThePointingChainByDefault) {
  EXPECT_EQ(Parse({}).arguments.services, DefaultServices());
  EXPECT_THAT(DefaultServices(),
              testing::ElementsAre("object_detector", "hand_tracker", "gesture_recogniser"));
}

TEST_F(OfflineArgumentsTest, RefusesNumbersOfThreadsThatNoMachineHas) {
  for (const char* threads : {"100000", "-1", "0", "257"}) {
    EXPECT_EQ(Parse({"--threads", threads}).exit_code, 2) << threads;
  }
}

TEST_F(OfflineArgumentsTest, RefusesAnUnknownService) {
  EXPECT_EQ(Parse({"--services", "hand_trakcer"}).exit_code, 2);
  EXPECT_EQ(Parse({"--services", "hand_tracker,viewer"}).exit_code, 2);
}

TEST_F(OfflineArgumentsTest, RefusesSettingsThatAreNone) {
  for (const char* setting : {"foo", "foo=1", "hand_tracker.foo", "viewer.window=true"}) {
    EXPECT_EQ(Parse({"--set", setting}).exit_code, 2) << setting;
  }
  for (const char* file : {"h.yaml", "hand_tracker=", "viewer=v.yaml"}) {
    EXPECT_EQ(Parse({"--config", file}).exit_code, 2) << file;
  }
}

}  // namespace
}  // namespace deixis::offline
