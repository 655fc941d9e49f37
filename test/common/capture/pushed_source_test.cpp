#include "common/capture/pushed_source.h"

#include <gmock/gmock.h>

#include <opencv2/core.hpp>

namespace deixis::capture {
namespace {

using testing::HasSubstr;

TEST(PushedSource, GivesTheNewestAndCountsTheOthers) {
  PushedSource source("/camera", [] { return Timestamp{0}; });
  EXPECT_EQ(source.Next().state, SourceState::kWaiting);
  source.Push(images::Image{{1}, "", cv::Mat(2, 2, CV_8UC3)});
  source.Push(images::Image{{2}, "", cv::Mat(2, 2, CV_8UC3)});
  EXPECT_EQ(source.Next().picture->time.microseconds, 2);
  EXPECT_EQ(source.Next().state, SourceState::kWaiting);
  EXPECT_EQ(source.status().skipped, 1);
}

TEST(PushedSource, IsInTroubleWhenNothingComes) {
  std::int64_t now_us = 10'000'000;
  PushedSource source("/camera", [&now_us] { return Timestamp{now_us}; });
  EXPECT_EQ(source.status().trouble, "");
  now_us += 4'000'000;
  EXPECT_THAT(source.status().trouble, HasSubstr("no picture yet on '/camera'"));
  source.Push(images::Image{{1}, "", cv::Mat(2, 2, CV_8UC3)});
  EXPECT_EQ(source.status().trouble, "");
  now_us += 4'000'000;
  EXPECT_THAT(source.status().trouble, HasSubstr("no more pictures on '/camera'"));
}

}  // namespace
}  // namespace deixis::capture
