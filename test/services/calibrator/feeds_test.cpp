#include <gmock/gmock.h>

#include <opencv2/imgcodecs.hpp>

#include "common/config/config.h"
#include "common/images/image.h"
#include "common/messages/image.h"
#include "common/messages/stereo_pair.h"
#include "services/calibrator/feeds/bus_feed.h"
#include "services/calibrator/feeds/file_feed.h"
#include "services/calibrator/feeds/source_feed.h"
#include "test/support/memory_bus.h"
#include "test/support/temporary_folder.h"

namespace deixis::calibrator::test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Pair;

cv::Mat Picture(int value, cv::Size size = {64, 48}) {
  return {size, CV_8UC3, cv::Scalar::all(value)};
}

std::string Message(const std::function<void()>& call) {
  try {
    call();
  } catch (const std::exception& error) {
    return error.what();
  }
  return "nothing was thrown";
}

class CalibratorFeeds : public ::testing::Test {
 protected:
  std::string Write(const std::string& name, const cv::Mat& picture) const {
    const std::string path = (folder_.path() / name).string();
    cv::imwrite(path, picture);
    return path;
  }
  std::string Path(const std::string& name) const { return (folder_.path() / name).string(); }

  deixis::test::TemporaryFolder folder_;
};

TEST_F(CalibratorFeeds, FilesComeAsPeopleCount) {
  for (const char* name : {"left10.png", "left2.png", "left1.png"}) Write(name, Picture(9));
  const auto files = FilesOf({Path("left*.png")}, "--left");
  ASSERT_EQ(files.size(), 3u);
  EXPECT_EQ(files[1].filename(), "left2.png");
  EXPECT_EQ(files[2].filename(), "left10.png");
}

TEST_F(CalibratorFeeds, FilesThatAreNotThereAreNamed) {
  EXPECT_THAT(Message([&] { FilesOf({Path("none*.png")}, "--left"); }), HasSubstr("--left"));
  EXPECT_THAT(Message([&] { FilesOf({folder_.path().string()}, "--left"); }),
              HasSubstr("is a folder"));
}

TEST_F(CalibratorFeeds, ListsOfDifferentLengthAreRefused) {
  const std::filesystem::path a = Write("a.png", Picture(1));
  const std::filesystem::path b = Write("b.png", Picture(2));
  EXPECT_THAT(Message([&] {
                FileFeed({{a, b}, {a}});
              }),
              HasSubstr("--left names 2 pictures but --right 1"));
}

TEST_F(CalibratorFeeds, AFileThatIsNoPictureIsCountedAndNamed) {
  folder_.Write("broken.png", "no picture");
  FileFeed feed({{Path("broken.png"), Write("good.png", Picture(9))}});
  EXPECT_TRUE(feed.Next().sight->bgr[0].empty());
  EXPECT_FALSE(feed.Next().sight->bgr[0].empty());
  EXPECT_EQ(feed.Next().state, capture::SourceState::kFinished);
  EXPECT_THAT(feed.trouble(), HasSubstr("broken.png"));
}

TEST_F(CalibratorFeeds, AFileOfAnAbsurdSizeIsCountedAndNamed) {
  folder_.Write("wide.ppm", "P6 2097152 1 255 ");  // OpenCV throws at it.
  FileFeed feed({{Path("wide.ppm"), Write("good.png", Picture(9))}});
  EXPECT_TRUE(feed.Next().sight->bgr[0].empty());
  EXPECT_FALSE(feed.Next().sight->bgr[0].empty());
  EXPECT_THAT(feed.trouble(), HasSubstr("wide.ppm"));
}

TEST_F(CalibratorFeeds, APictureOfTwoCamerasIsCutInTwo) {
  cv::Mat both;
  cv::hconcat(Picture(50), Picture(200), both);
  Write("pair1.png", both);
  auto config = ParseSource("folder:" + folder_.path().string(), "--source");
  config.rate_hz = 1.0;
  SourceFeed feed(OpenSource(config), PictureLayout::kSideBySide, FeedKind::kRecording);
  EXPECT_EQ(feed.kind(), FeedKind::kRecording);
  const auto sight = feed.Next().sight;
  ASSERT_TRUE(sight);
  ASSERT_EQ(sight->bgr.size(), 2u);
  EXPECT_EQ(sight->bgr[0].size(), cv::Size(64, 48));
  EXPECT_EQ(sight->bgr[0].at<cv::Vec3b>(0, 0)[0], 50);
  EXPECT_EQ(sight->bgr[1].at<cv::Vec3b>(0, 0)[0], 200);
}

