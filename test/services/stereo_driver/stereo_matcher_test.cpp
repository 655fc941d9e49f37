#include "services/stereo_driver/core/matching/stereo_matcher.h"

#include <gmock/gmock.h>

#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "services/stereo_driver/core/calibration/rig_calibration.h"
#include "test/services/stereo_driver/synthetic_rig.h"
#include "test/support/temporary_folder.h"

namespace deixis::stereo_driver {
namespace {

geometry::StereoCalibration RectifiedRig() {
  const test::TemporaryFolder folder;
  const geometry::StereoCalibration rig = SyntheticRig();
  RigCalibrationConfig config;
  config.intrinsics = folder.Write("intrinsics.yml", IntrinsicsText(rig)).string();
  config.extrinsics = folder.Write("extrinsics.yml", ExtrinsicsText(rig)).string();
  return RigCalibration(config).For({320, 240}).calibration;
}

struct Errors {
  double valid = 0.0;    ///< Share of the pixels away from the border.
  double mean_px = 0.0;  ///< As disparities of the full size.
  double worst_px = 0.0;
};

Errors ErrorsOf(const geometry::StereoCalibration& rig, const Plane& plane,
                const cv::Mat& depth_mm) {
  const double focal_baseline =
      rig.rectified.focal_px.x() * rig.right_from_left.translation_m.norm();
  Errors errors;
  int count = 0;
  int valid = 0;
  for (int y = depth_mm.rows / 8; y < depth_mm.rows * 7 / 8; ++y) {
    for (int x = depth_mm.cols / 4; x < depth_mm.cols * 7 / 8; ++x) {
      ++count;
      const double measured_m = depth_mm.at<std::uint16_t>(y, x) / 1000.0;
      if (measured_m <= 0.0) continue;
      const double true_m = RectifiedDepth_m(rig, plane, depth_mm.size(), {x, y});
      const double error_px = std::abs(focal_baseline / measured_m - focal_baseline / true_m);
      errors.mean_px += error_px;
      errors.worst_px = std::max(errors.worst_px, error_px);
      ++valid;
    }
  }
  errors.valid = static_cast<double>(valid) / count;
  errors.mean_px /= std::max(1, valid);
  return errors;
}

Plane Slanted() {
  Plane plane;
  plane.normal = Eigen::Vector3d(0.35, 0.2, 1.0).normalized();
  plane.distance_m = 1.6;
  return plane;
}

struct Way {
  MatchSize match_size;
  Size depth_size;
  Method method;
  double mean_px;
};

class EveryWay : public testing::TestWithParam<Way> {};

TEST_P(EveryWay, MeasuresPlanesThroughDistortedTurnedCameras) {
  StereoMatcherConfig config;
  config.match_size = GetParam().match_size;
  config.depth_size = GetParam().depth_size;
  config.disparity.method = GetParam().method;
  const geometry::StereoCalibration rig = RectifiedRig();
  StereoMatcher matcher(config, rig);
  for (const Plane& plane : {Plane{}, Slanted()}) {
    const images::StereoPair pair = Photograph(rig, plane);
    const RectifiedDepth& result = matcher.Measure(pair);
    EXPECT_EQ(result.left_bgr.size(), cv::Size(320, 240));
    const int divisor = GetParam().depth_size == Size::kHalf ? 2 : 1;
    EXPECT_EQ(result.depth_mm.size(), cv::Size(320 / divisor, 240 / divisor));
    const Errors errors = ErrorsOf(rig, plane, result.depth_mm);
    EXPECT_GT(errors.valid, 0.97);
    EXPECT_LT(errors.mean_px, GetParam().mean_px);
    EXPECT_LT(errors.worst_px, 1.5);
  }
}

INSTANTIATE_TEST_SUITE_P(
    Ways, EveryWay,
    testing::Values(Way{MatchSize::kFull, Size::kHalf, Method::kSgbm3way, 0.08},
                    Way{MatchSize::kFull, Size::kFull, Method::kSgbm3way, 0.08},
                    Way{MatchSize::kHalf, Size::kHalf, Method::kSgbm3way, 0.16},
                    Way{MatchSize::kFull, Size::kHalf, Method::kBm, 0.08}));

/// Pinholes side by side, so that nothing is lost of a picture whose size is odd.
geometry::StereoCalibration PlainRig(int width_px, int height_px) {
  geometry::StereoCalibration rig;
  rig.left.width_px = width_px;
  rig.left.height_px = height_px;
  rig.left.focal_px = {100.0, 100.0};
  rig.left.principal_point_px = {0.5 * (width_px - 1), 0.5 * (height_px - 1)};
  rig.right = rig.rectified = rig.left;
  rig.right_from_left.translation_m = {-0.12, 0.0, 0.0};
  return rig;
}

/// A plane whose disparity is `disparity_px` everywhere.
images::StereoPair ShiftedNoise(cv::Size size, int disparity_px) {
  cv::Mat noise(size.height, size.width + disparity_px, CV_8UC3);
  cv::RNG(7).fill(noise, cv::RNG::UNIFORM, 0, 256);
  cv::GaussianBlur(noise, noise, {5, 5}, 1.2);
  return {{{}, "", noise.colRange(0, size.width)},
          {{}, "", noise.colRange(disparity_px, disparity_px + size.width)}};
}

TEST(StereoMatcher, MeasuresHalvesOfAnOddSizeByTheirTrueScale) {
  StereoMatcher matcher({}, PlainRig(61, 47));
  const cv::Mat depth_mm = matcher.Measure(ShiftedNoise({61, 47}, 6)).depth_mm;
  EXPECT_EQ(depth_mm.size(), cv::Size(30, 23));
  // 100 px * 0.12 m / 6 px = 2 m; at 1/2 instead of 30/61 it would be 33 mm more.
  EXPECT_NEAR(cv::mean(depth_mm, depth_mm > 0)[0], 2000.0, 12.0);
}

TEST(StereoMatcher, SameInputMakesTheSameBytesAndNewMemoryIsNotAskedFor) {
  const geometry::StereoCalibration rig = RectifiedRig();
  const images::StereoPair pair = Photograph(rig, Slanted());
  StereoMatcher matcher({}, rig);
  const cv::Mat first = matcher.Measure(pair).depth_mm.clone();
  const void* memory = matcher.result().depth_mm.data;
  const cv::Mat second = matcher.Measure(pair).depth_mm;
  EXPECT_EQ(second.data, memory);
  EXPECT_EQ(cv::countNonZero(first != second), 0);
}

TEST(StereoMatcher, DistancesOutOfRangeAreZero) {
  const geometry::StereoCalibration rig = RectifiedRig();
  StereoMatcherConfig config;
  config.farthest_m = 1.5;
  StereoMatcher matcher(config, rig);
  EXPECT_EQ(cv::countNonZero(matcher.Measure(Photograph(rig, {})).depth_mm), 0);
}

TEST(StereoMatcher, RefusesPicturesOfAnotherSize) {
  StereoMatcher matcher({}, RectifiedRig());
  images::StereoPair pair;
  pair.left.bgr = pair.right.bgr = cv::Mat::zeros(480, 640, CV_8UC3);
  EXPECT_THROW(matcher.Measure(pair), std::logic_error);
}

TEST(MatchingFault, TellsPicturesTooSmallForTheBlocksOfTheMethod) {
  geometry::StereoCalibration calibration = SyntheticRig();
  StereoMatcherConfig config;
  calibration.rectified = geometry::GuessCalibration(28, 24, 1.2);
  EXPECT_EQ(MatchingFault(config, calibration), "");
  config.disparity.method = Method::kBm;
  EXPECT_THAT(MatchingFault(config, calibration), testing::HasSubstr("28x24 are too small"));
}

TEST(MatchingFault, TellsPicturesThatWouldTakeTooLong) {
  geometry::StereoCalibration calibration = SyntheticRig();
  StereoMatcherConfig config;
  calibration.rectified = geometry::GuessCalibration(3840, 2160, 1.2);
  EXPECT_EQ(MatchingFault(config, calibration), "");
  config.match_size = MatchSize::kFull;
  EXPECT_THAT(MatchingFault(config, calibration), testing::HasSubstr("too large"));
  config.nearest_m = 5.0;
  EXPECT_EQ(MatchingFault(config, calibration), "");
}

TEST(StereoMatcherConfig, NearestLiesBeforeFarthest) {
  StereoMatcherConfig config;
  config.nearest_m = 5.0;
  config.farthest_m = 4.0;
  EXPECT_THAT([&] { config.Validate(); },
              testing::ThrowsMessage<config::ConfigError>(testing::HasSubstr("farthest_m")));
}

TEST(Rectifier, SidesOfTheRectifiedPairAgreeRowByRow) {
  const geometry::StereoCalibration rig = RectifiedRig();
  RectifiedPair pair;
  Plane plane;
  Rectifier(rig).Rectify(Photograph(rig, plane), pair);
  const double disparity_px = rig.rectified.focal_px.x() *
                              rig.right_from_left.translation_m.norm() /
                              RectifiedDepth_m(rig, plane, {320, 240}, {160, 120});
  const cv::Rect patch(140, 100, 40, 40);
  const cv::Mat left = pair.left_grey(patch);
  const auto difference = [&](int dy) {
    const cv::Point shift(static_cast<int>(std::lround(disparity_px)), dy);
    return cv::norm(left, pair.right_grey(patch - shift), cv::NORM_L1);
  };
  EXPECT_LT(difference(0), difference(1));
  EXPECT_LT(difference(0), difference(-1));
}

}  // namespace
}  // namespace deixis::stereo_driver
