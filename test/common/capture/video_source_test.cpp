#include "common/capture/video_source.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <fstream>
#include <opencv2/core.hpp>

#include "test/support/temporary_folder.h"

namespace deixis::capture {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::ThrowsMessage;

constexpr double kRate_hz = 20.0;

class VideoSourceTest : public testing::Test {
 protected:
  VideoSourceTest() {
    config_.kind = SourceKind::kVideo;
    config_.path = (folder_.path() / "clip.avi").string();
  }
  void WriteClip(int pictures) {
    cv::VideoWriter writer(config_.path, cv::VideoWriter::fourcc('M', 'J', 'P', 'G'), kRate_hz,
                           {64, 48});
    ASSERT_TRUE(writer.isOpened());
    cv::RNG random(7);
    for (int i = 0; i < pictures; ++i) {
      cv::Mat noise(48, 64, CV_8UC3);
      random.fill(noise, cv::RNG::UNIFORM, 0, 255);
      writer.write(noise);
    }
  }
  std::vector<std::int64_t> Times() {
    VideoSource source(config_);
    std::vector<std::int64_t> times;
    for (Grab grab = source.Next(); grab.picture; grab = source.Next()) {
      times.push_back(grab.picture->time.microseconds);
    }
    return times;
  }
  test::TemporaryFolder folder_;
  SourceConfig config_;
};

TEST_F(VideoSourceTest, GivesEveryPictureWithItsTimeFromZero) {
  WriteClip(4);
  EXPECT_THAT(Times(), ElementsAre(0, 50'000, 100'000, 150'000));
}

TEST_F(VideoSourceTest, LetsARateReplaceTheFilesTimes) {
  WriteClip(3);
  config_.rate_hz = 10.0;
  EXPECT_THAT(Times(), ElementsAre(0, 100'000, 200'000));
}

TEST_F(VideoSourceTest, FinishesAtTheEndAndStaysFinished) {
  WriteClip(1);
  VideoSource source(config_);
  EXPECT_EQ(source.Next().state, SourceState::kPicture);
  EXPECT_EQ(source.Next().state, SourceState::kFinished);
  EXPECT_EQ(source.Next().state, SourceState::kFinished);
  EXPECT_EQ(source.status().corrupt, 0);
}

TEST_F(VideoSourceTest, GivesWhatIsLeftOfAFileThatIsCutShort) {
  WriteClip(20);
  std::filesystem::resize_file(config_.path, std::filesystem::file_size(config_.path) / 2);
  const std::vector<std::int64_t> times = Times();
  EXPECT_GT(times.size(), 2u);
  EXPECT_LT(times.size(), 20u);
  VideoSource source(config_);
  while (source.Next().picture) {
  }
  EXPECT_THAT(source.status().last_corrupt, testing::HasSubstr("of 20 pictures"));
}

TEST_F(VideoSourceTest, GoesOnBehindDamage) {
  WriteClip(20);
  std::fstream file(config_.path, std::ios::in | std::ios::out | std::ios::binary);
  file.seekp(static_cast<std::streamoff>(std::filesystem::file_size(config_.path) / 2));
  file << std::string(3000, '\0');
  file.close();
  const std::vector<std::int64_t> times = Times();
  ASSERT_GT(times.size(), 15u);
  EXPECT_TRUE(std::is_sorted(times.begin(), times.end()));
}

TEST_F(VideoSourceTest, RefusesAFileThatIsNotThere) {
  EXPECT_THAT([this] { VideoSource source(config_); },
              ThrowsMessage<config::ConfigError>(HasSubstr("does not exist")));
}

TEST_F(VideoSourceTest, RefusesAFileThatIsNoVideo) {
  config_.path = folder_.Write("clip.avi", "this is no video").string();
  EXPECT_THAT([this] { VideoSource source(config_); },
              ThrowsMessage<config::ConfigError>(HasSubstr("cannot be opened")));
}

}  // namespace
}  // namespace deixis::capture
