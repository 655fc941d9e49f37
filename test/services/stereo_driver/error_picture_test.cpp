#include "services/stereo_driver/evaluation/error_picture.h"

#include <gtest/gtest.h>

#include <opencv2/imgcodecs.hpp>

#include "test/support/temporary_folder.h"

namespace deixis::stereo_driver {
namespace {

TEST(ErrorPicture, HasACaptionBelowEachOfItsThreePanels) {
  const test::TemporaryFolder folder;
  const cv::Size size(320, 240);
  const RectifiedDepth result{cv::Mat(size, CV_8UC3, cv::Scalar(1, 2, 3)),
                              cv::Mat(size / 2, CV_16UC1, cv::Scalar(2000))};
  WriteErrorPicture(folder.path(), "walk", result, cv::Mat(size, CV_32FC1, cv::Scalar(0.1)));
  const cv::Mat picture = cv::imread((folder.path() / "depth_walk.png").string());
  ASSERT_EQ(picture.cols, 3 * size.width);
  ASSERT_GT(picture.rows, size.height);
  EXPECT_EQ(picture.at<cv::Vec3b>(0, 0), cv::Vec3b(1, 2, 3));
  for (int panel = 0; panel < 3; ++panel) {
    const cv::Mat caption = picture(cv::Range(size.height, picture.rows),
                                    cv::Range(panel * size.width, (panel + 1) * size.width));
    EXPECT_LT(cv::norm(caption.row(0) - cv::Scalar::all(255)), 1.0) << "paper above the text";
    double darkest = 255.0;
    cv::minMaxLoc(caption.reshape(1), &darkest);
    EXPECT_LT(darkest, 100.0) << panel;
    // Text that is too long would run out on the right.
    EXPECT_LT(cv::norm(caption.col(size.width - 1) - cv::Scalar::all(255)), 1.0) << panel;
  }
}

}  // namespace
}  // namespace deixis::stereo_driver
