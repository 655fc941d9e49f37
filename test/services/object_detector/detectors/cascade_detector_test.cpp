#include "services/object_detector/core/detectors/cascade_detector.h"

#include <gtest/gtest.h>

#include "test/services/object_detector/clip.h"

namespace deixis::object_detector {
namespace {

using scene::Object;
using scene::Visibility;

class CascadeDetectorTest : public testing::Test {
 protected:
  std::vector<Object> Show(const cv::Mat& bgr) {
    time_us_ += 66'667;
    return detector_.Detect({{time_us_}, Grey(bgr)});
  }
  /// Shows the first pictures of the clip until the face is known.
  std::vector<Object> ShowTheFace() {
    std::vector<Object> objects;
    for (const cv::Mat& bgr : ClipPictures(8)) objects = Show(bgr);
    return objects;
  }
  static cv::Mat Wall() { return {480, 640, CV_8UC3, cv::Scalar(120, 130, 140)}; }

  int next_id_ = 1000;
  std::int64_t time_us_ = 0;
  CascadeDetector detector_{CascadeConfig{}, CascadesConfig{}, [this] { return next_id_++; }};
};

TEST_F(CascadeDetectorTest, TellsTheFaceWithinAFewPictures) {
  const std::vector<Object> objects = ShowTheFace();
  ASSERT_EQ(objects.size(), 1u);
  EXPECT_EQ(objects[0].id, 1000);
  EXPECT_EQ(objects[0].label, "face");
  EXPECT_EQ(objects[0].kind, scene::ObjectKind::kFace);
  EXPECT_EQ(objects[0].visibility, Visibility::kSeen);
  EXPECT_EQ(objects[0].last_seen.microseconds, time_us_);
  EXPECT_EQ(scene::DistanceTo(*objects[0].box, {kNose.x, kNose.y}), 0.0);
  EXPECT_GT(objects[0].score, 0.8);
}

TEST_F(CascadeDetectorTest, DoesNotTellAFaceAtTheFirstPicture) {
  EXPECT_TRUE(Show(ClipPictures(1).at(0)).empty());
}

TEST_F(CascadeDetectorTest, RemembersAFaceThatIsHiddenAndForgetsItInTime) {
  ShowTheFace();
  const std::int64_t last_seen_us = time_us_;
  std::vector<Object> objects = Show(Wall());
  ASSERT_EQ(objects.size(), 1u);
  EXPECT_EQ(objects[0].id, 1000);
  EXPECT_EQ(objects[0].visibility, Visibility::kOccluded);
  EXPECT_EQ(objects[0].last_seen.microseconds, last_seen_us);
  time_us_ += 3'000'000;
  EXPECT_TRUE(Show(Wall()).empty());
}

TEST_F(CascadeDetectorTest, KeepsTheIdOfAFaceThatComesBack) {
  ShowTheFace();
  for (int i = 0; i < 5; ++i) Show(Wall());
  const std::vector<Object> objects = Show(ClipPictures(9).at(8));
  ASSERT_EQ(objects.size(), 1u);
  EXPECT_EQ(objects[0].id, 1000);
  EXPECT_EQ(objects[0].visibility, Visibility::kSeen);
}

TEST_F(CascadeDetectorTest, GivesAFaceAnotherIdAfterAReset) {
  ShowTheFace();
  detector_.Reset();
  const std::vector<Object> objects = ShowTheFace();
  ASSERT_EQ(objects.size(), 1u);
  EXPECT_EQ(objects[0].id, 1001);
}

TEST_F(CascadeDetectorTest, FindsNoFaceInNoise) {
  cv::RNG random(3);
  std::vector<Object> objects;
  for (int i = 0; i < 30; ++i) {
    cv::Mat noise(240, 320, CV_8UC3);
    random.fill(noise, cv::RNG::NORMAL, 128, 40);
    objects = Show(noise);
    EXPECT_TRUE(objects.empty());
  }
}

TEST_F(CascadeDetectorTest, FindsTheFaceAtOtherSizesOfPicture) {
  for (const double scale : {0.5, 2.0}) {
    detector_.Reset();
    std::vector<Object> objects;
    for (const cv::Mat& bgr : ClipPictures(8)) {
      cv::Mat scaled;
      cv::resize(bgr, scaled, {}, scale, scale, cv::INTER_AREA);
      objects = Show(scaled);
    }
    ASSERT_EQ(objects.size(), 1u) << scale;
    EXPECT_EQ(scene::DistanceTo(*objects[0].box, {scale * kNose.x, scale * kNose.y}), 0.0);
  }
}

}  // namespace
}  // namespace deixis::object_detector
