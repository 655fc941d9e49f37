#include "common/motion/read_clip.h"

#include <gmock/gmock.h>

#include "test/common/motion/motion_samples.h"
#include "test/support/temporary_folder.h"

namespace deixis::motion {
namespace {

using testing::HasSubstr;

class ReadClipTest : public testing::Test {
 protected:
  static std::string FaultOf(const std::filesystem::path& path, const ClipOptions& options = {}) {
    try {
      ReadClip(path, options);
    } catch (const MotionFileError& error) {
      return error.what();
    }
    return "";
  }

  deixis::test::TemporaryFolder folder_;
};

TEST_F(ReadClipTest, ReadsBvhWhateverTheCaseOfItsExtension) {
  EXPECT_DOUBLE_EQ(ReadClip(folder_.Write("a.bvh", kBvh)).frames(0, 0), 0.1);
  ClipOptions options;
  options.bvh.metres_per_unit = 1.0;
  EXPECT_DOUBLE_EQ(ReadClip(folder_.Write("a.BVH", kBvh), options).frames(0, 0), 10.0);
}

TEST_F(ReadClipTest, FindsTheSkeletonBesideAMotion) {
  folder_.Write("ann.asf", kAsf);
  folder_.Write("bob.asf", "broken");
  const Clip clip = ReadClip(folder_.Write("ann_walk_001_120.amc", kAmc));
  EXPECT_EQ(clip.frames.rows(), 2);
  EXPECT_EQ(clip.frame_rate_hz, 120.0);
}

TEST_F(ReadClipTest, TakesTheSkeletonAndRateThatAreNamed) {
  folder_.Write("ann.asf", "broken");
  ClipOptions options;
  options.asf = folder_.Write("other.asf", kAsf);
  options.amc_frame_rate_hz = 60.0;
  EXPECT_EQ(ReadClip(folder_.Write("ann_walk.amc", kAmc), options).frame_rate_hz, 60.0);
}

TEST_F(ReadClipTest, AsksForTheSkeletonWhenThereIsNotJustOne) {
  const auto amc = folder_.Write("ann_walk.amc", kAmc);
  folder_.Write("bob.asf", kAsf);
  EXPECT_THAT(FaultOf(amc),
              HasSubstr("ann_walk.amc: an AMC file needs its skeleton: name the ASF"));
  folder_.Write("an.asf", kAsf);
  folder_.Write("ann.asf", kAsf);
  EXPECT_THAT(FaultOf(amc), HasSubstr("there are 2: an.asf ann.asf)"));
}

TEST_F(ReadClipTest, RefusesOtherExtensions) {
  EXPECT_THAT(FaultOf(folder_.Write("a.csv", kBvh)), HasSubstr("a.csv: is no motion file"));
  EXPECT_THAT(FaultOf(folder_.path()), HasSubstr("is no motion file"));
  EXPECT_THAT(FaultOf(folder_.path() / "none.amc"), HasSubstr("none.amc: an AMC file needs"));
}

}  // namespace
}  // namespace deixis::motion
