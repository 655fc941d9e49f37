#include "services/object_detector/core/object_detector.h"

#include <gmock/gmock.h>

#include "test/services/object_detector/clip.h"
#include "test/support/temporary_folder.h"

namespace deixis::object_detector {
namespace {

using testing::ElementsAre;

class ObjectDetectorTest : public testing::Test {
 protected:
  ObjectDetectorTest() {
    config_.places.file = folder_
                              .Write("places.yaml",
                                     "image_width_px: 640\nimage_height_px: 480\nframe: room\n"
                                     "places:\n"
                                     "  - {id: 4, label: lamp, box_px: [10, 20, 30, 40]}\n")
                              .string();
  }
  static std::vector<int> Ids(const scene::Objects& objects) {
    std::vector<int> ids;
    for (const scene::Object& object : objects.objects) ids.push_back(object.id);
    return ids;
  }
  static scene::Objects ShowClip(ObjectDetector& detector, std::int64_t from_us) {
    scene::Objects objects;
    std::int64_t time_us = from_us;
    for (const cv::Mat& bgr : ClipPictures(8)) {
      objects = detector.Detect({{time_us += 66'667}, "CAMERA", bgr});
    }
    return objects;
  }
  test::TemporaryFolder folder_;
  DetectorsConfig config_;
};

TEST_F(ObjectDetectorTest, TellsPlacesAndFacesOfOnePictureTogether) {
  ObjectDetector detector(config_);
  const scene::Objects objects = ShowClip(detector, 0);
  EXPECT_THAT(Ids(objects), ElementsAre(4, 1000));
  EXPECT_EQ(objects.time.microseconds, 8 * 66'667);
  EXPECT_EQ(objects.camera, "CAMERA");
  EXPECT_EQ(objects.frame, "room");
  EXPECT_EQ(objects.source, "object_detector");
}

TEST_F(ObjectDetectorTest, TellsPlacesAtTheFirstPicture) {
  ObjectDetector detector(config_);
  EXPECT_THAT(Ids(detector.Detect({{0}, "CAMERA", ClipPictures(1).at(0)})), ElementsAre(4));
}

TEST_F(ObjectDetectorTest, BeginsAnewWhenTimeGoesBackAndUsesNoIdTwice) {
  ObjectDetector detector(config_);
  ShowClip(detector, 60'000'000);
  EXPECT_THAT(Ids(detector.Detect({{0}, "CAMERA", ClipPictures(1).at(0)})), ElementsAre(4));
  EXPECT_THAT(Ids(ShowClip(detector, 0)), ElementsAre(4, 1001));
}

TEST_F(ObjectDetectorTest, CarriesOnWithPicturesOfAnySize) {
  ObjectDetector detector(config_);
  std::int64_t time_us = 0;
  for (const cv::Size size : {cv::Size(1, 1), cv::Size(3, 700), cv::Size(1920, 1080)}) {
    const cv::Mat bgr(size, CV_8UC3, cv::Scalar::all(70));
    EXPECT_THAT(Ids(detector.Detect({{++time_us}, "CAMERA", bgr})), ElementsAre(4));
  }
}

TEST_F(ObjectDetectorTest, IsContentWithNothingToDetect) {
  DetectorsConfig config;
  config.cascades.trained.clear();
  ObjectDetector detector(config);
  EXPECT_TRUE(ShowClip(detector, 0).objects.empty());
}

TEST_F(ObjectDetectorTest, GivesTheSameAnswersForAnyNumberOfThreads) {
  const int threads = cv::getNumThreads();
  std::vector<scene::Box> boxes;
  for (const int count : {1, 2}) {
    cv::setNumThreads(count);
    ObjectDetector detector(config_);
    boxes.push_back(*ShowClip(detector, 0).objects.at(1).box);
  }
  cv::setNumThreads(threads);
  EXPECT_EQ(boxes[0].x_px, boxes[1].x_px);
  EXPECT_EQ(boxes[0].height_px, boxes[1].height_px);
}

}  // namespace
}  // namespace deixis::object_detector
