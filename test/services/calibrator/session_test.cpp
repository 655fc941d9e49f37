#include "services/calibrator/session.h"

#include <gmock/gmock.h>

#include <cstdlib>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <sstream>

#include "common/capture/calibration.h"
#include "common/messages/image.h"
#include "common/transport/bus.h"
#include "test/services/calibrator/rendered_board.h"
#include "test/support/temporary_folder.h"

namespace deixis::calibrator::test {
namespace {
namespace fs = std::filesystem;

using deixis::test::FileContent;
using ::testing::AllOf;
using ::testing::ContainsRegex;
using ::testing::HasSubstr;
using ::testing::Not;

constexpr double kBaseline_m = 0.10;
const cv::Vec3d kTurn(0.005, 0.02, -0.01);

/// Pictures of a chessboard by two cameras of one kind, taken once for all tests.
struct Album {
  std::vector<cv::Mat> left;
  std::vector<cv::Mat> right;
};

const Album& Chessboard() {
  static const Album kAlbum = [] {
    const Board board = MakeBoard({});
    const BoardCamera camera(WideLens(), board.layout);
    Album album;
    for (const BoardPose& pose : Poses(board.layout.size_m, 0.5, 14)) {
      album.left.push_back(camera.Take(pose));
      album.right.push_back(camera.Take(SeenFromRight(pose, kBaseline_m, kTurn)));
    }
    return album;
  }();
  return kAlbum;
}

class CalibratorSession : public ::testing::Test {
 protected:
  void Write(const std::string& side, const std::vector<cv::Mat>& pictures) const {
    for (std::size_t i = 0; i < pictures.size(); ++i) {
      cv::imwrite(Path(side + std::to_string(i) + ".png"), pictures[i]);
    }
  }
  /// Makes a stream of the left pictures: one every 0.1 s.
  void WriteTimes(std::size_t pictures) const {
    std::string times = "file,time_s\n";
    for (std::size_t i = 0; i < pictures; ++i) {
      times += "left" + std::to_string(i) + ".png," + std::to_string(0.1 * static_cast<double>(i)) +
               "\n";
    }
    folder_.Write("times.csv", times);
  }
  std::string Path(const std::string& name) const { return (folder_.path() / name).string(); }

  Arguments CameraArguments() const {
    Arguments arguments;
    arguments.feed.left = {Path("left*.png")};
    arguments.output = Path("camera.yml");
    return arguments;
  }
  Arguments StereoArguments() const {
    Arguments arguments = CameraArguments();
    arguments.task = Task::kStereo;
    arguments.feed.right = {Path("right*.png")};
    arguments.output = Path("stereo");
    return arguments;
  }

  int Run(const Arguments& arguments) {
    std::ostringstream out;
    try {
      const int code = calibrator::Run(
          arguments, [] { return false; }, out);
      said_ = out.str();
      return code;
    } catch (...) {
      said_ = out.str();
      throw;
    }
  }
  std::string Refusal(const Arguments& arguments) {
    try {
      return "ended with " + std::to_string(Run(arguments)) + ": " + said_;
    } catch (const std::exception& error) {
      return error.what();
    }
  }

