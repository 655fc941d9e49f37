#include "services/calibrator/core/calibration.h"

#include <gmock/gmock.h>

#include <functional>

#include "services/calibrator/core/verdict.h"
#include "test/services/calibrator/rendered_board.h"

namespace deixis::calibrator::test {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::StartsWith;

constexpr double kBaseline_m = 0.12;
const cv::Vec3d kTurn(0.01, 0.03, -0.015);

/// As if a whole picture had been looked at; tilted, unless told otherwise.
View ViewOf(const Corners& corners, double tilt_deg = 25.0) {
  View view;
  view.size = {640, 480};
  view.corners = corners;
  view.edge_width_px = 2.0;
  view.tilt_right_deg = tilt_deg;
  return view;
}

Lens RightLens() {
  Lens lens = WideLens();
  lens.matrix(0, 0) = 465.0;
  lens.matrix(0, 2) = 316.0;
  lens.distortion[0] = -0.27;
  return lens;
}

/// What two cameras see of a board, and the selection that they went through.
struct Rig {
  Board board = MakeBoard({});
  ViewSelection selection{{}, 2};
};

void Show(Rig& rig, int count, double sigma_px = 0.1) {
  cv::RNG random(11);
  for (const BoardPose& pose : Poses(rig.board.layout.size_m, 0.55, count)) {
    const auto left = ProjectedCorners(WideLens(), rig.board.layout, pose, sigma_px, random);
    const auto right = ProjectedCorners(RightLens(), rig.board.layout,
                                        SeenFromRight(pose, kBaseline_m, kTurn), sigma_px, random);
    rig.selection.Offer("pair", {}, {ViewOf(left), ViewOf(right)});
  }
}

class StereoCalibrationBy : public ::testing::TestWithParam<Refinement> {};

TEST_P(StereoCalibrationBy, FindsWhereTheCamerasStand) {
  Rig rig;
  Show(rig, 16);
  CalibrationOptions options;
  options.refinement = GetParam();
  const auto result = CalibrateStereo(rig.selection.shots(), rig.board.layout, options);
  EXPECT_NEAR(cv::norm(result.fit.translation_m), kBaseline_m, 0.001);
  EXPECT_LT(result.fit.translation_m[0], 0.0);
  EXPECT_NEAR(result.fit.rotation(0, 2), kTurn[1], 0.006);
  EXPECT_NEAR(result.fit.rotation(1, 0), kTurn[2], 0.003);
  EXPECT_LT(result.rows_px.median, 0.15);
  ASSERT_TRUE(result.held_out_rows_px);
  EXPECT_LT(result.held_out_rows_px->median, 0.25);
  EXPECT_NEAR(result.median_square, 1.0, 0.005);
  EXPECT_THAT(FaultsOf(result, rig.selection, {}), IsEmpty());
}

INSTANTIATE_TEST_SUITE_P(Refinements, StereoCalibrationBy,
                         ::testing::Values(Refinement::kJoint, Refinement::kPlacesOnly));

TEST(StereoCalibration, WithoutNoiseRowsAgreeAndSquaresHaveTheirSize) {
  Rig rig;
  Show(rig, 8, 0.0);
  const auto result = CalibrateStereo(rig.selection.shots(), rig.board.layout, {});
  EXPECT_LT(result.rows_px.p95, 0.01);
  EXPECT_LT(result.square_errors.p95, 0.001);
}

TEST(StereoCalibration, ABoardCountedFromTheOtherEndIsPairedAllTheSame) {
  const Board board = MakeBoard({});
  cv::RNG random(1);
  const BoardPose pose = Poses(board.layout.size_m, 0.55, 1)[0];
  const auto left = ProjectedCorners(WideLens(), board.layout, pose, 0.0, random);
  const auto right = ProjectedCorners(RightLens(), board.layout,
                                      SeenFromRight(pose, kBaseline_m, kTurn), 0.0, random);
  const auto pair = PairOf(left, Turned(right, board.layout), board.layout);
  ASSERT_EQ(pair.second.points_px.size(), right.points_px.size());
  EXPECT_EQ(pair.second.points_px.front(), right.points_px.front());
}

TEST(StereoCalibration, LeavesOutAPairThatWasNotTakenAtOneMoment) {
  Rig rig;
  Show(rig, 12);
  std::vector<Shot> shots = rig.selection.shots();
  for (cv::Point2f& point : shots[5].views[1].corners.points_px) point.y += 4.0F;
  const auto result = CalibrateStereo(shots, rig.board.layout, {});
  ASSERT_EQ(result.dropped.size(), 1u);
  EXPECT_EQ(result.dropped[0].index, 5u);
  EXPECT_LT(result.rows_px.median, 0.2);
}

TEST(StereoCalibration, SwappedCamerasAreToldOf) {
  Rig rig;
  Show(rig, 12);
  ViewSelection swapped({}, 2);
  for (const Shot& shot : rig.selection.shots()) {
    swapped.Offer(shot.name, {}, {shot.views[1], shot.views[0]});
  }
  const auto result = CalibrateStereo(swapped.shots(), rig.board.layout, {});
  EXPECT_THAT(FaultsOf(result, swapped, {}), Contains(HasSubstr("left and right are swapped")));
}

TEST(CameraCalibration, TheSimplestModelThatServesIsChosen) {
  Rig rig;
  Show(rig, 14);
  CalibrationOptions options;
  options.choice = ModelChoice::kByCrossValidation;
  const auto result = CalibrateCamera(rig.selection.shots(), 0, rig.board.layout, options);
  EXPECT_EQ(result.options.model, LensModel::kPlumbBob);
  ASSERT_TRUE(result.cross_validated_px);
  EXPECT_LT(*result.cross_validated_px, 0.2);
}

TEST(CameraCalibration, OfTwoModelsWithin2PercentOfTheBestTheSimplerIsChosen) {
  EXPECT_EQ(FirstGoodEnough({1.0, 0.985, 0.975}), 1u);
  EXPECT_EQ(FirstGoodEnough({1.0, 0.99, 0.985}), 0u);
  EXPECT_EQ(FirstGoodEnough({1.0, 0.99, 0.5}), 2u);
}

TEST(CameraCalibration, AModelThatCouldNotBeFittedIsNotChosen) {
  EXPECT_EQ(FirstGoodEnough({std::nullopt, 2.0, 1.0}), 2u);
  EXPECT_EQ(FirstGoodEnough({std::nullopt, 1.0, std::nullopt}), 1u);
  EXPECT_EQ(FirstGoodEnough({std::nullopt, std::nullopt, std::nullopt}), 0u);
}

TEST(CameraCalibration, AFisheyeIsChosenForOneCameraButNeverForAPair) {
  Rig rig;
  Lens fisheye = WideLens();
  fisheye.model = LensModel::kFisheye;
  fisheye.matrix(0, 0) = fisheye.matrix(1, 1) = 200.0;
  fisheye.distortion = {-0.1, 0.03, -0.02, 0.01};
  cv::RNG random(11);
  for (const BoardPose& pose : Poses(rig.board.layout.size_m, 0.12, 7)) {
    const auto left = ProjectedCorners(fisheye, rig.board.layout, pose, 0.02, random);
    const auto right = ProjectedCorners(fisheye, rig.board.layout,
                                        SeenFromRight(pose, kBaseline_m, kTurn), 0.02, random);
    rig.selection.Offer("pair", {}, {ViewOf(left), ViewOf(right)});
  }
  CalibrationOptions options;
  options.choice = ModelChoice::kByCrossValidation;
  const auto& shots = rig.selection.shots();
  EXPECT_EQ(CalibrateCamera(shots, 0, rig.board.layout, options).options.model,
            LensModel::kFisheye);
  EXPECT_NE(CalibrateStereo(shots, rig.board.layout, options).left.options.model,
            LensModel::kFisheye);
}

TEST(StereoCalibration, TakesNoFisheye) {
  Rig rig;
  Show(rig, 8);
  CalibrationOptions options;
  options.lens.model = LensModel::kFisheye;
  EXPECT_THROW(CalibrateStereo(rig.selection.shots(), rig.board.layout, options),
               std::invalid_argument);
}

TEST(CameraCalibration, ABoardThatWasNeverTiltedIsNotEnough) {
  const Board board = MakeBoard({});
  ViewSelection selection({}, 1);
  cv::RNG random(2);
  for (int i = 0; i < 10; ++i) {
    // Parallel to the picture and always as far away.
    const BoardPose pose{{0.002 * i, 0.001, 0}, {-0.22 + 0.02 * i, -0.15 + 0.015 * (i % 4), 0.6}};
    const auto corners = ProjectedCorners(WideLens(), board.layout, pose, 0.3, random);
    selection.Offer("view", {}, {ViewOf(corners, 3.0)});
  }
  const auto result = CalibrateCamera(selection.shots(), 0, board.layout, {});
  EXPECT_THAT(FaultsOf(result, selection.coverage(0), "", {}),
              Contains(HasSubstr("tilted by 3 deg at most")));
}

TEST(CameraCalibration, OneCornerOfThePictureIsNotEnough) {
  Rig rig;
  Show(rig, 10);
  Coverage little;
  little.Add(rig.selection.shots()[0].views[0]);
  const auto result = CalibrateCamera(rig.selection.shots(), 0, rig.board.layout, {});
  EXPECT_THAT(FaultsOf(result, little, "", {}), Contains(HasSubstr("covered")));
}

TEST(CameraCalibration, AFocalLengthOfUnknownCertaintyIsRefused) {
  Rig rig;
  Show(rig, 12);
  auto result = CalibrateCamera(rig.selection.shots(), 0, rig.board.layout, {});
  ASSERT_THAT(FaultsOf(result, rig.selection.coverage(0), "", {}), IsEmpty());
  result.robust.fit.deviations.clear();
  EXPECT_THAT(FaultsOf(result, rig.selection.coverage(0), "", {}),
              ElementsAre(HasSubstr("how certain the focal length is cannot be told")));
}

TEST(StereoCalibration, EveryPartOfItIsJudged) {
  Rig rig;
  Show(rig, 12);
  const auto good = CalibrateStereo(rig.selection.shots(), rig.board.layout, {});
  const auto faults_when = [&](const std::function<void(StereoCalibration&)>& spoil) {
    StereoCalibration spoilt = good;
    spoil(spoilt);
    return FaultsOf(spoilt, rig.selection, {});
  };
  EXPECT_THAT(faults_when([](auto& spoilt) { spoilt.fit.left.matrix(0, 2) = 0.0; }),
              ElementsAre(StartsWith("left, fitted with the right one: the principal point")));
  EXPECT_THAT(faults_when([](auto& spoilt) { spoilt.fit.right.matrix(0, 2) = 0.0; }),
              ElementsAre(StartsWith("right, fitted with the left one: the principal point")));
  EXPECT_THAT(faults_when([](auto& spoilt) { spoilt.used.resize(7); }),
              ElementsAre(StartsWith("7 pairs are too few")));
  EXPECT_THAT(faults_when([](auto& spoilt) {
                spoilt.fit.translation_m = {-0.1, 0.2, 0.0};
              }),
              ElementsAre(StartsWith("the cameras stand one above the other")));
  EXPECT_THAT(faults_when([](auto& spoilt) {
                spoilt.fit.translation_m = {1e-6, 1e-5, 0.0};
                spoilt.median_square = std::nan("");
              }),
              ElementsAre(StartsWith("both cameras stand at one place")));
  EXPECT_THAT(faults_when([](auto& spoilt) { spoilt.fit.error_px = 1.1; }),
              ElementsAre(StartsWith("a stereo reprojection error of 1.10 px")));
  EXPECT_THAT(faults_when([](auto& spoilt) { spoilt.rows_px.median = 1.1; }),
              ElementsAre(StartsWith("rows differ by 1.10 px")));
  EXPECT_THAT(faults_when([](auto& spoilt) { spoilt.median_square = 1.06; }),
              ElementsAre(StartsWith("squares are measured 6.0 % off")));
}

TEST(CameraCalibration, ALargeErrorIsRefused) {
  Rig rig;
  Show(rig, 12, 1.5);
  const auto result = CalibrateCamera(rig.selection.shots(), 0, rig.board.layout, {});
  EXPECT_THAT(FaultsOf(result, rig.selection.coverage(0), "", {}),
              Contains(HasSubstr("reprojection error")));
}

}  // namespace
}  // namespace deixis::calibrator::test
