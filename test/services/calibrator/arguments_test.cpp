#include "services/calibrator/arguments.h"

#include <gtest/gtest.h>

namespace deixis::calibrator::test {
namespace {

ParsedArguments Parse(std::vector<const char*> words) {
  words.insert(words.begin(), "deixis-calibrator");
  return ParseArguments(static_cast<int>(words.size()), words.data());
}

TEST(Arguments, OfACamera) {
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

TEST(Arguments, OfAStereoPairWithACharuco) {
  const auto parsed =
      Parse({"stereo", "--charuco", "7x5", "--square", "0.035", "--marker", "0.026", "--left",
             "l1.png", "l2.png", "--right", "r1.png", "r2.png", "-o", "folder", "--force"});
  ASSERT_FALSE(parsed.exit_code);
  EXPECT_EQ(parsed.arguments.task, Task::kStereo);
  EXPECT_EQ(parsed.arguments.board.kind, BoardKind::kCharuco);
  EXPECT_EQ(parsed.arguments.feed.right.size(), 2u);
  EXPECT_EQ(parsed.arguments.permissions.existing, Existing::kReplace);
  EXPECT_TRUE(parsed.arguments.permissions.may_write_poor);
}

class WrongArguments : public ::testing::TestWithParam<std::vector<const char*>> {};

TEST_P(WrongArguments, EndWithTwo) { EXPECT_EQ(Parse(GetParam()).exit_code, 2); }

INSTANTIATE_TEST_SUITE_P(
    All, WrongArguments,
    ::testing::Values(
        std::vector<const char*>{}, std::vector<const char*>{"camera"},
        std::vector<const char*>{"camera", "--board", "9", "--square", "0.02", "--pictures", "a",
                                 "-o", "c"},
        std::vector<const char*>{"camera", "--board", "9x1", "--square", "0.02", "--pictures", "a",
                                 "-o", "c"},
        std::vector<const char*>{"camera", "--board", "9x6", "--square", "25", "--pictures", "a",
                                 "-o", "c"},
        std::vector<const char*>{"camera", "--square", "0.02", "--pictures", "a", "-o", "c"},
        std::vector<const char*>{"camera", "--board", "9x6", "--square", "0.02", "-o", "c"},
        std::vector<const char*>{"camera", "--board", "9x6", "--square", "0.02", "--pictures", "a",
                                 "--source", "device:0", "-o", "c"},
        std::vector<const char*>{"stereo", "--board", "9x6", "--square", "0.02", "--left", "a",
                                 "-o", "c"},
        std::vector<const char*>{"stereo", "--board", "9x6", "--square", "0.02", "--source",
                                 "device:0", "-o", "c"},
        std::vector<const char*>{"camera", "--charuco", "7x5", "--square", "0.02", "--marker",
                                 "0.03", "--pictures", "a", "-o", "c"},
        std::vector<const char*>{"board", "--board", "9x6", "--square", "0.02", "--print",
                                 "b.doc"}));

TEST(Arguments, HelpEndsWithZero) { EXPECT_EQ(Parse({"stereo", "--help"}).exit_code, 0); }

}  // namespace
}  // namespace deixis::calibrator::test