  deixis::test::TemporaryFolder folder_;
  std::string said_;
};

TEST_F(CalibratorSession, FindsTheLensOfRenderedPictures) {
  Write("left", Chessboard().left);
  Arguments arguments = CameraArguments();
  arguments.save = Path("pictures");
  ASSERT_EQ(Run(arguments), 0) << said_;
  const auto lens = capture::ReadLensFile(Path("camera.yml")).calibration;
  EXPECT_NEAR(lens.focal_px.x(), WideLens().matrix(0, 0), 2.5);
  EXPECT_NEAR(lens.focal_px.y(), WideLens().matrix(1, 1), 2.5);
  EXPECT_NEAR(lens.principal_point_px.x(), WideLens().matrix(0, 2), 2.5);
  EXPECT_NEAR(lens.principal_point_px.y(), WideLens().matrix(1, 2), 2.5);
  EXPECT_NEAR(lens.distortion[0], WideLens().distortion[0], 0.03);
  EXPECT_EQ(lens.width_px, 640);
  for (const char* name : {"view_01.png", "latest.png", "coverage.png", "residuals.png"}) {
    EXPECT_FALSE(cv::imread(Path(std::string("pictures/") + name)).empty()) << name;
  }
  EXPECT_THAT(said_, HasSubstr("view  1  left0.png"));
}

TEST_F(CalibratorSession, TheSamePicturesGiveTheSameBytes) {
  Write("left", Chessboard().left);
  Arguments arguments = CameraArguments();
  ASSERT_EQ(Run(arguments), 0);
  const std::string first = FileContent(Path("camera.yml"));
  arguments.permissions.existing = Existing::kReplace;
  ASSERT_EQ(Run(arguments), 0);
  EXPECT_EQ(FileContent(Path("camera.yml")), first);
  EXPECT_THAT(first, Not(HasSubstr("calibration_time")));
}

TEST_F(CalibratorSession, FindsWhereTheCamerasStand) {
  Write("left", Chessboard().left);
  Write("right", Chessboard().right);
  Arguments arguments = StereoArguments();
  arguments.save = Path("pictures");
  ASSERT_EQ(Run(arguments), 0) << said_;
  cv::FileStorage file(Path("stereo/extrinsics.yml"), cv::FileStorage::READ);
  cv::Mat translation;
  file["T"] >> translation;
  EXPECT_NEAR(cv::norm(translation), kBaseline_m, 0.001);
  EXPECT_LT(translation.at<double>(0), 0.0);
  for (const char* key : {"R", "R1", "R2", "P1", "P2", "Q", "image_width"}) {
    EXPECT_FALSE(file[key].empty()) << key;
  }
  EXPECT_NEAR(capture::ReadLensFile(Path("stereo/intrinsics.yml")).calibration.focal_px.x(),
              WideLens().matrix(0, 0), 3.0);
  EXPECT_FALSE(cv::imread(Path("pictures/rectified.png")).empty());
}

TEST_F(CalibratorSession, TheErrorSoFarIsThatOfBothCameras) {
  Write("left", {Chessboard().left.begin(), Chessboard().left.begin() + 4});
  Write("right", {Chessboard().right.begin(), Chessboard().right.begin() + 4});
  Refusal(StereoArguments());
  EXPECT_THAT(said_, ContainsRegex("view  4 .*  error 0\\.[0-9]+, 0\\.[0-9]+ px"));
}

TEST_F(CalibratorSession, TheErrorSoFarIsThatOfTheLensThatIsAskedFor) {
  std::vector<cv::Mat> tall;
  for (int i = 0; i < 4; ++i) {
    cv::resize(Chessboard().left[static_cast<std::size_t>(i)], tall.emplace_back(), {640, 576});
  }
  Write("left", tall);
  Arguments arguments = CameraArguments();
  Refusal(arguments);
  EXPECT_THAT(said_, ContainsRegex("  error 0\\.[01]"));
  arguments.calibration.lens.has_fixed_aspect = true;  // A fifth off.
  Refusal(arguments);
  EXPECT_THAT(said_, ContainsRegex("  error 0\\.[5-9]"));
}

TEST_F(CalibratorSession, SwappedCamerasAreNotWritten) {
  Write("left", Chessboard().right);
  Write("right", Chessboard().left);
  EXPECT_EQ(Run(StereoArguments()), 1);
  EXPECT_THAT(said_, HasSubstr("left and right are swapped"));
  EXPECT_FALSE(fs::exists(Path("stereo/extrinsics.yml")));
}

TEST_F(CalibratorSession, ACharucoMayBePartlyOutOfView) {
  Arguments arguments = CameraArguments();
  arguments.board.kind = BoardKind::kCharuco;
  arguments.board.count = {7, 5};
  arguments.board.square_m = 0.035;
  arguments.board.marker_m = 0.026;
  const Board board = MakeBoard(arguments.board);
  const BoardCamera camera(WideLens(), board.layout);
  std::vector<cv::Mat> pictures;
  for (BoardPose pose : Poses(board.layout.size_m, 0.42, 14)) {
    // Half as far again from the middle: a chessboard would not be found in most of these.
    pose.translation_m +=
        0.5 * cv::Vec3d(pose.translation_m[0] + 0.12, pose.translation_m[1] + 0.09, 0);
    pictures.push_back(camera.Take(pose));
  }
  Write("left", pictures);
  ASSERT_EQ(Run(arguments), 0) << said_;
  const auto lens = capture::ReadLensFile(Path("camera.yml")).calibration;
  EXPECT_NEAR(lens.focal_px.x(), WideLens().matrix(0, 0), 6.0);
  EXPECT_NEAR(lens.principal_point_px.x(), WideLens().matrix(0, 2), 6.0);
}

TEST_F(CalibratorSession, TooFewViewsAreNotWrittenUnlessForcedAndThenMarked) {
  Write("left", {Chessboard().left.begin(), Chessboard().left.begin() + 5});
  Arguments arguments = CameraArguments();
  EXPECT_EQ(Run(arguments), 1);
  EXPECT_THAT(said_, HasSubstr("5 views are too few"));
  EXPECT_FALSE(fs::exists(Path("camera.yml")));
  arguments.permissions.may_write_poor = true;
  EXPECT_EQ(Run(arguments), 0);
  EXPECT_THAT(FileContent(Path("camera.yml")), HasSubstr("deixis_remark"));
  EXPECT_TRUE(capture::ReadLensFile(Path("camera.yml")).calibration.is_calibrated);
}

TEST_F(CalibratorSession, TheSameViewAgainIsNoNewOne) {
  Write("left", std::vector<cv::Mat>(10, Chessboard().left.front()));
  const std::string refusal = Refusal(CameraArguments());
  EXPECT_THAT(said_, HasSubstr("refused  left1.png: corners lie 0.0 px"));
  EXPECT_FALSE(fs::exists(Path("camera.yml"))) << refusal;
}

TEST_F(CalibratorSession, AFileThatIsThereIsKept) {
  Write("left", Chessboard().left);
  folder_.Write("camera.yml", "mine");
  EXPECT_THAT(Refusal(CameraArguments()), HasSubstr("is there already"));
  EXPECT_EQ(FileContent(Path("camera.yml")), "mine");
}

TEST_F(CalibratorSession, AFolderThatCannotBeMadeIsNamedBeforeTheWork) {
  Write("left", Chessboard().left);
  folder_.Write("file", "no folder");
  Arguments arguments = CameraArguments();
  arguments.output = Path("file/camera.yml");
  EXPECT_THAT(Refusal(arguments), AllOf(HasSubstr(Path("file")), HasSubstr("cannot be made")));
  EXPECT_EQ(said_, "");
}

TEST_F(CalibratorSession, PicturesWithoutABoardGiveNothing) {
  Write("left", std::vector<cv::Mat>(3, cv::Mat(480, 640, CV_8UC3, cv::Scalar::all(90))));
  EXPECT_THAT(Refusal(CameraArguments()),
              HasSubstr("no view was accepted out of 3 pictures: 3 no board; check --board"));
}

TEST_F(CalibratorSession, AFolderOfSinglePicturesNeedsNoBoardHeldStill) {
  Write("left", Chessboard().left);
  Arguments arguments = CameraArguments();
  arguments.feed.left.clear();
  arguments.feed.source = "folder:" + folder_.path().string();
  arguments.selection.most_motion_px = -1.0;
  ASSERT_EQ(Run(arguments), 0) << said_;
  EXPECT_THAT(said_, HasSubstr("14 accepted"));
}

TEST_F(CalibratorSession, WhyNoViewWasAcceptedIsCountedAndTheCureIsNamed) {
  const cv::Mat bare(480, 640, CV_8UC3, cv::Scalar::all(90));
  Write("left", {Chessboard().left[0], Chessboard().left[5], Chessboard().left[10], bare});
  WriteTimes(4);
  Arguments arguments = CameraArguments();
  arguments.feed.left.clear();
  arguments.feed.source = "folder:" + folder_.path().string();
  arguments.selection.most_motion_px = -1.0;
  EXPECT_THAT(Refusal(arguments),
              HasSubstr("out of 4 pictures: 1 no board, 3 moving; hold the board still, or set "
                        "--most-motion-px"));
}

TEST_F(CalibratorSession, ABrokenFileIsPassedOverAndTold) {
  Write("left", Chessboard().left);
  folder_.Write("left3.png", "no picture");
  ASSERT_EQ(Run(CameraArguments()), 0) << said_;
  EXPECT_THAT(said_, HasSubstr("cannot be read as pictures: 1, the last one"));
}

TEST_F(CalibratorSession, PicturesOfAnotherSizeAreRefused) {
  Write("left", Chessboard().left);
  cv::Mat smaller;
  cv::resize(Chessboard().left[2], smaller, {480, 360});
  cv::imwrite(Path("left2.png"), smaller);
  ASSERT_EQ(Run(CameraArguments()), 0) << said_;
  EXPECT_THAT(said_, HasSubstr("480x360, not 640x480"));
}

TEST_F(CalibratorSession, CamerasOfDifferentSizeAreRefused) {
  Write("left", Chessboard().left);
  std::vector<cv::Mat> smaller = Chessboard().right;
  for (cv::Mat& picture : smaller) picture = picture.rowRange(20, 480).clone();
  Write("right", smaller);
  EXPECT_THAT(Refusal(StereoArguments()), HasSubstr("differ in size"));
}

TEST_F(CalibratorSession, InARecordingTheBoardMustBeHeldStill) {
  std::vector<cv::Mat> pictures;
  for (const cv::Mat& picture : Chessboard().left) pictures.insert(pictures.end(), 2, picture);
  Write("left", pictures);
  WriteTimes(pictures.size());
  Arguments arguments = CameraArguments();
  arguments.feed.left.clear();
  arguments.feed.source = "folder:" + folder_.path().string();
  arguments.selection.most_motion_px = -1.0;
  arguments.least_change = 0.02;
  arguments.most_views = 12;
  ASSERT_EQ(Run(arguments), 0) << said_;
  EXPECT_THAT(said_, HasSubstr("12 accepted, 12 moving"));
}

TEST_F(CalibratorSession, EveryPictureOfALogIsLookedAtHoweverTheLogIsNamed) {
  const std::string url = "file://" + Path("walk.lcmlog");
  {
    transport::BusOptions options;
    options.url = url + "?mode=w";
    transport::Bus bus(options);
    for (int i = 1; i <= 5; ++i) {
      bus.Publish("CAMERA", images::Image{{i}, "camera", cv::Mat::zeros(48, 64, CV_8UC3)});
    }
  }
  Arguments arguments = CameraArguments();
  arguments.feed.left.clear();
  arguments.feed.channel = "CAMERA";
  arguments.feed.lcm_url = url;
  EXPECT_THAT(Refusal(arguments), HasSubstr("out of 5 pictures"));
  arguments.feed.lcm_url.clear();
  setenv("LCM_DEFAULT_URL", url.c_str(), 1);
  EXPECT_THAT(Refusal(arguments), HasSubstr("out of 5 pictures"));
  unsetenv("LCM_DEFAULT_URL");
}

TEST_F(CalibratorSession, WhoeverStopsItGetsWhatIsThere) {
  Write("left", Chessboard().left);
  std::ostringstream out;
  int asked = 0;
  EXPECT_EQ(calibrator::Run(
                CameraArguments(), [&asked] { return ++asked > 4; }, out),
            1);
  EXPECT_THAT(out.str(), HasSubstr("4 accepted"));
  EXPECT_THAT(out.str(), HasSubstr("4 views are too few"));
}

TEST_F(CalibratorSession, WritesABoardToPrint) {
  Arguments arguments;
  arguments.task = Task::kPrintBoard;
  arguments.output = Path("board.pdf");
  ASSERT_EQ(Run(arguments), 0);
  EXPECT_THAT(FileContent(Path("board.pdf")), HasSubstr("%PDF"));
  EXPECT_THAT(said_, HasSubstr("250 mm"));
}

}  // namespace
}  // namespace deixis::calibrator::test
