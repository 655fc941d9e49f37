#include <gmock/gmock.h>

#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>

#include "common/capture/pushed_source.h"
#include "services/stereo_driver/core/sources/matched_source.h"
#include "services/stereo_driver/core/sources/side_by_side_source.h"
#include "services/stereo_driver/core/sources/sources.h"
#include "test/common/capture/scripted_source.h"
#include "test/support/temporary_folder.h"

namespace deixis::stereo_driver {
namespace {

using capture::Picture;
using capture::PictureAt;
using capture::ScriptedSource;
using capture::SourceState;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

std::unique_ptr<capture::Source> Script(const std::vector<std::int64_t>& times_ms) {
  std::vector<Picture> pictures;
  for (const std::int64_t time : times_ms) pictures.push_back(PictureAt(1000 * time));
  return std::make_unique<ScriptedSource>(std::move(pictures));
}

/// A picture every 100 ms, as often as one is asked for; complains when that has no end.
class EndlessSource final : public capture::Source {
 public:
  explicit EndlessSource(std::int64_t first_ms, cv::Size size = {64, 48})
      : first_ms_(first_ms), size_(size) {}

  capture::Grab Next() override {
    if (pictures_ == 1000) throw std::logic_error("asked for pictures without end");
    return {SourceState::kPicture, PictureAt(1000 * (first_ms_ + 100 * pictures_++), size_)};
  }
  capture::SourceStatus status() const override { return {}; }

