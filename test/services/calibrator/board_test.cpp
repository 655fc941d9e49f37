#include <gmock/gmock.h>

#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <stdexcept>

#include "services/calibrator/core/board_print.h"
#include "services/calibrator/core/view.h"
#include "test/services/calibrator/rendered_board.h"

namespace deixis::calibrator::test {
namespace {

using ::testing::AllOf;
using ::testing::Gt;
using ::testing::HasSubstr;
using ::testing::Lt;

BoardConfig Charuco(cv::Size squares) {
  BoardConfig config;
  config.kind = BoardKind::kCharuco;
  config.count = squares;
  config.square_m = 0.035;
  config.marker_m = 0.026;
  return config;
}

cv::Mat Grey(const cv::Mat& bgr) {
  cv::Mat grey;
  cv::cvtColor(bgr, grey, cv::COLOR_BGR2GRAY);
  return grey;
}

double LargestError_px(const Lens& lens, const Board& board, const Corners& corners,
                       const BoardPose& pose) {
  const auto truth = Project(lens, PointsOnBoard(board.layout, corners), pose);
  double largest = 0.0;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    largest = std::max(largest, cv::norm(truth[i] - corners.points_px[i]));
  }
  return largest;
}

TEST(CalibrationBoard, EveryCornerOfAChessboardIsWhereItWasPrinted) {
  const Board board = MakeBoard({});
  const BoardCamera camera(WideLens(), board.layout);
  const BoardPose pose = Poses(board.layout.size_m, 0.45, 4)[3];
  const auto view = Look(Grey(camera.Take(pose)), board);
  ASSERT_TRUE(view);
  ASSERT_EQ(view->corners.ids.size(), 54u);
  // A plain board may be counted from either end.
  const double error_px =
      std::min(LargestError_px(WideLens(), board, view->corners, pose),
               LargestError_px(WideLens(), board, Turned(view->corners, board.layout), pose));
  EXPECT_LT(error_px, 0.25);
}

class CharucoOfSize : public ::testing::TestWithParam<cv::Size> {};

TEST_P(CharucoOfSize, HasItsCornersWhereTheyWerePrinted) {
  const Board board = MakeBoard(Charuco(GetParam()));
  const BoardCamera camera(WideLens(), board.layout);
  const BoardPose pose = Poses(board.layout.size_m, 0.5, 1)[0];
  const auto view = Look(Grey(camera.Take(pose)), board);
  ASSERT_TRUE(view);
  EXPECT_EQ(static_cast<int>(view->corners.ids.size()), board.layout.corners.area());
  EXPECT_LT(LargestError_px(WideLens(), board, view->corners, pose), 0.4);
}

INSTANTIATE_TEST_SUITE_P(OddAndEvenRows, CharucoOfSize,
                         ::testing::Values(cv::Size(7, 5), cv::Size(7, 6), cv::Size(6, 5)));

TEST(CalibrationBoard, ACharucoThatIsPartlyOutOfViewKeepsTheCornersThatAreIn) {
  const Board board = MakeBoard(Charuco({7, 5}));
  const BoardCamera camera(WideLens(), board.layout);
  BoardPose pose = Poses(board.layout.size_m, 0.4, 1)[0];
  pose.translation_m += cv::Vec3d(0.24, 0.12, 0);
  const auto view = Look(Grey(camera.Take(pose)), board);
  ASSERT_TRUE(view);
  EXPECT_THAT(view->corners.ids.size(), AllOf(Gt(5u), Lt(24u)));
  EXPECT_LT(LargestError_px(WideLens(), board, view->corners, pose), 0.5);
}

TEST(CalibrationBoard, AGreyPictureHoldsNone) {
  const cv::Mat grey(480, 640, CV_8UC1, cv::Scalar(110));
  EXPECT_FALSE(Look(grey, MakeBoard({})));
  EXPECT_FALSE(Look(grey, MakeBoard(Charuco({7, 5}))));
}

TEST(CalibrationBoard, BlurWidensEdges) {
  const Board board = MakeBoard({});
  const BoardCamera camera(WideLens(), board.layout);
  const cv::Mat sharp = Grey(camera.Take(Poses(board.layout.size_m, 0.45, 1)[0]));
  cv::Mat blurred;
  cv::GaussianBlur(sharp, blurred, {0, 0}, 2.5);
  const auto in_focus = Look(sharp, board);
  const auto out_of_focus = Look(blurred, board);
  ASSERT_TRUE(in_focus && in_focus->edge_width_px);
  ASSERT_TRUE(out_of_focus && out_of_focus->edge_width_px);
  EXPECT_LT(*in_focus->edge_width_px, 3.5);
  EXPECT_GT(*out_of_focus->edge_width_px, 5.0);
}

/// The board's tilts as seen when it is turned by `rotation` somewhere off the middle.
cv::Vec2d TiltsOf(const cv::Vec3d& rotation) {
  const Board board = MakeBoard({});
  const BoardCamera camera(WideLens(), board.layout);
  const auto view = Look(Grey(camera.Take({rotation, {-0.16, -0.13, 0.55}})), board);
  if (!view) return {0.0, 0.0};
  return {view->tilt_right_deg, view->tilt_down_deg};
}

TEST(CalibrationBoard, TiltsAreToldApart) {
  // Turned by -0.5 about y: the right side goes away from a camera that looks along z.
  const cv::Vec2d right = TiltsOf({0, -0.5, 0});
  EXPECT_NEAR(right[0], 28.6, 6.0);
  EXPECT_NEAR(right[1], 0.0, 6.0);
  const cv::Vec2d lower = TiltsOf({0.5, 0, 0});
  EXPECT_NEAR(lower[0], 0.0, 6.0);
  EXPECT_NEAR(lower[1], 28.6, 6.0);
}

TEST(CalibrationBoard, RefusesWhatIsNone) {
  BoardConfig line;
  line.count = {9, 1};
  EXPECT_THROW(MakeBoard(line), std::invalid_argument);
  BoardConfig kilometres;
  kilometres.square_m = 25.0;
  EXPECT_THROW(MakeBoard(kilometres), std::invalid_argument);
  BoardConfig large_marker = Charuco({7, 5});
  large_marker.marker_m = 0.04;
  EXPECT_THROW(MakeBoard(large_marker), std::invalid_argument);
  BoardConfig unknown = Charuco({7, 5});
  unknown.dictionary = "9X9_9";
  EXPECT_THROW(MakeBoard(unknown), std::invalid_argument);
  BoardConfig too_many = Charuco({20, 20});
  too_many.dictionary = "5X5_50";
  EXPECT_THROW(MakeBoard(too_many), std::invalid_argument);
}

TEST(BoardPrint, APngStatesItsResolutionAndIsThatLarge) {
  const BoardConfig config;
  const Board board = MakeBoard(config);
  const auto png = BoardPng(board.layout, BoardCaption(config, board.layout));
  const cv::Mat page = cv::imdecode(png, cv::IMREAD_GRAYSCALE);
  ASSERT_FALSE(page.empty());
  // Twelve squares of 25 mm (ten and the margins) at 11811 pixels per metre.
  EXPECT_NEAR(page.cols, 12 * 0.025 * 11811, 2);
  EXPECT_THAT(std::string(png.begin(), png.begin() + 60), HasSubstr("pHYs"));
}

TEST(BoardPrint, APdfHasAPageOfA4AndEveryBlackSquare) {
  const BoardConfig config;
  const Board board = MakeBoard(config);
  const std::string pdf = BoardPdf(board.layout, BoardCaption(config, board.layout));
  EXPECT_THAT(pdf, HasSubstr("/MediaBox [0 0 841.89 595.276]"));
  std::size_t rectangles = 0;
  for (auto at = pdf.find(" re\n"); at != std::string::npos; at = pdf.find(" re\n", at + 1)) {
    ++rectangles;
  }
  EXPECT_EQ(rectangles, 35u);
  EXPECT_THAT(pdf, HasSubstr("250 mm"));
}

}  // namespace
}  // namespace deixis::calibrator::test