TEST_F(CalibratorFeeds, AFolderThatCannotBeLookedAtHasNoTimes) {
  const auto config = ParseSource("folder:" + std::string(300, 'x'), "--source");
  EXPECT_EQ(KindOf({config}), FeedKind::kSeparate);
}

/// Two folders of pictures, those of the right camera lighter by 100 grey levels.
class CalibratorTwoSourceFeed : public CalibratorFeeds {
 protected:
  void SetUp() override {
    for (const char* side : {"left", "right"}) {
      std::filesystem::create_directories(folder_.path() / side);
      for (int i = 0; i < 5; ++i) {
        Write(std::string(side) + "/" + std::to_string(i) + ".png",
              Picture(10 * i + (side[0] == 'r' ? 100 : 0)));
      }
    }
  }
  TwoSourceFeed Open(double rate_hz) const {
    std::vector<capture::SourceConfig> configs{
        ParseSource("folder:" + Path("left"), "--source"),
        ParseSource("folder:" + Path("right"), "--right-source")};
    for (auto& config : configs) config.rate_hz = rate_hz;
    TimeByOrderUnlessAllHaveTimes(configs);
    return {OpenSource(configs[0]), OpenSource(configs[1]), FeedKind::kRecording};
  }
  /// Which picture of the left camera came with which one of the right camera.
  static std::vector<std::pair<int, int>> PairsOf(TwoSourceFeed& feed) {
    std::vector<std::pair<int, int>> pairs;
    for (Take take = feed.Next(); take.state != capture::SourceState::kFinished;
         take = feed.Next()) {
      if (!take.sight) continue;
      const auto grey = [&take](std::size_t side) {
        return int{take.sight->bgr.at(side).at<cv::Vec3b>(0, 0)[0]};
      };
      pairs.emplace_back(grey(0) / 10, (grey(1) - 100) / 10);
    }
    return pairs;
  }
};

TEST_F(CalibratorTwoSourceFeed, RecordingsGoTogetherPictureByPicture) {
  TwoSourceFeed feed = Open(0.0);
  EXPECT_THAT(PairsOf(feed),
              ElementsAre(Pair(0, 0), Pair(1, 1), Pair(2, 2), Pair(3, 3), Pair(4, 4)));
  EXPECT_EQ(feed.trouble(), "");
}

TEST_F(CalibratorTwoSourceFeed, APictureThatCannotBeReadShiftsNoOther) {
  for (const double rate_hz : {0.0, 30.0}) {
    folder_.Write("left/1.png", "no picture");
    folder_.Write("left/2.png", "no picture");
    TwoSourceFeed feed = Open(rate_hz);
    EXPECT_THAT(PairsOf(feed), ElementsAre(Pair(0, 0), Pair(3, 3), Pair(4, 4))) << rate_hz;
    EXPECT_THAT(feed.trouble(), HasSubstr("2 pictures could not be read"));
  }
}

TEST_F(CalibratorTwoSourceFeed, RecordingsWithTimesGoTogetherByThem) {
  folder_.Write("left/times.csv", "file,time_s\n0.png,0\n1.png,0.1\n3.png,0.3\n");
  folder_.Write("right/times.csv", "file,time_s\n0.png,7\n2.png,7.2\n3.png,7.301\n");
  TwoSourceFeed feed = Open(0.0);
  EXPECT_THAT(PairsOf(feed), ElementsAre(Pair(0, 0), Pair(3, 3)));
  EXPECT_THAT(feed.trouble(), HasSubstr("2 pictures had none of the other camera within 40 ms"));
}

