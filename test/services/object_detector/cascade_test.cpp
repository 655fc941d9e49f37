#include "services/object_detector/core/cascade.h"

#include <gmock/gmock.h>

#include "common/config/config.h"
#include "test/services/object_detector/clip.h"
#include "test/support/temporary_folder.h"

namespace deixis::object_detector {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

const std::vector<std::string> kFolders{"/usr/share/opencv4/haarcascades"};
constexpr const char* kFaces = "haarcascade_frontalface_alt2.xml";

bool Contains(const scene::Box& box, cv::Point2d point) {
  return scene::DistanceTo(box, {point.x, point.y}) == 0.0;
}

TEST(Cascade, FindsTheFaceFirst) {
  Cascade cascade(kFaces, kFolders);
  const auto hits = cascade.Find(Grey(ClipPictures(1).at(0)), 29, 200, 1.1, 3);
  ASSERT_FALSE(hits.empty());
  EXPECT_TRUE(Contains(hits.front().box, kNose));
}

TEST(Cascade, GivesTheSameAnswersForAnyNumberOfThreads) {
  const cv::Mat grey = Grey(ClipPictures(1).at(0));
  const int threads = cv::getNumThreads();
  std::vector<std::vector<scene::Box>> answers;
  for (const int count : {1, 2, 4}) {
    cv::setNumThreads(count);
    answers.push_back(
        Cascade(kFaces, kFolders).AnswersAtWindowSize(grey(cv::Rect(0, 0, 640, 300))));
  }
  cv::setNumThreads(threads);
  const auto same = [](const scene::Box& a, const scene::Box& b) {
    return a.x_px == b.x_px && a.y_px == b.y_px && a.width_px == b.width_px;
  };
  for (const auto& other : answers) {
    ASSERT_EQ(other.size(), answers[0].size());
    EXPECT_TRUE(std::equal(other.begin(), other.end(), answers[0].begin(), same));
  }
}

TEST(Cascade, FindsNothingInAPictureSmallerThanItsWindow) {
  Cascade cascade(kFaces, kFolders);
  const cv::Mat tiny(10, 10, CV_8UC1, cv::Scalar(90));
  EXPECT_TRUE(cascade.AnswersAtWindowSize(tiny).empty());
  EXPECT_TRUE(cascade.Find(tiny, 5, 10, 1.1, 1).empty());
}

TEST(Cascade, SaysTheCureWhenItsFileIsNotThere) {
  EXPECT_THAT([] { Cascade cascade("missing.xml", kFolders); },
              ThrowsMessage<config::ConfigError>(HasSubstr("opencv-data")));
}

TEST(Cascade, RefusesAFileThatIsNoCascade) {
  const test::TemporaryFolder folder;
  const std::string file = folder.Write("no.xml", "<?xml version=\"1.0\"?><a></a>").string();
  EXPECT_THAT([&file] { Cascade cascade(file, {}); },
              ThrowsMessage<config::ConfigError>(HasSubstr("not a cascade")));
}

}  // namespace
}  // namespace deixis::object_detector
