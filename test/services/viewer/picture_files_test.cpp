#include "services/viewer/picture_files.h"

#include <gmock/gmock.h>

#include <opencv2/imgcodecs.hpp>

#include "common/config/config.h"
#include "test/support/temporary_folder.h"

namespace deixis::viewer {
namespace {

class PictureFilesTest : public testing::Test {
 protected:
  std::vector<std::string> Files(const std::filesystem::path& folder) {
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
      if (entry.is_regular_file()) names.push_back(entry.path().filename().string());
    }
    return names;
  }
  static scene::Gesture Event(const std::string& label) {
    scene::Gesture gesture;
    gesture.event_id = 3;
    gesture.time = {1'500'000};
    gesture.object_label = label;
    return gesture;
  }
  test::TemporaryFolder folder_;
  const cv::Mat picture_{4, 6, CV_8UC3, cv::Scalar(1, 2, 3)};
};

TEST_F(PictureFilesTest, MakesItsFolderAndNamesAPictureByItsGesture) {
  const auto folder = folder_.path() / "a" / "b";
  PictureFiles(folder).WriteGesture(Event("lamp"), picture_);
  EXPECT_EQ(cv::imread((folder / "gesture_3_lamp_1500000.png").string()).size(), cv::Size(6, 4));
}

TEST_F(PictureFilesTest, NamesKeyAndFolderOfAFolderThatCannotBeMade) {
  const std::string longest(300, 'x');
  EXPECT_THAT([&] { PictureFiles files(folder_.path() / longest); },
              testing::ThrowsMessage<config::ConfigError>(
                  testing::AllOf(testing::HasSubstr("save_folder"), testing::HasSubstr(longest))));
}

TEST_F(PictureFilesTest, ReplacesTheLatestPicture) {
  const PictureFiles files(folder_.path());
  files.WriteLatest(picture_);
  files.WriteLatest(cv::Mat(8, 8, CV_8UC3, cv::Scalar(0, 0, 0)));
  EXPECT_THAT(Files(folder_.path()), testing::ElementsAre("latest.png"));
  EXPECT_EQ(cv::imread((folder_.path() / "latest.png").string()).size(), cv::Size(8, 8));
}

TEST_F(PictureFilesTest, StaysInItsFolderWhateverALabelSays) {
  const auto folder = folder_.path() / "inside";
  PictureFiles(folder).WriteGesture(Event("../../outside"), picture_);
  PictureFiles(folder).WriteGesture(Event(std::string(5000, 'x')), picture_);
  PictureFiles(folder).WriteGesture(Event(""), picture_);
  EXPECT_EQ(Files(folder).size(), 3u);
  EXPECT_EQ(Files(folder_.path()).size(), 3u);
}

TEST_F(PictureFilesTest, SaysThatAPictureIsLostAlthoughAnOlderOneIsThere) {
  const PictureFiles files(folder_.path());
  files.WriteLatest(picture_);
  // A folder where the unfinished picture would be written, which no right of root's gets round.
  std::filesystem::create_directories(folder_.path() / ".latest.png.part" / "occupied");
  EXPECT_THROW(files.WriteLatest(picture_), PictureNotWritten);
  EXPECT_THAT(Files(folder_.path()), testing::ElementsAre("latest.png"));
}

TEST_F(PictureFilesTest, LeavesNoUnfinishedPictureBehind) {
  std::filesystem::create_directories(folder_.path() / "latest.png" / "occupied");
  EXPECT_THAT([this] { PictureFiles(folder_.path()).WriteLatest(picture_); },
              testing::ThrowsMessage<PictureNotWritten>(testing::HasSubstr("latest.png")));
  EXPECT_TRUE(Files(folder_.path()).empty());
}

TEST_F(PictureFilesTest, RefusesAFolderThatCannotBeMade) {
  const auto file = folder_.Write("file", "");
  EXPECT_THAT([&file] { PictureFiles files(file / "folder"); },
              testing::ThrowsMessage<config::ConfigError>(testing::HasSubstr("save_folder")));
}

}  // namespace
}  // namespace deixis::viewer