 private:
  std::int64_t first_ms_;
  cv::Size size_;
  int pictures_ = 0;
};

std::vector<std::int64_t> TimesOf(FrameSource& source) {
  std::vector<std::int64_t> times_ms;
  for (FrameGrab grab = source.Next(); grab.state != SourceState::kFinished; grab = source.Next()) {
    if (grab.frame) times_ms.push_back(grab.frame->time.microseconds / 1000);
  }
  return times_ms;
}

TEST(MatchedSource, PairsByTimeAndCountsTheRest) {
  MatchedSource source(Script({0, 33, 66, 100}), Script({1, 34, 101}), 0.010, ComposePair);
  EXPECT_THAT(TimesOf(source), ElementsAre(0, 33, 100));
  EXPECT_EQ(source.status().unmatched_left, 1);
  EXPECT_EQ(source.status().unmatched_right, 0);
  EXPECT_EQ(source.Next().state, SourceState::kFinished);
}

TEST(MatchedSource, EndsWithTheShorterRecording) {
  MatchedSource source(Script({0, 33, 66, 100, 133}), Script({0}), 0.010, ComposePair);
  EXPECT_THAT(TimesOf(source), ElementsAre(0));
  EXPECT_EQ(source.Next().state, SourceState::kFinished);
}

TEST(MatchedSource, LosesOnlyWhatOneRecordingLacks) {
  std::vector<std::int64_t> all, scattered, with_gap;
  for (std::int64_t i = 0; i < 100; ++i) {
    all.push_back(100 * i);
    if (i % 12 != 7) scattered.push_back(100 * i + 2);
    if (i < 30 || i >= 50) with_gap.push_back(100 * i + 2);
  }
  for (const auto& lacking : {scattered, with_gap}) {
    MatchedSource right(Script(all), Script(lacking), 0.010, ComposePair);
    EXPECT_EQ(TimesOf(right).size(), lacking.size());
    EXPECT_EQ(right.status().unmatched_right, 0);
    MatchedSource left(Script(lacking), Script(all), 0.010, ComposePair);
    EXPECT_EQ(TimesOf(left).size(), lacking.size());
    EXPECT_EQ(left.status().unmatched_left, 0);
  }
}

TEST(MatchedSource, PassesOverPicturesOfTwoSizes) {
  std::vector<Picture> right{PictureAt(0, {32, 24}), PictureAt(33'000)};
  MatchedSource source(Script({0, 33}), std::make_unique<ScriptedSource>(std::move(right)), 0.010,
                       ComposePair);
  EXPECT_THAT(TimesOf(source), ElementsAre(33));
  EXPECT_EQ(source.status().unusable, 1);
}

TEST(MatchedSource, SaysTheTroubleOfEither) {
  capture::SourceStatus lost;
  lost.trouble = "right camera is lost";
  MatchedSource source(Script({}), std::make_unique<ScriptedSource>(std::vector<Picture>{}, lost),
                       0.010, ComposePair);
  EXPECT_EQ(source.status().pictures.trouble, "right camera is lost");
}

TEST(MatchedSource, ReturnsThoughNoTimesMatch) {
  MatchedSource source(std::make_unique<EndlessSource>(0), std::make_unique<EndlessSource>(50),
                       0.010, ComposePair);
  for (int i = 0; i < 3; ++i) EXPECT_EQ(source.Next().state, SourceState::kWaiting);
}

TEST(MatchedSource, ReturnsThoughNoPicturesMakeAFrame) {
  MatchedSource source(std::make_unique<EndlessSource>(0),
                       std::make_unique<EndlessSource>(0, cv::Size(32, 24)), 0.010, ComposePair);
  for (int i = 0; i < 3; ++i) EXPECT_EQ(source.Next().state, SourceState::kWaiting);
  EXPECT_EQ(source.status().unusable, 3);
}

TEST(MatchedSource, KeepsFewPicturesOfALiveCameraWhoseOtherIsSilent) {
  const auto clock = [] { return Timestamp{}; };
  auto left = std::make_unique<capture::PushedSource>("left", clock);
  capture::PushedSource& camera = *left;
  MatchedSource source(std::move(left), std::make_unique<capture::PushedSource>("right", clock),
                       0.010, ComposePair);
  for (std::int64_t i = 0; i < 20; ++i) {
    camera.Push(images::Image{{33'000 * i}, "", cv::Mat(4, 4, CV_8UC3)});
    EXPECT_EQ(source.Next().state, SourceState::kWaiting);
  }
  EXPECT_EQ(source.status().unmatched_left, 15);
}

std::unique_ptr<capture::Source> Halves(int width) {
  Picture picture = PictureAt(5000, {width, 4});
  picture.bgr.colRange(0, width / 2) = cv::Scalar(1, 1, 1);
  picture.bgr.colRange(width / 2, width) = cv::Scalar(9, 9, 9);
  return std::make_unique<ScriptedSource>(std::vector<Picture>{picture});
}

int FirstValue(const cv::Mat& bgr) { return bgr.at<cv::Vec3b>(0, 0)[0]; }

TEST(SideBySideSource, SplitsThePictureInItsMiddle) {
  SideBySideSource source(Halves(12), LeftHalf::kLeft);
  const FrameGrab grab = source.Next();
  const auto& pair = std::get<images::StereoPair>(grab.frame->images);
  EXPECT_EQ(pair.left.bgr.cols, 6);
  EXPECT_EQ(FirstValue(pair.left.bgr), 1);
  EXPECT_EQ(FirstValue(pair.right.bgr), 9);
  EXPECT_EQ(grab.frame->time.microseconds, 5000);
}

TEST(SideBySideSource, TakesTheLeftViewFromTheRightHalfWhenTold) {
  SideBySideSource source(Halves(12), LeftHalf::kRight);
  const FrameGrab grab = source.Next();
  EXPECT_EQ(FirstValue(std::get<images::StereoPair>(grab.frame->images).left.bgr), 9);
}

TEST(SideBySideSource, PassesOverPicturesOfAnOddWidth) {
  SideBySideSource source(Halves(13), LeftHalf::kLeft);
  EXPECT_THAT(TimesOf(source), IsEmpty());
  EXPECT_EQ(source.status().unusable, 1);
}

TEST(SideBySideSource, ReturnsThoughNoPictureMakesAFrame) {
  SideBySideSource source(std::make_unique<EndlessSource>(0, cv::Size(13, 4)), LeftHalf::kLeft);
  for (int i = 0; i < 3; ++i) EXPECT_EQ(source.Next().state, SourceState::kWaiting);
  EXPECT_EQ(source.status().unusable, 3);
}

capture::Clocks NoClocks() {
  return {[] { return Timestamp{}; }, [] { return Timestamp{}; }};
}

class ColourAndDepthTest : public testing::Test {
 protected:
  ColourAndDepthTest() {
    config_.kind = FrameSourceKind::kColourAndDepth;
    for (auto* source : {&config_.left, &config_.right}) {
      source->kind = capture::SourceKind::kFolder;
      source->path = folder_.path().string();
      source->rate_hz = 10.0;
    }
    config_.left.pattern = "*.jpg";
    config_.right.pattern = "*.png";
  }

  void WriteFrame(const std::string& name, const cv::Mat& depth) {
    cv::imwrite((folder_.path() / (name + ".jpg")).string(), cv::Mat(6, 8, CV_8UC3, {1, 2, 3}));
    cv::imwrite((folder_.path() / (name + ".png")).string(), depth);
  }

  test::TemporaryFolder folder_;
  FrameSourceConfig config_;
};

TEST_F(ColourAndDepthTest, GivesTheDepthOfEachPicture) {
  WriteFrame("1", cv::Mat(6, 8, CV_16UC1, cv::Scalar(1500)));
  WriteFrame("2", cv::Mat(6, 8, CV_16UC1, cv::Scalar(4000)));
  const auto source = MakeFrameSource(config_, NoClocks());
  source->Next();
  const FrameGrab grab = source->Next();
  const auto& rgbd = std::get<images::RgbdImage>(grab.frame->images);
  EXPECT_EQ(rgbd.depth.depth_mm.at<std::uint16_t>(3, 3), 4000);
  EXPECT_EQ(rgbd.colour.bgr.cols, 8);
  EXPECT_EQ(grab.frame->time.microseconds, 100'000);
}

TEST_F(ColourAndDepthTest, CountsDepthInItsUnit) {
  WriteFrame("1", cv::Mat(6, 8, CV_16UC1, cv::Scalar(5000)));
  config_.depth_unit_mm = 0.2;
  const auto source = MakeFrameSource(config_, NoClocks());
  const FrameGrab grab = source->Next();
  EXPECT_EQ(std::get<images::RgbdImage>(grab.frame->images).depth.depth_mm.at<std::uint16_t>(0, 0),
            1000);
}

TEST_F(ColourAndDepthTest, LeavesOutWhatIsFartherThanSixteenBitsCanSay) {
  cv::Mat depth(6, 8, CV_16UC1, cv::Scalar(20'000));
  depth.at<std::uint16_t>(0, 0) = 13'107;
  WriteFrame("1", depth);
  config_.depth_unit_mm = 5.0;
  const auto source = MakeFrameSource(config_, NoClocks());
  const FrameGrab grab = source->Next();
  const cv::Mat& depth_mm = std::get<images::RgbdImage>(grab.frame->images).depth.depth_mm;
  EXPECT_EQ(depth_mm.at<std::uint16_t>(0, 0), 65'535);
  EXPECT_EQ(cv::countNonZero(depth_mm), 1);
}

TEST_F(ColourAndDepthTest, CountsPicturesThatAreNoDepthAsCorrupt) {
  WriteFrame("1", cv::Mat(6, 8, CV_8UC1, cv::Scalar(50)));
  WriteFrame("2", cv::Mat(6, 8, CV_16UC1, cv::Scalar(4000)));
  const auto source = MakeFrameSource(config_, NoClocks());
  EXPECT_THAT(TimesOf(*source), ElementsAre(100));
  EXPECT_EQ(source->status().pictures.corrupt, 1);
  EXPECT_THAT(source->status().pictures.last_corrupt, HasSubstr("1.png"));
  EXPECT_EQ(source->status().unmatched_left, 1);
}

TEST_F(ColourAndDepthTest, NamesTheKeyOfAFolderThatIsNotThere) {
  config_.right.path = "/nowhere";
  WriteFrame("1", cv::Mat(6, 8, CV_16UC1, cv::Scalar(1)));
  EXPECT_THAT([&] { MakeFrameSource(config_, NoClocks()); },
              testing::ThrowsMessage<config::ConfigError>(HasSubstr("set source.right.path")));
}

/// Two recordings whose pictures' grey values count from 1.
class LoopTest : public testing::Test {
 protected:
  LoopTest() {
    config_.loop = true;
    for (auto* source : {&config_.left, &config_.right}) {
      source->kind = capture::SourceKind::kFolder;
      source->path = folder_.path().string();
      source->rate_hz = 10.0;
    }
    config_.left.pattern = "left*";
    config_.right.pattern = "right*";
  }

  void WritePictures(const std::string& side, int count, cv::Size size = {8, 6}) {
    for (int i = 1; i <= count; ++i) {
      const std::string name = side + std::to_string(i) + ".png";
      cv::imwrite((folder_.path() / name).string(), cv::Mat(size, CV_8UC3, cv::Scalar::all(i)));
    }
  }

  test::TemporaryFolder folder_;
  FrameSourceConfig config_;
};

TEST_F(LoopTest, KeepsPairsTogetherWhenOneRecordingIsLonger) {
  WritePictures("left", 3);
  WritePictures("right", 2);
  const auto source = MakeFrameSource(config_, NoClocks());
  std::vector<std::int64_t> times_ms;
  for (int asked = 0; times_ms.size() < 6 && asked < 100; ++asked) {
    const FrameGrab grab = source->Next();
    if (!grab.frame) continue;
    const auto& pair = std::get<images::StereoPair>(grab.frame->images);
    EXPECT_EQ(FirstValue(pair.left.bgr), FirstValue(pair.right.bgr));
    times_ms.push_back(grab.frame->time.microseconds / 1000);
  }
  EXPECT_THAT(times_ms, ElementsAre(0, 100, 200, 300, 400, 500));
  EXPECT_EQ(source->status().unmatched_left, 2);  // The third one of both rounds before.
}

TEST_F(LoopTest, EndsWhenARoundGaveNoFrame) {
  config_.kind = FrameSourceKind::kSideBySide;
  WritePictures("left", 2, {13, 4});
  const auto source = MakeFrameSource(config_, NoClocks());
  EXPECT_THAT(TimesOf(*source), IsEmpty());
  EXPECT_EQ(source->status().unusable, 2);
}

TEST(FrameSourceConfig, LoopsNothingThatIsSentByOthers) {
  FrameSourceConfig config;
  config.kind = FrameSourceKind::kPairChannel;
  config.left.kind = config.right.kind = capture::SourceKind::kVideo;
  config.loop = true;
  config::Faults faults;
  config.Check(faults);
  EXPECT_THAT([&] { faults.ThrowIfAny(); },
              testing::ThrowsMessage<config::FaultsFound>(HasSubstr("source.loop")));
}

TEST(FrameSourceConfig, TakesTwoRecordingsOrTwoLiveCameras) {
  FrameSourceConfig config;
  config.left.kind = capture::SourceKind::kVideo;
  config::Faults faults;
  config.Check(faults);
  EXPECT_THAT([&] { faults.ThrowIfAny(); },
              testing::ThrowsMessage<config::FaultsFound>(HasSubstr("source.right.kind")));
}

TEST(MakeFrameSource, NamesBothCamerasWhenNeitherIsThere) {
  FrameSourceConfig config;
  config.left.path = "/nowhere/left";
  config.right.path = "/nowhere/right";
  const capture::Clocks clocks{[] { return Timestamp{}; }, [] { return Timestamp{}; }};
  EXPECT_THAT([&] { MakeFrameSource(config, clocks); },
              testing::ThrowsMessage<config::ConfigError>(
                  testing::AllOf(HasSubstr("/nowhere/left"), HasSubstr("source.left.path"),
                                 HasSubstr("/nowhere/right"), HasSubstr("source.right.path"))));
}

}  // namespace
}  // namespace deixis::stereo_driver
