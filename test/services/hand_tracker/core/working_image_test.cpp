#include "services/hand_tracker/core/working_image.h"

#include <gtest/gtest.h>

namespace deixis::hand_tracker {
namespace {

TEST(WorkingImage, ReducesWideImagesAndTakesSmallOnesAsTheyAre) {
  EXPECT_EQ(Reduce(cv::Mat::zeros(480, 640, CV_8UC3), 320).bgr.size(), cv::Size(320, 240));
  EXPECT_EQ(Reduce(cv::Mat::zeros(720, 1280, CV_8UC3), 320).bgr.size(), cv::Size(320, 180));
  const WorkingImage small = Reduce(cv::Mat::zeros(120, 160, CV_8UC3), 320);
  EXPECT_EQ(small.bgr.size(), cv::Size(160, 120));
  EXPECT_DOUBLE_EQ(small.scale, 1.0);
}

TEST(WorkingImage, PointsComeBackWhereTheyWere) {
  const Eigen::Vector2d full(123.4, 56.7);
  EXPECT_TRUE(ToFull(ToWorking(full, 2.5), 2.5).isApprox(full, 1e-12));
  // Two pixels side by side become one, whose centre lies between theirs.
  EXPECT_TRUE(ToFull(Eigen::Vector2d(0, 0), 2.0).isApprox(Eigen::Vector2d(0.5, 0.5)));
}

TEST(WorkingImage, BoxesComeBackWhereTheyWere) {
  const scene::Box box{10, 20, 30, 40};
  const scene::Box back = ToFull(ToWorking(box, 2.0), 2.0);
  EXPECT_NEAR(back.x_px, box.x_px, 1e-12);
  EXPECT_NEAR(back.height_px, box.height_px, 1e-12);
}

}  // namespace
}  // namespace deixis::hand_tracker
