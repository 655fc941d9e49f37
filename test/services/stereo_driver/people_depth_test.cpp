#include <gmock/gmock.h>

#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "services/stereo_driver/core/matching/disparity.h"
#include "services/stereo_driver/core/matching/people/silhouettes.h"
#include "services/stereo_driver/core/matching/people/standing_out.h"
#include "services/stereo_driver/core/matching/stereo_matcher.h"
#include "test/services/stereo_driver/synthetic_rig.h"

namespace deixis::stereo_driver {
namespace {

using testing::IsEmpty;
using testing::SizeIs;

// Of half-size pictures: a wall at 4 m has 8.25 px, somebody at 2 m 16.5 px.
const DepthGeometry kHalf = {275.0, 0.12, 0.5, 10.0};
constexpr int kWall = 132;
constexpr int kSomebody = 264;

cv::Mat Wall() { return {240, 320, CV_16SC1, cv::Scalar(kWall)}; }

TEST(StandingOut, FindsNobodyBeforeAWall) {
  EXPECT_THAT(StandingOut().Find(Wall(), kHalf), IsEmpty());
}

TEST(StandingOut, FindsNobodyOnAFloorThatComesNearer) {
  cv::Mat disparity = Wall();
  for (int y = 120; y < 240; ++y) disparity.row(y) = kWall + 2 * (y - 120);
  EXPECT_THAT(StandingOut().Find(disparity, kHalf), IsEmpty());
}

TEST(StandingOut, FindsWhoStandsBeforeAWallAsAWholeAndLittleMore) {
  cv::Mat disparity = Wall();
  const cv::Rect somebody(120, 30, 50, 200);
  disparity(somebody) = kSomebody;
  const Windows windows = StandingOut().Find(disparity, kHalf);
  ASSERT_THAT(windows, SizeIs(1));
  const cv::Rect full(240, 60, 100, 400);
  EXPECT_EQ(windows[0] & full, full);
  EXPECT_LT(windows[0].area(), 2 * full.area());
}

TEST(StandingOut, FindsSeveralTheTallestFirst) {
  cv::Mat disparity = Wall();
  disparity(cv::Rect(40, 90, 40, 120)) = kSomebody;
  disparity(cv::Rect(200, 40, 40, 190)) = kSomebody;
  const Windows windows = StandingOut().Find(disparity, kHalf);
  ASSERT_THAT(windows, SizeIs(2));
  EXPECT_GT(windows[0].x, windows[1].x);
}

TEST(StandingOut, PassesOverWhatIsTooSmallOrTooFar) {
  cv::Mat disparity = Wall();
  disparity(cv::Rect(100, 100, 40, 40)) = kSomebody;  // 0.3 m.
  EXPECT_THAT(StandingOut().Find(disparity, kHalf), IsEmpty());
  disparity = kWall / 2;  // 8 m.
  disparity(cv::Rect(100, 100, 40, 100)) = kWall / 2 + 8;
  EXPECT_THAT(StandingOut().Find(disparity, kHalf), IsEmpty());
}

TEST(StandingOut, LeavesMostOfALongTableOutThatSomebodyStandsAt) {
  cv::Mat disparity = Wall();
  constexpr int kAt3m = 176;
  disparity(cv::Rect(8, 180, 208, 30)) = kAt3m;
  disparity(cv::Rect(150, 20, 40, 190)) = kAt3m;
  const Windows windows = StandingOut().Find(disparity, kHalf);
  ASSERT_THAT(windows, SizeIs(1));
  EXPECT_EQ(windows[0] & cv::Rect(300, 40, 80, 380), cv::Rect(300, 40, 80, 380));
  EXPECT_GT(windows[0].x, 100);
}

TEST(StandingOut, TakesPicturesSmallerThanACell) {
  EXPECT_THAT(StandingOut().Find(cv::Mat(5, 6, CV_16SC1, cv::Scalar(kWall)), kHalf), IsEmpty());
}

/// A red square before a blue wall, its disparity spread by three pixels on each side.
class SilhouettesTest : public testing::Test {
 protected:
  SilhouettesTest() {
    bgr_ = cv::Mat(240, 320, CV_8UC3, cv::Scalar(200, 60, 40));
    bgr_(kBody) = cv::Scalar(40, 60, 200);
    cv::cvtColor(bgr_, grey_, cv::COLOR_BGR2GRAY);
    disparity_ = Wall();
    disparity_(kSpread) = kSomebody;
  }
  void Sharpen(const cv::Rect& window = {0, 0, 320, 240}) {
    SilhouetteSharpener().Sharpen({bgr_, grey_, grey_}, window, disparity_);
  }
  int At(int x, int y) const { return disparity_.at<std::int16_t>(y, x); }

