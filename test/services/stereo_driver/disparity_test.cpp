#include "services/stereo_driver/core/matching/disparity.h"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>
#include <opencv2/core.hpp>

#include "services/stereo_driver/core/matching/refinement.h"
#include "test/services/stereo_driver/synthetic_rig.h"

namespace deixis::stereo_driver {
namespace {

constexpr int kSearched = 48;

DisparityConfig ConfigOf(Method method) {
  DisparityConfig config;
  config.method = method;
  return config;
}

cv::Mat Match(const DisparityConfig& config, const Layers& layers) {
  cv::Mat disparity;
  DisparityMatcher(config, kSearched).Match(layers.left, layers.right, disparity);
  return disparity;
}

bool AreEqual(const cv::Mat& a, const cv::Mat& b) {
  return a.size() == b.size() && a.type() == b.type() && cv::countNonZero(a != b) == 0;
}

class EveryMethod : public testing::TestWithParam<Method> {};

TEST_P(EveryMethod, FindsBothLayers) {
  const Layers layers = SquareBeforeWall();
  const cv::Mat disparity = Match(ConfigOf(GetParam()), layers);
  EXPECT_NEAR(disparity.at<std::int16_t>(110, 170), 24 * kDisparityScale, 2);
  EXPECT_NEAR(disparity.at<std::int16_t>(200, 250), 8 * kDisparityScale, 2);
}

TEST_P(EveryMethod, MatchesTheLeftBorderAsFarAsTheRightCameraSeesIt) {
  const Layers layers = SquareBeforeWall();
  const cv::Mat disparity = Match(ConfigOf(GetParam()), layers);
  const cv::Mat seen = disparity(cv::Rect(20, 200, kSearched - 20, 30));
  EXPECT_GT(cv::countNonZero(seen > 0), 0.9 * static_cast<double>(seen.total()));
  const cv::Mat unseen = disparity(cv::Rect(0, 0, 1, disparity.rows));
  EXPECT_EQ(cv::countNonZero(unseen != kNoDisparity), 0);
}

TEST_P(EveryMethod, LeftRightCheckTakesOutWhatOnlyOneCameraSees) {
  const Layers layers = SquareBeforeWall();
  DisparityConfig config = ConfigOf(GetParam());
  // Without the other checks, which would take out some of the same pixels.
  config.uniqueness_percent = 0;
  config.speckle_area_px = 0;
  const auto hidden = layers.Hidden();
  const int checked = cv::countNonZero(Match(config, layers)(hidden) > 0);
  config.left_right_px = -1;
  const int unchecked = cv::countNonZero(Match(config, layers)(hidden) > 0);
  EXPECT_LT(checked, 0.6 * hidden.area());
  EXPECT_GT(unchecked, 1.5 * checked);
}

TEST_P(EveryMethod, IsWhatOpenCvFindsBitForBit) {
  const Layers layers = SquareBeforeWall();
  cv::Mat left, right, wide;
  cv::copyMakeBorder(layers.left, left, 0, 0, kSearched, 0, cv::BORDER_REPLICATE);
  cv::copyMakeBorder(layers.right, right, 0, 0, kSearched, 0, cv::BORDER_REPLICATE);
  if (GetParam() == Method::kBm) {
    const auto matcher = cv::StereoBM::create(kSearched, 15);
    matcher->setTextureThreshold(10);
    matcher->setPreFilterCap(31);
    matcher->setUniquenessRatio(10);
    matcher->setDisp12MaxDiff(1);
    matcher->setSpeckleWindowSize(100);
    matcher->setSpeckleRange(2);
    matcher->compute(left, right, wide);
  } else {
    cv::StereoSGBM::create(0, kSearched, 5, 8 * 25, 32 * 25, 1, 31, 10, 100, 2,
                           cv::StereoSGBM::MODE_SGBM_3WAY)
        ->compute(left, right, wide);
  }
  cv::Mat plain = wide.colRange(kSearched, wide.cols).clone();
  for (int x = 0; x < plain.cols; ++x) {
    cv::Mat column = plain.col(x);
    column.setTo(kNoDisparity, (column <= 0) | (column > x * kDisparityScale));
  }
  EXPECT_TRUE(AreEqual(Match(ConfigOf(GetParam()), layers), plain));
}

TEST_P(EveryMethod, ThreadsDoNotChangeTheResult) {
  const Layers layers = SquareBeforeWall();
  const int before = cv::getNumThreads();
  cv::Mat results[2];
  // Two first: OpenCV stays at one thread once it has been told to.
  for (const int threads : {2, 1}) {
    cv::setNumThreads(threads);
    cv::Mat& result = results[threads - 1];
    result = Match(ConfigOf(GetParam()), layers);
    DisparityRefiner({}).Refine(layers.left, layers.right, result);
  }
  cv::setNumThreads(before);
  EXPECT_TRUE(AreEqual(results[0], results[1]));
}

TEST_P(EveryMethod, FindsNothingInAGreyWall) {
  const cv::Mat grey(120, 160, CV_8UC1, cv::Scalar(128));
  cv::Mat disparity;
  DisparityMatcher(ConfigOf(GetParam()), kSearched).Match(grey, grey, disparity);
  EXPECT_EQ(cv::countNonZero(disparity > 0), 0);
}

INSTANTIATE_TEST_SUITE_P(Methods, EveryMethod, testing::Values(Method::kSgbm3way, Method::kBm),
                         [](const auto& tested) {
                           return tested.param == Method::kBm ? "Bm" : "Sgbm3way";
                         });

TEST(SearchedDisparities, CoversTheNearestDistance) {
  EXPECT_EQ(SearchedDisparities({}, 110.0, 640), 112);
  EXPECT_EQ(SearchedDisparities({}, 111.5, 640), 128);
  EXPECT_EQ(SearchedDisparities({}, 1000.0, 320), 320);
  EXPECT_EQ(SearchedDisparities({}, 0.5, 320), 16);
  DisparityConfig config;
  config.num_disparities = 64;
  EXPECT_EQ(SearchedDisparities(config, 110.0, 640), 64);
}

TEST(DisparityConfig, NamesWhatOpenCvWouldNotTake) {
  DisparityConfig config;
  config.num_disparities = 20;
  config.block_px = 4;
  config.smoothness_large = config.smoothness_small;
  config.prefilter_cap = 64;
  using testing::HasSubstr;
  EXPECT_THAT([&] { config.Validate(); },
              testing::ThrowsMessage<config::ConfigError>(
                  testing::AllOf(HasSubstr("num_disparities"), HasSubstr("block_px"),
                                 HasSubstr("smoothness_large"), HasSubstr("prefilter_cap"))));
}

TEST(DisparityConfig, RefusesSmoothnessThatSixteenBitCostsCannotHold) {
  DisparityConfig config;
  config.block_px = 31;  // 32 * 31 * 31 = 30752
  EXPECT_NO_THROW(config.Validate());
  config.block_px = 33;
  EXPECT_THROW(config.Validate(), config::ConfigError);
  config.method = Method::kBm;  // It has none.
  EXPECT_NO_THROW(config.Validate());
  config = DisparityConfig{};
  config.smoothness_large = std::numeric_limits<int>::max();
  EXPECT_THROW(config.Validate(), config::ConfigError);
}

/// A wall whose disparity grows by a pixel and a quarter from left to right.
struct SlantedPair {
  cv::Mat left = cv::Mat(120, 320, CV_8UC1);
  cv::Mat right = cv::Mat(120, 320, CV_8UC1);
  static double DisparityAt(int x) { return 10.3 + 0.004 * x; }
  SlantedPair() {
    const auto brightness = [](double x, double y) {
      return 128.0 + 45.0 * std::sin(0.9 * x + 0.5 * y) + 35.0 * std::sin(0.37 * x - 0.8 * y) +
             25.0 * std::sin(1.7 * x + 1.1 * y);
    };
    for (int y = 0; y < left.rows; ++y) {
      for (int x = 0; x < left.cols; ++x) {
        right.at<std::uint8_t>(y, x) = cv::saturate_cast<std::uint8_t>(brightness(x, y));
        left.at<std::uint8_t>(y, x) =
            cv::saturate_cast<std::uint8_t>(brightness(x - DisparityAt(x), y));
      }
    }
  }
  double MeanError_px(const cv::Mat& disparity) const {
    double sum = 0.0;
    int count = 0;
    for (int x = 60; x < 300; ++x) {
      sum += std::abs(disparity.at<std::int16_t>(60, x) / 16.0 - DisparityAt(x));
      ++count;
    }
    return sum / count;
  }
};

TEST(DisparityRefiner, FindsDisparitiesBetweenWholePixels) {
  const SlantedPair pair;
  cv::Mat disparity;
  DisparityMatcher({}, kSearched).Match(pair.left, pair.right, disparity);
  const double before_px = pair.MeanError_px(disparity);
  DisparityRefiner({}).Refine(pair.left, pair.right, disparity);
  EXPECT_LT(pair.MeanError_px(disparity), 0.04);
  EXPECT_LT(pair.MeanError_px(disparity), 0.6 * before_px);
}

TEST(DisparityRefiner, LosesAndMakesUpNothing) {
  const Layers layers = SquareBeforeWall();
  const cv::Mat before = Match({}, layers);
  cv::Mat after = before.clone();
  DisparityRefiner({}).Refine(layers.left, layers.right, after);
  EXPECT_TRUE(AreEqual(before > 0, after > 0));
  cv::Mat moved;
  cv::absdiff(before, after, moved);
  double most = 0.0;
  cv::minMaxLoc(moved, nullptr, &most, nullptr, nullptr, before > 0);
  EXPECT_LE(most, kDisparityScale);
}

TEST(DisparityRefiner, MovesNothingByMoreThanAPixelHoweverWideItSmooths) {
  const cv::Mat plain(60, 120, CV_8UC1, cv::Scalar(90));  // Nothing to align by.
  cv::Mat disparity(plain.size(), CV_16SC1, cv::Scalar(8 * kDisparityScale));
  disparity.colRange(60, 120) = cv::Scalar(14 * kDisparityScale);
  const cv::Mat before = disparity.clone();
  RefinementConfig config;
  config.smoothing_px = 31;
  config.agree_px = 10.0;
  DisparityRefiner(config).Refine(plain, plain, disparity);
  EXPECT_EQ(cv::norm(before, disparity, cv::NORM_INF), kDisparityScale);
}

TEST(DisparityRefiner, RefinesAWindowAsTheWholeWithoutRounding) {
  const Layers layers = SquareBeforeWall();
  cv::Mat whole(layers.left.size(), CV_16SC1, cv::Scalar(layers.wall_px * kDisparityScale + 4));
  cv::Mat window_px(60, 100, CV_32FC1, cv::Scalar(layers.wall_px + 0.25));
  DisparityRefiner refiner({});
  refiner.RefineWindow(layers.left, layers.right, {200, 170, 100, 60}, window_px);
  refiner.Refine(layers.left, layers.right, whole);
  for (int y = 30; y < 50; ++y) {
    for (int x = 30; x < 70; ++x) {
      const float whole_px = static_cast<float>(whole.at<std::int16_t>(170 + y, 200 + x)) / 16.0F;
      ASSERT_NEAR(window_px.at<float>(y, x), whole_px, 1.0F / 32.0F + 1e-3F) << x << " " << y;
    }
  }
}

TEST(DisparityRefiner, WithoutRoundsLeavesAllAsItWas) {
  const Layers layers = SquareBeforeWall();
  const cv::Mat before = Match({}, layers);
  cv::Mat after = before.clone();
  RefinementConfig config;
  config.iterations = 0;
  DisparityRefiner(config).Refine(layers.left, layers.right, after);
  EXPECT_TRUE(AreEqual(before, after));
}

TEST(DisparityRefiner, DoesNotBlurTheEdgeOfABody) {
  const Layers layers = SquareBeforeWall();
  cv::Mat disparity = Match({}, layers);
  DisparityRefiner({}).Refine(layers.left, layers.right, disparity);
  const int half = (layers.wall_px + layers.square_px) / 2 * kDisparityScale;
  const cv::Mat is_between = (disparity > half - 5 * 16) & (disparity < half + 5 * 16);
  EXPECT_EQ(cv::countNonZero(is_between), 0);
}

}  // namespace
}  // namespace deixis::stereo_driver