TEST_F(CalibratorTwoSourceFeed, OfTimesThatOnlyOneRecordingHasNothingIsMade) {
  folder_.Write("left/times.csv", "file,time_s\n0.png,0\n1.png,0.1\n2.png,0.2\n");
  TwoSourceFeed feed = Open(0.0);
  EXPECT_THAT(PairsOf(feed), ElementsAre(Pair(0, 0), Pair(1, 1), Pair(2, 2)));
}

TEST_F(CalibratorFeeds, OnlyAFolderWithoutTimesIsNoStream) {
  const auto kind = [](const std::string& text) { return KindOf({ParseSource(text, "--source")}); };
  const std::string folder = "folder:" + folder_.path().string();
  EXPECT_EQ(kind(folder), FeedKind::kSeparate);
  folder_.Write("times.csv", "file,time_s\n0.png,0\n");
  EXPECT_EQ(kind(folder), FeedKind::kRecording);
  EXPECT_EQ(kind("video:walk.mp4"), FeedKind::kRecording);
  EXPECT_EQ(kind("device:0"), FeedKind::kLive);
  EXPECT_EQ(kind("url:rtsp://robot"), FeedKind::kLive);
}

TEST_F(CalibratorFeeds, ASourceOfNoKnownKindIsRefused) {
  EXPECT_THAT(Message([] { ParseSource("walk.mp4", "--source"); }), HasSubstr("device:"));
}

TEST_F(CalibratorFeeds, TheNewestPictureOfTheBusIsTaken) {
  auto bus = std::make_unique<transport::Bus>(deixis::test::Memory());
  transport::Bus& publisher = *bus;
  BusFeed feed(std::move(bus), "CAMERA", 1);
  EXPECT_THAT(feed.trouble(), HasSubstr("CAMERA"));
  publisher.Publish("CAMERA", images::Image{{1}, "camera", Picture(10)});
  publisher.Publish("CAMERA", images::Image{{2}, "camera", Picture(20)});
  const auto sight = feed.Next().sight;
  ASSERT_TRUE(sight);
  EXPECT_EQ(sight->time.microseconds, 2);
  EXPECT_EQ(sight->bgr[0].at<cv::Vec3b>(0, 0)[0], 20);
  EXPECT_EQ(feed.Next().state, capture::SourceState::kWaiting);
}

TEST_F(CalibratorFeeds, EveryPictureOfALogIsTakenHoweverManyAreDueAtOnce) {
  transport::BusOptions options = deixis::test::Memory();
  options.deliver_every_message = true;
  auto bus = std::make_unique<transport::Bus>(options);
  transport::Bus& publisher = *bus;
  BusFeed feed(std::move(bus), "CAMERA", 1);
  for (int i = 1; i <= 3; ++i) {
    publisher.Publish("CAMERA", images::Image{{i}, "camera", Picture(10 * i)});
  }
  for (int i = 1; i <= 3; ++i) {
    const auto sight = feed.Next().sight;
    ASSERT_TRUE(sight) << i;
    EXPECT_EQ(sight->time.microseconds, i);
    EXPECT_EQ(sight->bgr[0].at<cv::Vec3b>(0, 0)[0], 10 * i);
  }
  EXPECT_EQ(feed.Next().state, capture::SourceState::kWaiting);
}

TEST_F(CalibratorFeeds, PairsOfTheBusAreTaken) {
  auto bus = std::make_unique<transport::Bus>(deixis::test::Memory());
  transport::Bus& publisher = *bus;
  BusFeed feed(std::move(bus), "STEREO_PAIR", 2);
  publisher.Publish("STEREO_PAIR",
                    images::StereoPair{{{5}, "left", Picture(10)}, {{5}, "right", Picture(20)}});
  const auto sight = feed.Next().sight;
  ASSERT_TRUE(sight);
  ASSERT_EQ(sight->bgr.size(), 2u);
  EXPECT_EQ(sight->bgr[0].at<cv::Vec3b>(0, 0)[0], 10);
  EXPECT_EQ(sight->bgr[1].at<cv::Vec3b>(0, 0)[0], 20);
}

}  // namespace
}  // namespace deixis::calibrator::test