  const cv::Rect kBody{120, 60, 80, 100};
  const cv::Rect kSpread{117, 57, 86, 106};
  cv::Mat bgr_, grey_, disparity_;
};

TEST_F(SilhouettesTest, GivesBackWhatHasTheColourOfTheWall) {
  Sharpen();
  EXPECT_EQ(At(202, 100), kWall);
  EXPECT_EQ(At(160, 58), kWall);
  EXPECT_EQ(At(118, 100), kNoDisparity) << "seen by the left camera only";
  EXPECT_LE(cv::countNonZero(disparity_(kBody) != kSomebody), 4) << "its corners";
}

TEST_F(SilhouettesTest, KeepsAllWhereColoursSayNothing) {
  bgr_ = cv::Scalar(90, 90, 90);
  grey_ = 90;
  const cv::Mat before = disparity_.clone();
  Sharpen();
  EXPECT_EQ(cv::countNonZero(disparity_ != before), 0);
}

TEST_F(SilhouettesTest, ChangesNothingOutsideItsWindow) {
  const cv::Rect window(160, 40, 100, 60);
  cv::Mat before = disparity_.clone();
  Sharpen(window);
  EXPECT_GT(cv::countNonZero(disparity_ != before), 0);
  disparity_(window).copyTo(before(window));
  EXPECT_EQ(cv::countNonZero(disparity_ != before), 0);
}

TEST_F(SilhouettesTest, MakesNothingUpInHoles) {
  disparity_(cv::Rect(100, 0, 17, 240)) = kNoDisparity;
  Sharpen();
  EXPECT_EQ(At(118, 100), kNoDisparity);
  EXPECT_EQ(At(110, 100), kNoDisparity);
  EXPECT_EQ(At(99, 100), kWall);
}

/// Pinholes side by side.
geometry::StereoCalibration Rig(cv::Size size) {
  geometry::StereoCalibration rig;
  rig.left.width_px = size.width;
  rig.left.height_px = size.height;
  rig.left.focal_px = {550.0, 550.0};
  rig.left.principal_point_px = {0.5 * (size.width - 1), 0.5 * (size.height - 1)};
  rig.right = rig.rectified = rig.left;
  rig.right_from_left.translation_m = {-0.12, 0.0, 0.0};
  return rig;
}

constexpr double kSomebody_mm = 550.0 * 0.12 / 33.3 * 1000.0;
const cv::Rect kSomebodySeen(240, 80, 100, 360);

cv::Mat Texture(cv::Size size, std::uint64_t seed) {
  cv::Mat texture(size, CV_8UC3);
  cv::RNG(seed).fill(texture, cv::RNG::UNIFORM, 0, 256);
  cv::GaussianBlur(texture, texture, {0, 0}, 1.5);
  return texture;
}

/// `texture` as seen from `shift_px` to the right.
cv::Mat Shifted(const cv::Mat& texture, double shift_px, cv::Size size) {
  const cv::Mat move = (cv::Mat_<double>(2, 3) << 1, 0, -shift_px, 0, 1, 0);
  cv::Mat shifted;
  cv::warpAffine(texture, shifted, move, size, cv::INTER_CUBIC, cv::BORDER_REFLECT);
  return shifted;
}

images::StereoPair SomebodyBeforeAWall(cv::Size size = {640, 480}) {
  const cv::Mat wall = Texture(size, 1);
  const cv::Mat somebody = Texture(size, 2);
  images::StereoPair pair;
  pair.left.bgr = wall.clone();
  pair.right.bgr = Shifted(wall, 16.5, size);
  const cv::Rect seen = kSomebodySeen & cv::Rect({0, 0}, size);
  somebody(seen).copyTo(pair.left.bgr(seen));
  const cv::Rect whole_pixels = seen - cv::Point(33, 0);
  Shifted(somebody, 33.3, size)(whole_pixels).copyTo(pair.right.bgr(whole_pixels));
  return pair;
}

StereoMatcherConfig People() {
  StereoMatcherConfig config;
  config.match_size = MatchSize::kPeople;
  return config;
}

double MeanError_mm(const cv::Mat& depth_mm) {
  const int divisor = 640 / depth_mm.cols;
  const cv::Rect core(270 / divisor, 110 / divisor, 50 / divisor, 300 / divisor);
  cv::Mat error_mm;
  cv::absdiff(depth_mm(core), cv::Scalar(kSomebody_mm), error_mm);
  return cv::mean(error_mm)[0];
}

TEST(People, AreMeasuredMoreExactlyThanAtHalfSizeWhoeverSaysWhereTheyAre) {
  const images::StereoPair pair = SomebodyBeforeAWall();
  StereoMatcher half({}, Rig({640, 480})), people(People(), Rig({640, 480}));
  const double half_mm = MeanError_mm(half.Measure(pair).depth_mm);
  EXPECT_LT(MeanError_mm(people.Measure(pair).depth_mm), half_mm);
  EXPECT_THAT(people.windows(), SizeIs(1));
  EXPECT_LT(MeanError_mm(people.Measure(pair, {kSomebodySeen}).depth_mm), half_mm);
}

TEST(People, OutsideOfWindowsAllIsAsOfHalfSize) {
  const images::StereoPair pair = SomebodyBeforeAWall();
  StereoMatcher half({}, Rig({640, 480})), people(People(), Rig({640, 480}));
  cv::Mat expected = half.Measure(pair).depth_mm.clone();
  const cv::Mat depth_mm = people.Measure(pair, {{200, 60, 180, 400}}).depth_mm;
  const cv::Rect window(100, 30, 90, 200);
  EXPECT_GT(cv::countNonZero(depth_mm(window) != expected(window)), 1000);
  depth_mm(window).copyTo(expected(window));
  EXPECT_EQ(cv::countNonZero(depth_mm != expected), 0);
}

TEST(People, WindowsHaveNoSeam) {
  const images::StereoPair pair = SomebodyBeforeAWall();
  StereoMatcherConfig config = People();
  config.people.sharpens_silhouettes = false;
  StereoMatcher half({}, Rig({640, 480})), people(config, Rig({640, 480}));
  const cv::Mat before = half.Measure(pair).depth_mm.clone();
  const cv::Mat after = people.Measure(pair, {{280, 200, 200, 160}}).depth_mm;
  for (int y = 0; y < before.rows; ++y) {
    for (int x = 0; x < before.cols; ++x) {
      const int a = before.at<std::uint16_t>(y, x);
      const int b = after.at<std::uint16_t>(y, x);
      ASSERT_EQ(a == 0, b == 0) << x << " " << y;
      if (a == 0) continue;
      // A pixel of full size is the farthest that alignment goes.
      ASSERT_NEAR(550.0 * 120.0 / a, 550.0 * 120.0 / b, 1.02) << x << " " << y;
    }
  }
}

TEST(People, DepthOfFullSizeComesOfTheSameDisparities) {
  StereoMatcherConfig config = People();
  config.depth_size = Size::kFull;
  StereoMatcher people(config, Rig({640, 480}));
  const cv::Mat depth_mm = people.Measure(SomebodyBeforeAWall(), {kSomebodySeen}).depth_mm;
  EXPECT_EQ(depth_mm.size(), cv::Size(640, 480));
  EXPECT_LT(MeanError_mm(depth_mm), 8.0);
  EXPECT_NEAR(depth_mm.at<std::uint16_t>(100, 550), 4000, 60);
}

TEST(People, SameInputMakesTheSameBytesWhateverTheNumberOfThreads) {
  const images::StereoPair pair = SomebodyBeforeAWall();
  const int threads = cv::getNumThreads();
  cv::Mat first;
  for (const int count : {1, 2}) {
    cv::setNumThreads(count);
    StereoMatcher people(People(), Rig({640, 480}));
    for (const Windows& said : {Windows{{0, 0, 640, 480}}, Windows{kSomebodySeen}}) {
      // What another window has left behind in memory does not matter.
      people.Measure(pair, said);
    }
    const cv::Mat depth_mm = people.Measure(pair, {kSomebodySeen}).depth_mm.clone();
    if (first.empty()) first = depth_mm;
    EXPECT_EQ(cv::countNonZero(depth_mm != first), 0) << count << " threads";
  }
  cv::setNumThreads(threads);
}

TEST(People, WindowsOfAnySizeAreMeasured) {
  const images::StereoPair pair = SomebodyBeforeAWall();
  StereoMatcher people(People(), Rig({640, 480}));
  EXPECT_LT(MeanError_mm(people.Measure(pair, {{-500, -500, 3000, 3000}}).depth_mm), 8.0);
  for (const Windows& said :
       {Windows{{-10, -10, 40, 40}}, Windows{{620, 460, 90, 90}}, Windows{{0, 0, 16, 480}},
        Windows{{0, 100, 640, 16}}, Windows{{5000, 0, 10, 10}}}) {
    EXPECT_EQ(people.Measure(pair, said).depth_mm.size(), cv::Size(320, 240));
  }
}

TEST(People, PicturesOfOddOrTinySizeAreMeasuredAtHalfSize) {
  for (const cv::Size size : {cv::Size(641, 481), {640, 479}, {16, 16}, {33, 17}, {18, 200}}) {
    const images::StereoPair pair{{{}, "", Texture(size, 1)}, {{}, "", Texture(size, 1)}};
    StereoMatcher half({}, Rig(size)), people(People(), Rig(size));
    const cv::Mat expected = half.Measure(pair).depth_mm;
    const cv::Mat depth_mm = people.Measure(pair, {{0, 0, 600, 400}}).depth_mm;
    ASSERT_EQ(depth_mm.size(), expected.size());
    const bool is_odd = size.width % 2 + size.height % 2 > 0;
    if (!is_odd) continue;
    EXPECT_EQ(cv::countNonZero(depth_mm != expected), 0);
  }
}

TEST(PeopleConfig, NamesWhatIsOutOfRange) {
  PeopleConfig config;
  config.largest_share = 0.0;
  EXPECT_THAT([&] { config.Validate(); },
              testing::ThrowsMessage<config::ConfigError>(testing::HasSubstr("largest_share")));
}

}  // namespace
}  // namespace deixis::stereo_driver
