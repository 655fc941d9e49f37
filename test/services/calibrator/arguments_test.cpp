#include "services/calibrator/arguments.h"

#include <gtest/gtest.h>

#include <iterator>
#include <sstream>

namespace deixis::calibrator::test {
namespace {

ParsedArguments Parse(std::vector<const char*> words) {
  words.insert(words.begin(), "deixis-calibrator");
  return ParseArguments(static_cast<int>(words.size()), words.data());
}

TEST(CalibratorArguments, OfACamera) {
  const auto parsed = Parse({"camera", "--board", "8x5", "--square", "0.03", "--pictures", "a.png",
                             "--model", "rational", "--fix-aspect", "-o", "c.yml"});
  ASSERT_FALSE(parsed.exit_code);
  const Arguments& arguments = parsed.arguments;
  EXPECT_EQ(arguments.task, Task::kCamera);
  EXPECT_EQ(arguments.board.count, cv::Size(8, 5));
  EXPECT_EQ(arguments.calibration.lens.model, LensModel::kRational);
  EXPECT_TRUE(arguments.calibration.lens.has_fixed_aspect);
  EXPECT_EQ(arguments.permissions.existing, Existing::kKeep);
}

TEST(CalibratorArguments, OfAStereoPairWithACharuco) {
  const auto parsed =
      Parse({"stereo", "--charuco", "7x5", "--square", "0.035", "--marker", "0.026", "--left",
             "l1.png", "l2.png", "--right", "r1.png", "r2.png", "-o", "folder"});
  ASSERT_FALSE(parsed.exit_code);
  EXPECT_EQ(parsed.arguments.task, Task::kStereo);
  EXPECT_EQ(parsed.arguments.board.kind, BoardKind::kCharuco);
  EXPECT_EQ(parsed.arguments.feed.right.size(), 2u);
}

TEST(CalibratorArguments, ToReplaceIsNotToAcceptPoorResults) {
  const auto permissions = [](const char* flag) {
    return Parse(
               {"camera", "--board", "9x6", "--square", "0.02", "--pictures", "a", "-o", "c", flag})
        .arguments.permissions;
  };
  EXPECT_EQ(permissions("--force").existing, Existing::kReplace);
  EXPECT_FALSE(permissions("--force").may_write_poor);
  EXPECT_EQ(permissions("--accept-poor").existing, Existing::kKeep);
  EXPECT_TRUE(permissions("--accept-poor").may_write_poor);
}

TEST(CalibratorArguments, HelpTellsTheCommandAsItWasCalled) {
  for (const auto& [called, shown] :
       {std::pair{"deixis calibrate", "deixis calibrate"},
        std::pair{"build/bin/deixis-calibrator", "deixis-calibrator"}}) {
    const std::vector<const char*> words{called, "camera", "--help"};
    ::testing::internal::CaptureStdout();
    EXPECT_EQ(ParseArguments(static_cast<int>(words.size()), words.data()).exit_code, 0);
    EXPECT_NE(
        ::testing::internal::GetCapturedStdout().find(std::string("Usage: ") + shown + " camera "),
        std::string::npos);
  }
}

class WrongCalibratorArguments : public ::testing::TestWithParam<std::string> {};

TEST_P(WrongCalibratorArguments, EndWithTwo) {
  std::istringstream line(GetParam());
  const std::vector<std::string> words{std::istream_iterator<std::string>(line), {}};
  std::vector<const char*> pointers;
  for (const std::string& word : words) pointers.push_back(word.c_str());
  EXPECT_EQ(Parse(pointers).exit_code, 2);
}

INSTANTIATE_TEST_SUITE_P(
    All, WrongCalibratorArguments,
    ::testing::Values("", "camera", "camera --board 9 --square 0.02 --pictures a -o c",
                      "camera --board 9x1 --square 0.02 --pictures a -o c",
                      "camera --board 9x6 --square 25 --pictures a -o c",
                      "camera --square 0.02 --pictures a -o c",
                      "camera --board 9x6 --square 0.02 -o c",
                      "camera --board 9x6 --square 0.02 --pictures a --source device:0 -o c",
                      "stereo --board 9x6 --square 0.02 --left a -o c",
                      "stereo --board 9x6 --square 0.02 --source device:0 -o c",
                      "stereo --board 9x6 --square 0.02 --left a --right b --model fisheye -o c",
                      "camera --charuco 7x5 --square 0.02 --marker 0.03 --pictures a -o c",
                      "board --board 9x6 --square 0.02 --print b.doc"));

TEST(CalibratorArguments, HelpEndsWithZero) { EXPECT_EQ(Parse({"stereo", "--help"}).exit_code, 0); }

}  // namespace
}  // namespace deixis::calibrator::test
