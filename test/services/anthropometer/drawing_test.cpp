#include "services/anthropometer/core/drawing.h"

#include <gtest/gtest.h>

#include <opencv2/core.hpp>

#include "common/body_model/joint_angles.h"
#include "test/services/anthropometer/person.h"

namespace deixis::anthropometer {
namespace {

/// Rows from the highest to the lowest pixel that is not paper.
int HeightOf(const cv::Mat& picture) {
  int first = -1, last = -1;
  for (int y = 0; y < picture.rows; ++y) {
    for (int x = 0; x < picture.cols; ++x) {
      if (picture.at<cv::Vec3b>(y, x) == picture.at<cv::Vec3b>(0, 0)) continue;
      if (first < 0) first = y;
      last = y;
    }
  }
  return last - first + 1;
}

TEST(Drawing, ShowsThePersonAsTallAsHeIsInBothViews) {
  const body_model::BodyModel model = TallMan("whole_body_detailed");
  for (const View view : {View::kFront, View::kSide}) {
    const cv::Mat picture = Draw(model, Standing(model), view, 400, 2.0);
    EXPECT_EQ(picture.size(), cv::Size(400, 400));
    EXPECT_NEAR(HeightOf(picture), 1.8 * 200.0, 8.0);
  }
}

TEST(Drawing, ShowsTheLeftSideOnTheRightFromTheFront) {
  const body_model::BodyModel model = TallMan("whole_body");
  const cv::Mat picture = Draw(model, Standing(model), View::kFront, 400, 2.0);
  cv::Mat mirrored;
  cv::flip(picture, mirrored, 1);
  EXPECT_GT(cv::norm(picture, mirrored, cv::NORM_INF), 50.0);  // Of other colours.
  const cv::Vec3b arm_on_the_left = picture.at<cv::Vec3b>(200, 160);
  EXPECT_GT(arm_on_the_left[2], arm_on_the_left[0]);  // The right side is warmer.
}

TEST(Drawing, DoesNotDependOnWhereTheBodyIs) {
  const body_model::BodyModel model = TallMan("upper_body");
  body_model::BodyPose pose = Standing(model);
  const cv::Mat here = DrawFrontAndSide(model, pose, 200);
  pose.frame_from_root.translation_m = {5.0, -3.0, 2.0};
  pose.frame_from_root.rotation = Eigen::Quaterniond(0.0, 1.0, 0.0, 0.0);
  EXPECT_EQ(cv::norm(here, DrawFrontAndSide(model, pose, 200), cv::NORM_INF), 0.0);
  EXPECT_EQ(here.size(), cv::Size(400, 200));
}

}  // namespace
}  // namespace deixis::anthropometer
