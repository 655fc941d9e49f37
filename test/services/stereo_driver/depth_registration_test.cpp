#include "services/stereo_driver/core/depth_camera/depth_registration.h"

#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <string>

#include "test/services/stereo_driver/synthetic_depth.h"
#include "test/support/allocation_count.h"

namespace deixis::stereo_driver {
namespace {

const cv::Size kSize(320, 240);

cv::Mat Registered(const DepthView& view, const geometry::CameraCalibration& target,
                   const cv::Mat& depth_mm) {
  cv::Mat registered_mm;
  DepthRegistration(view, target).Register(depth_mm, registered_mm);
  return registered_mm;
}

/// A scene as the colour camera would see it, and as it is after registration.
struct Comparison {
  Comparison(const DepthScene& scene, const DepthView& view, cv::Size size)
      : target(Pinhole(size)),
        raw_mm(MeasureDepth(view, scene)),
        registered_mm(Registered(view, target, raw_mm)),
        truth_mm(MeasureDepth(target, {}, scene)),
        hidden(HiddenFromDepth(target, view, scene)) {}

  geometry::CameraCalibration target;
  cv::Mat raw_mm, registered_mm, truth_mm, hidden;
};

DepthScene TiltedWall() { return {{Eigen::Vector3d(0.25, -0.15, 1.0).normalized(), 1.6}, {}}; }
DepthScene ScreenBeforeWall() { return {{Eigen::Vector3d::UnitZ(), 2.5}, Screen{}}; }

/// Of the pixels where both are measured: how many there are, and how wrong `depth_mm` is.
struct Errors {
  Errors(const cv::Mat& depth_mm, const cv::Mat& truth_mm, const cv::Mat& where) {
    for (int i = 0; i < static_cast<int>(truth_mm.total()); ++i) {
      const int depth = depth_mm.at<std::uint16_t>(i);
      if (depth == 0 || where.at<std::uint8_t>(i) == 0) continue;
      const double error_mm = std::abs(depth - truth_mm.at<std::uint16_t>(i));
      ++count;
      largest_mm = std::max(largest_mm, error_mm);
      mean_mm += error_mm;
      off += error_mm > 0.03 * truth_mm.at<std::uint16_t>(i) ? 1 : 0;
    }
    mean_mm /= std::max(count, 1);
  }
  int count = 0;
  int off = 0;  ///< By more than 3 %.
  double mean_mm = 0.0;
  double largest_mm = 0.0;
};

std::string Text(const Errors& errors) {
  return "mean " + std::to_string(errors.mean_mm) + " mm, largest " +
         std::to_string(errors.largest_mm) + " mm, " + std::to_string(errors.off) + " of " +
         std::to_string(errors.count) + " off";
}

/// Without the pixels that an edge of the scene goes through.
cv::Mat AwayFromEdges(const cv::Mat& truth_mm) {
  cv::Mat nearest, farthest, depth;
  truth_mm.convertTo(depth, CV_32F);
  cv::erode(depth, nearest, cv::Mat());
  cv::dilate(depth, farthest, cv::Mat());
  return farthest - nearest < 0.1 * nearest;
}

cv::Mat Everywhere() { return cv::Mat(kSize, CV_8UC1, cv::Scalar(255)); }

/// The column in which a row passes from the wall to the screen.
int LeftEdge(const cv::Mat& depth_mm, int row) {
  int x = depth_mm.cols / 2;
  while (x > 0 && std::abs(depth_mm.at<std::uint16_t>(row, x - 1) - 1000) < 50) --x;
  return x;
}

/// Parts that are not measured and do not reach the border.
int EnclosedHoles(const cv::Mat& depth_mm) {
  cv::Mat labels, boxes, ignored;
  const int count = cv::connectedComponentsWithStats(depth_mm == 0, labels, boxes, ignored);
  int enclosed = 0;
  for (int i = 1; i < count; ++i) {
    const cv::Rect box(boxes.at<int>(i, cv::CC_STAT_LEFT), boxes.at<int>(i, cv::CC_STAT_TOP),
                       boxes.at<int>(i, cv::CC_STAT_WIDTH), boxes.at<int>(i, cv::CC_STAT_HEIGHT));
    const bool reaches_border =
        box.x == 0 || box.y == 0 || box.br().x == depth_mm.cols || box.br().y == depth_mm.rows;
    enclosed += reaches_border ? 0 : 1;
  }
  return enclosed;
}

TEST(DepthRegistration, SeesATiltedWallAsTheColourCameraWould) {
  const Comparison wall(TiltedWall(), DepthBesideColour(), kSize);
  const Errors errors(wall.registered_mm, wall.truth_mm, Everywhere());
  EXPECT_GT(errors.count, 0.85 * kSize.area());  // The depth camera sees less than the colour one.
  EXPECT_LE(errors.largest_mm, 2.0);
  EXPECT_LT(errors.mean_mm, 0.5);
}

TEST(DepthRegistration, LeavesNoPinholesInASurfaceInsideWhatIsSeen) {
  for (const cv::Size size : {cv::Size(160, 120), kSize, cv::Size(1280, 960)}) {
    const Comparison wall(TiltedWall(), DepthBesideColour(), size);
    EXPECT_GT(cv::countNonZero(wall.registered_mm), 0.85 * size.area()) << size;
    EXPECT_EQ(EnclosedHoles(wall.registered_mm), 0) << size;
  }
}

TEST(DepthRegistration, PutsTheEdgeOfAStepWhereTheColourCameraSeesIt) {
  const DepthView view = DepthBesideColour();
  const Comparison scene(ScreenBeforeWall(), view, kSize);
  int moved_px = 0;
  for (int y = 90; y <= 150; y += 10) {
    const int truth = LeftEdge(scene.truth_mm, y);
    EXPECT_NEAR(LeftEdge(scene.registered_mm, y), truth, 1) << y;
    moved_px += std::abs(LeftEdge(scene.raw_mm, y) - truth);
  }
  EXPECT_GT(moved_px / 7, 10);
}

TEST(DepthRegistration, MovesWhatIsNearerFurtherByTheBaseline) {
  DepthView view;
  view.lens = Pinhole(kSize);
  view.colour_from_depth.translation_m.x() = 0.025;
  cv::Mat depth_mm = cv::Mat::zeros(kSize, CV_16UC1);
  depth_mm.at<std::uint16_t>(50, 100) = 1000;
  depth_mm.at<std::uint16_t>(90, 100) = 3500;
  const cv::Mat registered_mm = Registered(view, Pinhole(kSize), depth_mm);
  // f b / z = 280 px * 25 mm / z: 7 px and 2 px.
  EXPECT_EQ(registered_mm.at<std::uint16_t>(50, 107), 1000);
  EXPECT_EQ(registered_mm.at<std::uint16_t>(90, 102), 3500);
  EXPECT_EQ(cv::countNonZero(registered_mm), 2);
}

TEST(DepthRegistration, WritesDepthAlongTheColourCamerasAxis) {
  DepthView view;
  view.lens = Pinhole(kSize);
  const double angle_rad = 20.0 * M_PI / 180.0;
  view.colour_from_depth.rotation = Eigen::AngleAxisd(angle_rad, Eigen::Vector3d::UnitY());
  const cv::Mat depth_mm(kSize, CV_16UC1, cv::Scalar(2000));
  const cv::Mat registered_mm = Registered(view, Pinhole(kSize), depth_mm);
  // The depth camera's axis meets the wall at (sin, cos) * 2 m.
  const auto x = static_cast<int>(std::lround(158.0 + 280.0 * std::tan(angle_rad)));
  EXPECT_NEAR(registered_mm.at<std::uint16_t>(121, x), 2000.0 * std::cos(angle_rad), 2.0);
}

TEST(DepthRegistration, MeasuresNothingWhereTheDepthCameraSeesNothing) {
  const Comparison scene(ScreenBeforeWall(), DepthBesideColour(), kSize);
  cv::Mat core;  // A pixel away from where it begins.
  cv::erode(scene.hidden, core, cv::Mat());
  ASSERT_GT(cv::countNonZero(core), 150);
  EXPECT_EQ(cv::countNonZero((scene.registered_mm > 0) & core), 0);
}

TEST(DepthRegistration, LetsNothingBehindShineThrough) {
  const Comparison scene(ScreenBeforeWall(), DepthBesideColour(), {1280, 960});
  cv::Mat core;
  cv::erode(scene.truth_mm == 1000, core, cv::Mat(), cv::Point(-1, -1), 5);
  ASSERT_GT(cv::countNonZero(core), 100'000);
  EXPECT_EQ(cv::countNonZero((scene.registered_mm > 1030) & core), 0);
  EXPECT_EQ(cv::countNonZero((scene.registered_mm == 0) & core), 0);
}

TEST(DepthRegistration, MakesUpNoDistancesBetweenAStepsSides) {
  const Comparison scene(ScreenBeforeWall(), DepthBesideColour(), {1280, 960});
  EXPECT_EQ(cv::countNonZero((scene.registered_mm > 1030) & (scene.registered_mm < 2425)), 0);
}

TEST(DepthRegistration, KeepsWhatIsOnePixelWide) {
  DepthView view;
  view.lens = Pinhole(kSize);
  cv::Mat depth_mm(kSize, CV_16UC1, cv::Scalar(3000));
  depth_mm.col(70).setTo(1000);
  const cv::Mat registered_mm = Registered(view, Pinhole({1280, 960}), depth_mm);
  EXPECT_EQ(cv::countNonZero(registered_mm == 1000), 4 * 960);
}

TEST(DepthRegistration, BringsTheErrorOfAScreenBeforeATiltedWallDown) {
  const DepthScene scene = {TiltedWall().wall, Screen{}};
  const Comparison seen(scene, DepthBesideColour(), kSize);
  const Errors without(seen.raw_mm, seen.truth_mm, Everywhere());
  const Errors with(seen.registered_mm, seen.truth_mm, Everywhere());
  RecordProperty("without", Text(without));
  RecordProperty("with", Text(with));
  const Errors away_from_edges(seen.registered_mm, seen.truth_mm, AwayFromEdges(seen.truth_mm));
  RecordProperty("with_away_from_edges", Text(away_from_edges));
  EXPECT_GT(without.off, 0.03 * without.count);
  EXPECT_LT(with.off, 0.005 * with.count);
  EXPECT_EQ(away_from_edges.off, 0);
  EXPECT_LT(away_from_edges.largest_mm, 4.0);
}

TEST(DepthRegistration, ReproducesWhatIsInTheSameViewAlready) {
  DepthView view;
  view.lens = Pinhole({640, 480});
  cv::Mat depth_mm(480, 640, CV_16UC1);
  cv::RNG random(5);
  random.fill(depth_mm, cv::RNG::UNIFORM, 0, 65536);
  // Half of it a noisy surface, half of it steps, and holes in both.
  cv::Mat surface = depth_mm.colRange(0, 320);
  random.fill(surface, cv::RNG::UNIFORM, 1980, 2020);
  cv::Mat holes(480, 640, CV_8UC1);
  random.fill(holes, cv::RNG::UNIFORM, 0, 256);
  depth_mm.setTo(0, holes < 40);
  const cv::Mat registered_mm = Registered(view, Pinhole({640, 480}), depth_mm);
  EXPECT_EQ(cv::norm(registered_mm, depth_mm, cv::NORM_INF), 0.0);
}

TEST(DepthRegistration, LeavesOutWhatComesToLieBehindTheColourCamera) {
  DepthView view;
  view.lens = Pinhole(kSize);
  view.colour_from_depth.translation_m.z() = -0.2;
  cv::Mat depth_mm(kSize, CV_16UC1, cv::Scalar(100));
  EXPECT_EQ(cv::countNonZero(Registered(view, Pinhole(kSize), depth_mm)), 0);
  depth_mm.setTo(1200);
  EXPECT_EQ(Registered(view, Pinhole(kSize), depth_mm).at<std::uint16_t>(121, 158), 1000);
}

TEST(DepthRegistration, LeavesOutWhereTheLensModelFolds) {
  DepthView view;
  view.lens = Pinhole(kSize);
  view.lens.distortion_model = geometry::DistortionModel::kPlumbBob;
  view.lens.distortion = {-1.5, 0.0, 0.0, 0.0, 0.0};
  const cv::Mat depth_mm(kSize, CV_16UC1, cv::Scalar(1000));
  const cv::Mat registered_mm = Registered(view, Pinhole(kSize), depth_mm);
  EXPECT_EQ(registered_mm.at<std::uint16_t>(121, 158), 1000);
  EXPECT_EQ(cv::countNonZero((registered_mm > 0) & (registered_mm != 1000)), 0);
}

TEST(DepthRegistration, TakesAFisheyesDepth) {
  DepthView view = DepthBesideColour();
  view.lens.distortion_model = geometry::DistortionModel::kFisheye;
  view.lens.distortion = {0.02, -0.01, 0.004, -0.001};
  cv::Mat depth_mm(kSize, CV_16UC1, cv::Scalar(2000));
  view.colour_from_depth.rotation.setIdentity();
  const cv::Mat registered_mm = Registered(view, Pinhole(kSize), depth_mm);
  const cv::Rect inside(60, 50, 200, 140);
  EXPECT_EQ(cv::countNonZero(registered_mm(inside) == 1998), inside.area());
}

TEST(DepthRegistration, AllocatesNothingPerPicture) {
  const DepthView view = DepthBesideColour();
  const cv::Mat depth_mm = MeasureDepth(view, ScreenBeforeWall());
  DepthRegistration registration(view, Pinhole({640, 480}));
  cv::Mat registered_mm;
  registration.Register(depth_mm, registered_mm);
  const cv::Mat first_mm = registered_mm.clone();
  const auto* memory = registered_mm.data;
  const std::size_t before = test::AllocatedBytes();
  registration.Register(depth_mm, registered_mm);
  EXPECT_EQ(test::AllocatedBytes(), before);
  EXPECT_EQ(registered_mm.data, memory);
  EXPECT_EQ(cv::norm(registered_mm, first_mm, cv::NORM_INF), 0.0);
}

TEST(DepthRegistration, RefusesDepthThatIsNotItsLens) {
  DepthRegistration registration(DepthBesideColour(), Pinhole(kSize));
  cv::Mat registered_mm;
  EXPECT_THROW(registration.Register(cv::Mat(120, 160, CV_16UC1), registered_mm), std::logic_error);
  EXPECT_THROW(registration.Register(cv::Mat(kSize, CV_8UC1), registered_mm), std::logic_error);
  EXPECT_THROW(DepthRegistration({}, Pinhole(kSize)), std::logic_error);
}

TEST(DepthRegistration, TakesPicturesOfOneRowOrColumn) {
  for (const cv::Size size : {cv::Size(1, 1), cv::Size(8, 1), cv::Size(1, 8)}) {
    DepthView view;
    view.lens = Pinhole(size);
    const cv::Mat depth_mm(size, CV_16UC1, cv::Scalar(900));
    EXPECT_EQ(cv::norm(Registered(view, Pinhole(size), depth_mm), depth_mm, cv::NORM_INF), 0.0);
  }
}

}  // namespace
}  // namespace deixis::stereo_driver
