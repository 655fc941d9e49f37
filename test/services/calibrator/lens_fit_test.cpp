#include "services/calibrator/core/lens_fit.h"

#include <gtest/gtest.h>

#include <opencv2/calib3d.hpp>

#include "test/services/calibrator/rendered_board.h"

namespace deixis::calibrator::test {
namespace {

constexpr double kNoise_px = 0.1;

std::vector<Corners> ViewsOf(const Lens& lens, const BoardLayout& layout, int count) {
  cv::RNG random(3);
  std::vector<Corners> views;
  for (const BoardPose& pose : Poses(layout.size_m, 0.45, count)) {
    views.push_back(ProjectedCorners(lens, layout, pose, kNoise_px, random));
  }
  return views;
}

Lens LensOf(LensModel model) {
  Lens lens = WideLens();
  lens.model = model;
  if (model == LensModel::kRational) {
    lens.distortion = {0.3, -0.1, 0.0005, -0.0003, 0.01, 0.6, -0.05, 0.02};
  } else if (model == LensModel::kFisheye) {
    lens.matrix(0, 0) = 380.0;
    lens.matrix(1, 1) = 379.0;
    lens.distortion = {0.05, -0.02, 0.008, -0.002};
  }
  return lens;
}

class LensFitOf : public ::testing::TestWithParam<LensModel> {};

TEST_P(LensFitOf, FindsTheLensThatTookTheViews) {
  const Board board = MakeBoard({});
  const Lens truth = LensOf(GetParam());
  const auto views = ViewsOf(truth, board.layout, 20);
  const LensFit fit = FitLens(views, board.layout, truth.size, {GetParam()});
  EXPECT_NEAR(fit.error_px, kNoise_px * std::sqrt(2.0), 0.02);
  EXPECT_NEAR(fit.lens.matrix(0, 0), truth.matrix(0, 0), 2.0);
  EXPECT_NEAR(fit.lens.matrix(1, 1), truth.matrix(1, 1), 2.0);
  EXPECT_NEAR(fit.lens.matrix(0, 2), truth.matrix(0, 2), 2.0);
  EXPECT_NEAR(fit.lens.matrix(1, 2), truth.matrix(1, 2), 2.0);
  EXPECT_EQ(fit.lens.distortion.size(), truth.distortion.size());
  // Coefficients stand in for one another; what counts is where a ray goes.
  const cv::Matx34d own = {380, 0, 320, 0, 0, 380, 240, 0, 0, 0, 1, 0};
  const std::vector<cv::Point2f> pixels{{100, 80}, {320, 240}, {540, 400}, {120, 380}};
  const auto expected = Undistort(truth, pixels, cv::Matx33d::eye(), own);
  const auto found = Undistort(fit.lens, pixels, cv::Matx33d::eye(), own);
  // Near the picture's middle it is certain, at its edge the fisheye's is less so.
  const double tolerance_px = GetParam() == LensModel::kFisheye ? 4.0 : 1.5;
  // A shift of them all is a camera that is turned by as much: it changes nothing in pictures.
  const cv::Point2f shift = found[1] - expected[1];
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    EXPECT_LT(cv::norm(expected[i] + shift - found[i]), tolerance_px) << pixels[i];
  }
}

TEST_P(LensFitOf, SaysHowCertainItIs) {
  const Board board = MakeBoard({});
  const Lens truth = LensOf(GetParam());
  const LensFit fit =
      FitLens(ViewsOf(truth, board.layout, 20), board.layout, truth.size, {GetParam()});
  ASSERT_EQ(fit.deviations.size(), 4 + truth.distortion.size());
  EXPECT_GT(fit.deviations[0], 0.01);
  EXPECT_LT(std::abs(fit.lens.matrix(0, 0) - truth.matrix(0, 0)), 5.0 * fit.deviations[0]);
}

INSTANTIATE_TEST_SUITE_P(Models, LensFitOf,
                         ::testing::Values(LensModel::kPlumbBob, LensModel::kRational,
                                           LensModel::kFisheye),
                         [](const auto& tested) { return NameOf(tested.param); });

TEST(LensFit, OptionsHold) {
  const Board board = MakeBoard({});
  const auto views = ViewsOf(WideLens(), board.layout, 10);
  LensOptions options;
  options.has_fixed_aspect = true;
  options.has_zero_tangent = true;
  const Lens lens = FitLens(views, board.layout, {640, 480}, options).lens;
  EXPECT_NEAR(lens.matrix(0, 0), lens.matrix(1, 1), 1e-9);
  EXPECT_EQ(lens.distortion[2], 0.0);
  EXPECT_EQ(lens.distortion[3], 0.0);
}

TEST(LensFit, LeavesOutAViewThatDoesNotGoWithTheOthers) {
  const Board board = MakeBoard({});
  auto views = ViewsOf(WideLens(), board.layout, 12);
  cv::RNG random(5);
  for (cv::Point2f& point : views[4].points_px) point.x += static_cast<float>(random.gaussian(2.0));
  const auto result = FitLensRobustly(views, board.layout, {640, 480}, {});
  ASSERT_EQ(result.dropped.size(), 1u);
  EXPECT_EQ(result.dropped[0].index, 4u);
  EXPECT_GT(result.dropped[0].error_px, 5.0 * result.dropped[0].others_px);
  EXPECT_EQ(result.used.size(), 11u);
  EXPECT_LT(result.fit.error_px, 0.2);
}

TEST(LensFit, KeepsViewsThatAreAlike) {
  const Board board = MakeBoard({});
  const auto result =
      FitLensRobustly(ViewsOf(WideLens(), board.layout, 12), board.layout, {640, 480}, {});
  EXPECT_TRUE(result.dropped.empty());
}

/// Views from so far away, parallel to the picture, that by themselves they determine no fisheye.
std::vector<Corners> FarViews(const Lens& lens, const BoardLayout& layout, int count) {
  cv::RNG random(1);
  std::vector<Corners> views;
  for (int i = 0; i < count; ++i) {
    const BoardPose pose{{0, 0, 0}, {-0.1 + 0.12 * i, -0.06, 6.0}};
    views.push_back(ProjectedCorners(lens, layout, pose, 0.6, random));
  }
  return views;
}

TEST(LensFit, DeviationsAreNotKnownWhenSomeViewsAloneDetermineTheLens) {
  const Board board = MakeBoard({});
  const Lens lens = LensOf(LensModel::kFisheye);
  const auto near = ViewsOf(lens, board.layout, 5);
  auto views = FarViews(lens, board.layout, 4);
  ASSERT_FALSE(FittedError_px(views, board.layout, lens.size, {LensModel::kFisheye}));
  views.insert(views.begin(), near[1]);  // The first and the last one are of one group.
  views.push_back(near[4]);
  const LensFit fit = FitLens(views, board.layout, lens.size, {LensModel::kFisheye});
  EXPECT_LT(fit.error_px, 1.0);
  EXPECT_TRUE(fit.deviations.empty());
}

TEST(LensFit, KeepsTheOnlyViewThatDeterminesTheLensHoweverPoorItIs) {
  const Board board = MakeBoard({});
  const Lens lens = LensOf(LensModel::kFisheye);
  auto views = FarViews(lens, board.layout, 6);
  ASSERT_FALSE(FittedError_px(views, board.layout, lens.size, {LensModel::kFisheye}));
  cv::RNG random(1);
  const BoardPose pose = Poses(board.layout.size_m, 0.45, 2)[1];
  views.push_back(ProjectedCorners(lens, board.layout, pose, 1.2, random));
  const auto result = FitLensRobustly(views, board.layout, lens.size, {LensModel::kFisheye});
  const auto& errors = result.fit.view_errors_px;
  EXPECT_GT(errors.back(), 1.8 * errors.front());
  EXPECT_TRUE(result.dropped.empty());
}

TEST(LensFit, TwoViewsAreTooFew) {
  const Board board = MakeBoard({});
  EXPECT_THROW(FitLens(ViewsOf(WideLens(), board.layout, 2), board.layout, {640, 480}, {}),
               FitFailed);
}

TEST(CalibratedLens, ReprojectionErrorIsZeroAtTheTruth) {
  const Board board = MakeBoard({});
  cv::RNG random(1);
  const auto corners = ProjectedCorners(WideLens(), board.layout,
                                        Poses(board.layout.size_m, 0.45, 1)[0], 0.0, random);
  EXPECT_LT(ReprojectionError_px(WideLens(), board.layout, corners).value(), 0.01);
}

TEST(CalibratedLens, KnowsWhenItFoldsThePictureOver) {
  EXPECT_TRUE(IsMonotonic(WideLens()));
  Lens folding = WideLens();
  folding.distortion = {-0.9, 0, 0, 0, 0};
  EXPECT_FALSE(IsMonotonic(folding));
}

}  // namespace
}  // namespace deixis::calibrator::test
