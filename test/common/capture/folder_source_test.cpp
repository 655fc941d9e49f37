#include "common/capture/folder_source.h"

#include <gmock/gmock.h>
#include <sys/resource.h>
#include <sys/stat.h>

#include <filesystem>
#include <opencv2/imgcodecs.hpp>

#include "common/capture/picture_file.h"
#include "test/support/temporary_folder.h"

namespace deixis::capture {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::ThrowsMessage;

class FolderSourceTest : public testing::Test {
 protected:
  /// Its grey value tells which picture it is.
  void AddPicture(const std::string& name, int grey) {
    cv::imwrite((folder_.path() / name).string(), cv::Mat(8, 8, CV_8UC3, cv::Scalar::all(grey)));
  }
  SourceConfig Config(double rate_hz) {
    SourceConfig config;
    config.kind = SourceKind::kFolder;
    config.path = folder_.path().string();
    config.rate_hz = rate_hz;
    return config;
  }
  static std::vector<int> Greys(Source& source) {
    std::vector<int> greys;
    for (Grab grab = source.Next(); grab.picture; grab = source.Next()) {
      greys.push_back(grab.picture->bgr.at<cv::Vec3b>(0, 0)[0]);
    }
    return greys;
  }
  static std::vector<std::int64_t> Times(Source& source) {
    std::vector<std::int64_t> times;
    for (Grab grab = source.Next(); grab.picture; grab = source.Next()) {
      times.push_back(grab.picture->time.microseconds);
    }
    return times;
  }
  test::TemporaryFolder folder_;
};

TEST(NaturalOrder, CountsAsPeopleDo) {
  EXPECT_TRUE(NaturallyBefore("img2.png", "img10.png"));
  EXPECT_FALSE(NaturallyBefore("img10.png", "img2.png"));
  EXPECT_TRUE(NaturallyBefore("img009.png", "img10.png"));
  EXPECT_TRUE(NaturallyBefore("a1b2", "a1b10"));
  EXPECT_TRUE(NaturallyBefore("a", "b"));
  EXPECT_FALSE(NaturallyBefore("a1", "a1"));
}

TEST_F(FolderSourceTest, GivesPicturesInNaturalOrderAtTheRate) {
  AddPicture("img10.png", 30);
  AddPicture("img2.png", 20);
  AddPicture("img1.png", 10);
  FolderSource greys(Config(10.0));
  EXPECT_THAT(Greys(greys), ElementsAre(10, 20, 30));
  FolderSource times(Config(10.0));
  EXPECT_THAT(Times(times), ElementsAre(0, 100'000, 200'000));
}

TEST_F(FolderSourceTest, TakesOnlyNamesThatMatchThePattern) {
  AddPicture("001.png", 10);
  AddPicture("001_mask.png", 99);
  SourceConfig config = Config(10.0);
  config.pattern = "[0-9][0-9][0-9].png";
  FolderSource source(config);
  EXPECT_THAT(Greys(source), ElementsAre(10));
}

TEST_F(FolderSourceTest, PassesOverLinksThatLeadInACircle) {
  std::filesystem::create_symlink("circle.png", folder_.path() / "circle.png");
  AddPicture("1.png", 10);
  FolderSource source(Config(10.0));
  EXPECT_THAT(Greys(source), ElementsAre(10));
}

TEST_F(FolderSourceTest, NamesAFolderThatCannotBeRead) {
  AddPicture("1.png", 10);
  rlimit before{};
  ASSERT_EQ(getrlimit(RLIMIT_NOFILE, &before), 0);
  const rlimit none{0, before.rlim_max};  // Rights would keep out no root.
  ASSERT_EQ(setrlimit(RLIMIT_NOFILE, &none), 0);
  EXPECT_THAT([this] { FolderSource source(Config(10.0)); },
              ThrowsMessage<config::ConfigError>(
                  testing::AllOf(HasSubstr(folder_.path().string()), HasSubstr("cannot be read"))));
  setrlimit(RLIMIT_NOFILE, &before);
}

TEST_F(FolderSourceTest, KeepsTheTimesOfItsTable) {
  AddPicture("b.png", 20);
  AddPicture("a.png", 10);
  folder_.Write("times.csv", "file,time_s\nb.png,5.0\na.png,5.25\n");
  FolderSource greys(Config(0.0));
  EXPECT_THAT(Greys(greys), ElementsAre(20, 10));
  FolderSource times(Config(0.0));
  EXPECT_THAT(Times(times), ElementsAre(0, 250'000));
}

TEST_F(FolderSourceTest, PassesOverRowsThatNameNoRegularFile) {
  AddPicture("a.png", 10);
  AddPicture("b.png", 20);
  std::filesystem::create_directory(folder_.path() / "folder.png");
  ASSERT_EQ(mkfifo((folder_.path() / "pipe.png").c_str(), 0600), 0);
  folder_.Write(
      "times.csv",
      "file,time_s\na.png,0\nfolder.png,1\n/dev/zero,2\npipe.png,3\nnone.png,4\nb.png,5\n");
  FolderSource source(Config(0.0));
  EXPECT_THAT(Greys(source), ElementsAre(10, 20));
  EXPECT_EQ(source.status().corrupt, 4);
  EXPECT_THAT(source.status().last_corrupt, HasSubstr("none.png"));
}

TEST_F(FolderSourceTest, PassesOverFilesThatAreLargerThanAnyPicture) {
  AddPicture("a.png", 10);
  AddPicture("b.png", 20);
  std::filesystem::resize_file(folder_.path() / "a.png",
                               kLargestPictureFile + 1);  // no blocks on disk
  FolderSource source(Config(10.0));
  EXPECT_THAT(Greys(source), ElementsAre(20));
  EXPECT_EQ(source.status().corrupt, 1);
}

TEST_F(FolderSourceTest, NamesATableThatIsNoRegularFile) {
  AddPicture("a.png", 10);
  const auto opening = [this] { FolderSource source(Config(10.0)); };
  const auto fault = ThrowsMessage<config::ConfigError>(HasSubstr("times.csv: is no regular file"));
  std::filesystem::create_directory(folder_.path() / "times.csv");
  EXPECT_THAT(opening, fault);
  std::filesystem::remove(folder_.path() / "times.csv");
  ASSERT_EQ(mkfifo((folder_.path() / "times.csv").c_str(), 0600), 0);
  EXPECT_THAT(opening, fault);
}

TEST_F(FolderSourceTest, LetsARateReplaceTheTable) {
  AddPicture("a.png", 10);
  AddPicture("b.png", 20);
  folder_.Write("times.csv", "file,time_s\na.png,5.0\nb.png,9.0\n");
  FolderSource source(Config(20.0));
  EXPECT_THAT(Times(source), ElementsAre(0, 50'000));
}

TEST_F(FolderSourceTest, CountsCorruptPicturesAndGoesOn) {
  AddPicture("1.png", 10);
  folder_.Write("2.png", "this is no picture");
  folder_.Write("3.png", "");
  AddPicture("4.png", 40);
  FolderSource source(Config(10.0));
  EXPECT_THAT(Greys(source), ElementsAre(10, 40));
  EXPECT_EQ(source.status().corrupt, 2);
}

TEST_F(FolderSourceTest, CountsCutJpegFilesAsCorrupt) {
  std::vector<std::uint8_t> jpeg;
  cv::imencode(".jpg", cv::Mat(48, 64, CV_8UC3, cv::Scalar(9, 9, 9)), jpeg);
  folder_.Write("1.jpg", std::string(jpeg.begin(), jpeg.end()));
  folder_.Write("2.jpg", std::string(jpeg.begin(), jpeg.end() - 40));
  FolderSource source(Config(10.0));
  EXPECT_EQ(Greys(source).size(), 1u);
  EXPECT_EQ(source.status().corrupt, 1);
}

TEST_F(FolderSourceTest, CountsPicturesOfAbsurdSizesAsCorrupt) {
  folder_.Write("1.ppm", "P6 2097152 1 255 ");                          // OpenCV throws at it.
  folder_.Write("2.pgm", "P5 70000 1 255 " + std::string(70000, 'x'));  // No JPEG is as wide.
  AddPicture("3.png", 30);
  FolderSource source(Config(10.0));
  EXPECT_THAT(Greys(source), ElementsAre(30));
  EXPECT_EQ(source.status().corrupt, 2);
  FolderSource depth(Config(10.0), FolderContent::kDepth);
  EXPECT_EQ(depth.Next().state, SourceState::kFinished);
}

TEST_F(FolderSourceTest, NamesAFileOfItsTableThatIsMissing) {
  AddPicture("a.png", 10);
  folder_.Write("times.csv", "file,time_s\na.png,1.0\nb.png,2.0\n");
  FolderSource source(Config(0.0));
  EXPECT_THAT(Greys(source), ElementsAre(10));
  EXPECT_EQ(source.status().corrupt, 1);
  EXPECT_THAT(source.status().last_corrupt, HasSubstr("b.png"));
}

TEST_F(FolderSourceTest, KeepsTheFileOfAJpegOnly) {
  AddPicture("1.jpg", 10);
  AddPicture("2.png", 20);
  FolderSource source(Config(10.0));
  EXPECT_EQ(test::FileContent(folder_.path() / "1.jpg").size(), source.Next().picture->jpeg.size());
  EXPECT_TRUE(source.Next().picture->jpeg.empty());
}

TEST_F(FolderSourceTest, RefusesAFolderWithoutTimes) {
  AddPicture("1.png", 10);
  EXPECT_THAT([this] { FolderSource source(Config(0.0)); },
              ThrowsMessage<config::ConfigError>(HasSubstr("set source.rate_hz")));
}

TEST_F(FolderSourceTest, RefusesAFolderWithoutPictures) {
  EXPECT_THAT([this] { FolderSource source(Config(10.0)); },
              ThrowsMessage<config::ConfigError>(HasSubstr("source.pattern")));
}

TEST_F(FolderSourceTest, RefusesAFolderThatIsNotThere) {
  SourceConfig config = Config(10.0);
  config.path += "/missing";
  EXPECT_THAT([&config] { FolderSource source(config); },
              ThrowsMessage<config::ConfigError>(HasSubstr("does not exist")));
}

TEST_F(FolderSourceTest, NamesTheLineOfABadTable) {
  AddPicture("a.png", 10);
  folder_.Write("times.csv", "file,time_s\na.png,1.0\na.png,0.5\n");
  EXPECT_THAT([this] { FolderSource source(Config(0.0)); },
              ThrowsMessage<config::ConfigError>(HasSubstr("times.csv:3")));
  folder_.Write("times.csv", "file,time_s\na.png,soon\n");
  EXPECT_THAT([this] { FolderSource source(Config(0.0)); },
              ThrowsMessage<config::ConfigError>(HasSubstr("times.csv:2")));
  folder_.Write("times.csv", "file,time_s\na.png,1.0\na.png,1e300\n");
  EXPECT_THAT([this] { FolderSource source(Config(0.0)); },
              ThrowsMessage<config::ConfigError>(HasSubstr("times.csv:3")));
  folder_.Write("times.csv", "a.png,1.0\n");
  EXPECT_THAT([this] { FolderSource source(Config(0.0)); },
              ThrowsMessage<config::ConfigError>(HasSubstr("header")));
}

}  // namespace
}  // namespace deixis::capture
