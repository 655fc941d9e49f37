#include "services/stereo_driver/core/depth_camera/depth_camera.h"

#include <gtest/gtest.h>

#include <opencv2/core.hpp>
#include <utility>

namespace deixis::stereo_driver {
namespace {

geometry::StereoCalibration WithoutDistortion(cv::Size size) {
  geometry::StereoCalibration calibration;
  calibration.left = geometry::GuessCalibration(size.width, size.height, 1.0);
  calibration.right = calibration.rectified = calibration.left;
  return calibration;
}

geometry::StereoCalibration WithDistortion(cv::Size size) {
  geometry::StereoCalibration calibration = WithoutDistortion(size);
  calibration.left.distortion_model = geometry::DistortionModel::kPlumbBob;
  calibration.left.distortion = {-0.3, 0.1, 0.0, 0.0, 0.0};
  return calibration;
}

images::RgbdImage Frame(cv::Size colour, cv::Size depth) {
  return {{{1}, "", cv::Mat(colour, CV_8UC3, cv::Scalar(10, 20, 30))},
          {{1}, "", cv::Mat(depth, CV_16UC1, cv::Scalar(2000))}};
}

TEST(DepthCamera, LeavesWhatHasNoDistortionAsItIs) {
  DepthCamera camera(WithoutDistortion({64, 48}), Size::kFull);
  images::RgbdImage image = Frame({64, 48}, {64, 48});
  image.depth.depth_mm.at<std::uint16_t>(7, 9) = 1234;
  const RectifiedDepth& result = camera.Rectify(image);
  EXPECT_EQ(cv::norm(result.depth_mm, image.depth.depth_mm, cv::NORM_INF), 0.0);
  EXPECT_EQ(cv::norm(result.left_bgr, image.colour.bgr, cv::NORM_INF), 0.0);
}

TEST(DepthCamera, HalvesDepthThatIsAsLargeAsThePicture) {
  DepthCamera camera(WithoutDistortion({64, 48}), Size::kHalf);
  EXPECT_EQ(camera.Rectify(Frame({64, 48}, {64, 48})).depth_mm.size(), cv::Size(32, 24));
}

TEST(DepthCamera, LeavesDepthThatIsSmallerAlready) {
  DepthCamera camera(WithoutDistortion({64, 48}), Size::kHalf);
  EXPECT_EQ(camera.Rectify(Frame({64, 48}, {32, 24})).depth_mm.size(), cv::Size(32, 24));
}

// A straight edge that the lens has bent is straight again, in the depth as in the picture.
TEST(DepthCamera, MovesPictureAndDepthAlike) {
  images::RgbdImage image = Frame({64, 48}, {64, 48});
  const cv::Rect square(4, 3, 12, 9);
  image.colour.bgr(square) = cv::Scalar(200, 200, 200);
  image.depth.depth_mm(square) = 900;
  DepthCamera camera(WithDistortion({64, 48}), Size::kFull);
  const RectifiedDepth& result = camera.Rectify(image);
  int differing = 0;
  int inside = 0;
  for (int y = 0; y < 48; ++y) {
    for (int x = 0; x < 64; ++x) {
      const bool is_bright = result.left_bgr.at<cv::Vec3b>(y, x)[0] > 100;
      const bool is_near = result.depth_mm.at<std::uint16_t>(y, x) == 900;
      inside += is_near ? 1 : 0;
      differing += is_bright == is_near ? 0 : 1;
    }
  }
  EXPECT_GT(inside, 40);
  EXPECT_LT(differing, 12);  // The picture is interpolated at the edge, the depth is not.
  EXPECT_EQ(result.depth_mm.at<std::uint16_t>(24, 32), 2000);
}

TEST(DepthCamera, MakesUpNoDistances) {
  images::RgbdImage image = Frame({64, 48}, {64, 48});
  image.depth.depth_mm(cv::Rect(0, 0, 31, 48)) = 700;
  DepthCamera camera(WithDistortion({64, 48}), Size::kHalf);
  const cv::Mat& depth_mm = camera.Rectify(image).depth_mm;
  for (auto value = depth_mm.begin<std::uint16_t>(); value != depth_mm.end<std::uint16_t>();
       ++value) {
    EXPECT_TRUE(*value == 0 || *value == 700 || *value == 2000) << *value;
  }
}

TEST(DepthCamera, TakesDepthOfAnotherSizeThanThePicture) {
  DepthCamera camera(WithDistortion({64, 48}), Size::kFull);
  EXPECT_EQ(camera.Rectify(Frame({64, 48}, {32, 24})).depth_mm.size(), cv::Size(32, 24));
  EXPECT_EQ(camera.Rectify(Frame({64, 48}, {16, 12})).depth_mm.size(), cv::Size(16, 12));
}

TEST(DepthCamera, LeavesDepthThatHasNoHalf) {
  DepthCamera camera(WithoutDistortion({8, 1}), Size::kHalf);
  EXPECT_EQ(camera.Rectify(Frame({8, 1}, {8, 1})).depth_mm.size(), cv::Size(8, 1));
}

TEST(HalveDepth, CoversAnOddViewToBothItsEnds) {
  const cv::Mat depth_mm = (cv::Mat_<std::uint16_t>(2, 5) << 1000, 1000, 9, 0, 3000,  //
                            1000, 1000, 9, 0, 3000);
  cv::Mat halved_mm;
  HalveDepth(depth_mm, halved_mm);
  EXPECT_EQ(halved_mm.size(), cv::Size(2, 1));
  EXPECT_EQ(halved_mm.at<std::uint16_t>(0, 0), 1000);
  EXPECT_EQ(halved_mm.at<std::uint16_t>(0, 1), 3000);
}

/// Depth of the colour camera's own place and lens.
DepthView SameView(const geometry::CameraCalibration& lens, cv::Size depth_size) {
  DepthView view;
  view.lens = geometry::Scaled(lens, depth_size.width, depth_size.height);
  return view;
}

images::RgbdImage NoisyFrame(cv::Size colour, cv::Size depth) {
  images::RgbdImage image = Frame(colour, depth);
  cv::RNG random(9);
  random.fill(image.depth.depth_mm, cv::RNG::UNIFORM, 1985, 2015);
  image.depth.depth_mm(cv::Rect(0, 0, depth.width / 3, depth.height)) = 800;
  image.depth.depth_mm.row(5).setTo(0);
  return image;
}

TEST(DepthCamera, GivesByIdentityWhatTheSensorsRegistrationGives) {
  const auto calibration = WithoutDistortion({64, 48});
  for (const Size size : {Size::kFull, Size::kHalf}) {
    const images::RgbdImage image = NoisyFrame({64, 48}, {64, 48});
    DepthCamera sensor(calibration, size);
    DepthCamera registering(calibration, size, SameView(calibration.left, {64, 48}));
    const cv::Mat expected_mm = sensor.Rectify(image).depth_mm;
    const RectifiedDepth& result = registering.Rectify(image);
    EXPECT_EQ(result.depth_mm.size(), expected_mm.size());
    EXPECT_EQ(cv::norm(result.depth_mm, expected_mm, cv::NORM_INF), 0.0);
    EXPECT_EQ(cv::norm(result.left_bgr, image.colour.bgr, cv::NORM_INF), 0.0);
  }
}

TEST(DepthCamera, GivesByIdentityAlmostTheSameOfALensWithDistortion) {
  const auto calibration = WithDistortion({64, 48});
  const images::RgbdImage image = NoisyFrame({64, 48}, {64, 48});
  DepthCamera sensor(calibration, Size::kFull);
  DepthCamera registering(calibration, Size::kFull, SameView(calibration.left, {64, 48}));
  const cv::Mat expected_mm = sensor.Rectify(image).depth_mm;
  cv::Mat difference_mm;
  cv::absdiff(registering.Rectify(image).depth_mm, expected_mm, difference_mm);
  // One takes the nearest pixel, the other interpolates: noise, but at edges.
  EXPECT_LT(cv::countNonZero(difference_mm > 30), 64 * 48 / 30);
}

TEST(DepthCamera, RegistersToTheSizeThatIsAskedWhateverTheDepthHas) {
  const auto calibration = WithDistortion({64, 48});
  for (const cv::Size depth : {cv::Size(16, 12), cv::Size(32, 24), cv::Size(128, 96)}) {
    const images::RgbdImage image = Frame({64, 48}, depth);
    for (const auto& [size, expected] :
         {std::pair(Size::kFull, cv::Size(64, 48)), std::pair(Size::kHalf, cv::Size(32, 24))}) {
      DepthCamera camera(calibration, size, SameView(calibration.left, depth));
      const cv::Mat& depth_mm = camera.Rectify(image).depth_mm;
      EXPECT_EQ(depth_mm.size(), expected) << depth;
      EXPECT_EQ(depth_mm.at<std::uint16_t>(12, 16), 2000) << depth;
    }
  }
}

TEST(HalveDepth, AveragesTheNearestSurfaceOnly) {
  const cv::Mat depth_mm = (cv::Mat_<std::uint16_t>(2, 4) << 1000, 1010, 0, 0, 0, 3000, 0, 0);
  cv::Mat halved_mm;
  HalveDepth(depth_mm, halved_mm);
  EXPECT_EQ(halved_mm.at<std::uint16_t>(0, 0), 1005);
  EXPECT_EQ(halved_mm.at<std::uint16_t>(0, 1), 0);
}

}  // namespace
}  // namespace deixis::stereo_driver
