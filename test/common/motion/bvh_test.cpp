#include "common/motion/bvh.h"

#include <gmock/gmock.h>
#include <sys/resource.h>
#include <sys/stat.h>

#include <cmath>
#include <csignal>
#include <limits>

#include "test/common/motion/motion_samples.h"
#include "test/support/temporary_folder.h"

namespace deixis::motion {
namespace {

using Eigen::AngleAxisd;
using Eigen::Vector3d;
using Kind = ChannelKind;
using testing::ElementsAre;
using testing::HasSubstr;

class BvhTest : public testing::Test {
 protected:
  Clip Read(const std::string& text) const { return ReadBvh(folder_.Write("a.bvh", text)); }

  Clip WrittenAndRead(const Clip& clip) const {
    WriteBvh(clip, folder_.path() / "b.bvh");
    return ReadBvh(folder_.path() / "b.bvh");
  }

  std::size_t FileCount() const {
    std::size_t count = 0;
    for (const auto& entry : std::filesystem::directory_iterator(folder_.path())) {
      count += entry.exists() ? 1 : 0;
    }
    return count;
  }

  deixis::test::TemporaryFolder folder_;
};

void ExpectNear(const Vector3d& actual, const Vector3d& expected) {
  EXPECT_LT((actual - expected).norm(), 1e-9) << actual.transpose();
}

/// A joint with positions, 10 cm above the root by its OFFSET; a frame for each height.
std::string Lift(const std::vector<double>& heights) {
  std::string text =
      "HIERARCHY\nROOT Hips\n{\n  OFFSET 0 90 0\n  CHANNELS 3 Xposition Yposition Zposition\n"
      "  JOINT Chest\n  {\n    OFFSET 0 10 0\n    CHANNELS 3 Xposition Yposition Zposition\n"
      "    End Site\n    {\n      OFFSET 0 5 0\n    }\n  }\n}\nMOTION\nFrames: " +
      std::to_string(heights.size()) + "\nFrame Time: 0.1\n";
  for (const double height : heights) text += "0 90 0 0 " + std::to_string(height) + " 0\n";
  return text;
}

double HeightAboveRoot(const Clip& clip, Eigen::Index frame) {
  const auto poses = ForwardKinematics(clip.skeleton, clip.frames.row(frame).transpose());
  return poses[1].translation().y() - poses[0].translation().y();
}

TEST_F(BvhTest, TakesPositionsAsPlacesOrAsDifferencesByWhatTheyAreNearer) {
  const Clip places = Read(Lift({10.0, 10.5})), differences = Read(Lift({0.0, 0.5}));
  EXPECT_NEAR(HeightAboveRoot(places, 0), 0.10, 1e-12);
  EXPECT_NEAR(HeightAboveRoot(places, 1), 0.105, 1e-12);
  EXPECT_NEAR(HeightAboveRoot(differences, 0), 0.10, 1e-12);
  EXPECT_NEAR(HeightAboveRoot(differences, 1), 0.105, 1e-12);
  EXPECT_NEAR(places.frames(0, 1), 0.90, 1e-12);  // A root's place stays as it is.
}

TEST_F(BvhTest, GivesThePositionsThatNumpyComputes) {
  const Clip clip = Read(kBvh);
  EXPECT_DOUBLE_EQ(clip.frame_rate_hz, 40.0);
  ASSERT_EQ(clip.frames.rows(), 2);
  const auto poses = ForwardKinematics(clip.skeleton, clip.frames.row(0).transpose());
  ASSERT_EQ(poses.size(), 4u);
  ExpectNear(poses[0].translation(), {0.11, 0.92, -0.02});
  ExpectNear(poses[1].translation(), {0.063015368961, 1.001379768135, -0.054202014333});
  ExpectNear(poses[2].translation(), {0.094268784481, 1.040279611842, -0.043712677942});
  ExpectNear(poses[3].translation(), {0.109672052926, 0.971160788014, -0.066849823702});
  const auto& joints = clip.skeleton.joints;
  ExpectNear(poses[2] * joints[2].end_sites_m.at(0),
             {0.116256294297, 1.073667656435, -0.042375557786});
  ExpectNear(poses[3] * joints[3].end_sites_m.at(0),
             {0.119908930242, 0.955153868010, -0.073093608996});
}

TEST_F(BvhTest, NamesJointsAndTheirParents) {
  const Skeleton skeleton = Read(kBvh).skeleton;
  std::vector<std::string> names;
  std::vector<int> parents;
  for (const Joint& joint : skeleton.joints) {
    names.push_back(joint.name);
    parents.push_back(joint.parent);
  }
  EXPECT_THAT(names, ElementsAre("Hips", "Chest", "Head", "Left Hand"));
  EXPECT_THAT(parents, ElementsAre(-1, 0, 1, 1));
  EXPECT_THAT(skeleton.joints[3].channels, ElementsAre(Kind::kZTranslation, Kind::kXRotation,
                                                       Kind::kXTranslation, Kind::kYRotation));
}

TEST_F(BvhTest, TakesLengthsInTheUnitThatTheCallerSays) {
  const Clip clip = ReadBvh(folder_.Write("a.bvh", kBvh), {0.0254});
  ExpectNear(clip.skeleton.joints[1].offset_m, {0.0, 0.254, 0.0});
  EXPECT_DOUBLE_EQ(clip.frames(0, 1), 90.0 * 0.0254);
  EXPECT_THROW(ReadBvh(folder_.path() / "a.bvh", {0.0}), MotionFileError);
  EXPECT_THROW(ReadBvh(folder_.path() / "a.bvh", {std::nan("")}), MotionFileError);
}

TEST_F(BvhTest, ReadsOtherLineEndsBlanksCommentsAndCase) {
  const Clip clip = Read(kBvh);
  std::string odd = Replaced(kBvh, "HIERARCHY", "\xEF\xBB\xBF\n# by hand\nhierarchy");
  odd = Replaced(odd, "Xposition Yposition", "XPOSITION\typosition");
  odd = Replaced(odd, "End Site", "END site EndOfHead");
  odd = Replaced(odd, "ROOT Hips\n", "Root  Hips ");
  odd = Replaced(odd, "Frame Time: 0.025", "frame  time :+0.025  \n\n\t");
  std::string crlf;
  for (const char c : odd) crlf += c == '\n' ? "\r\n" : std::string(1, c);
  EXPECT_EQ(Read(crlf).frames, clip.frames);
  for (char& c : odd) c = c == '\n' ? '\r' : c;
  EXPECT_EQ(Read(odd).frames, clip.frames);
}

TEST_F(BvhTest, HoldsSeveralRoots) {
  const std::string two =
      Replaced(kBvh, "MOTION\nFrames: 2",
               "ROOT Ball { OFFSET 0 0 7 CHANNELS 1 Xposition }\nMOTION\nFrames: 1");
  const std::string text = Replaced(two, "-0.5 -25\n0 0 0 0 0 0 0 0 0 0 0 0 0\n", "-0.5 -25 9\n");
  const Clip clip = Read(text);
  EXPECT_EQ(clip.skeleton.joints.back().parent, -1);
  EXPECT_DOUBLE_EQ(clip.frames(0, 13), 0.09);
  EXPECT_EQ(WrittenAndRead(clip).frames, clip.frames);
}

TEST_F(BvhTest, IsTheSameAfterAWriteAndARead) {
  const Clip clip = Read(kBvh);
  const Clip again = WrittenAndRead(clip);
  EXPECT_NEAR(again.frame_rate_hz, clip.frame_rate_hz, 1e-9);
  EXPECT_LT((again.frames - clip.frames).cwiseAbs().maxCoeff(), 1e-6);
  ASSERT_EQ(again.skeleton.joints.size(), clip.skeleton.joints.size());
  for (std::size_t i = 0; i < clip.skeleton.joints.size(); ++i) {
    const Joint& joint = clip.skeleton.joints[i];
    const Joint& copy = again.skeleton.joints[i];
    EXPECT_EQ(copy.name, joint.name);
    EXPECT_EQ(copy.parent, joint.parent);
    EXPECT_EQ(copy.channels, joint.channels);
    ExpectNear(copy.offset_m, joint.offset_m);
    ASSERT_EQ(copy.end_sites_m.size(), joint.end_sites_m.size());
    if (!joint.end_sites_m.empty()) ExpectNear(copy.end_sites_m[0], joint.end_sites_m[0]);
  }
}

Joint Named(const std::string& name, int parent, std::vector<Kind> channels) {
  Joint joint;
  joint.name = name;
  joint.parent = parent;
  joint.channels = std::move(channels);
  return joint;
}

TEST_F(BvhTest, WritesJointsDepthFirstWithTheirColumns) {
  Clip clip;
  clip.frame_rate_hz = 50.0;
  clip.skeleton.joints = {Named("a", -1, {Kind::kXTranslation}), Named("b", 0, {Kind::kXRotation}),
                          Named("c", 0, {Kind::kYRotation}), Named("d", 1, {Kind::kZRotation})};
  clip.frames.resize(1, 4);
  clip.frames << 1.0, 2.0, 3.0, 4.0;
  const Clip again = WrittenAndRead(clip);
  EXPECT_EQ(again.skeleton.joints[2].name, "d");
  EXPECT_EQ(again.skeleton.joints[3].name, "c");
  const Eigen::RowVector4d expected(1.0, 2.0, 4.0, 3.0);
  EXPECT_TRUE(again.frames.row(0).isApprox(expected, 1e-12));
}

/// A trunk that is turned at rest and an arm with a pre-rotation; in the second frame and the third
/// the arm's Z and Y turn about one axis.
Clip TurnedClip() {
  Clip clip;
  clip.frame_rate_hz = 120.0;
  clip.skeleton.joints = {
      Named("trunk", -1,
            {Kind::kYTranslation, Kind::kZRotation, Kind::kYRotation, Kind::kXRotation}),
      Named("fixed", 0, {}),
      Named("arm", 1, {Kind::kZRotation, Kind::kXRotation, Kind::kYRotation})};
  clip.skeleton.joints[0].offset_m = {0.2, 0.1, 0.4};
  clip.skeleton.joints[0].rest_rotation = AngleAxisd(0.8, Vector3d(1.0, 2.0, 2.0) / 3.0);
  clip.skeleton.joints[1].offset_m = {0.0, 0.5, 0.1};
  clip.skeleton.joints[2].offset_m = {0.3, 0.0, 0.0};
  clip.skeleton.joints[2].pre_rotation = AngleAxisd(-1.1, Vector3d::UnitY());
  clip.skeleton.joints[2].end_sites_m = {{0.6, 0.0, 0.0}, {0.5, 0.2, 0.0}};
  clip.frames.resize(3, 7);
  const double quarter_rad = std::acos(0.0);
  clip.frames << 0.9, 0.3, -0.7, 1.2, 0.4, -0.5, 2.9,  //
      0.8, 0.1, 0.2, 0.3, 0.7, quarter_rad, 0.2,       //
      0.7, -3.0, 0.0, 0.0, 0.7, -quarter_rad - 1e-9, 0.2;
  return clip;
}

TEST_F(BvhTest, StandsInBvhChannelsAsBefore) {
  Clip clip = TurnedClip();
  // Without the turned axis the arm meets the angle where X is a quarter turn.
  for (const bool is_turned : {true, false}) {
    if (!is_turned) clip.skeleton.joints[2].pre_rotation.setIdentity();
    const Clip bvh = WrittenAndRead(ToBvhChannels(clip));
    for (Eigen::Index row = 0; row < clip.frames.rows(); ++row) {
      const auto before = ForwardKinematics(clip.skeleton, clip.frames.row(row).transpose());
      const auto after = ForwardKinematics(bvh.skeleton, bvh.frames.row(row).transpose());
      for (std::size_t i = 0; i < before.size(); ++i) {
        EXPECT_LT((after[i].matrix() - before[i].matrix()).cwiseAbs().maxCoeff(), 1e-9)
            << i << " in frame " << row;
      }
    }
    EXPECT_THAT(bvh.skeleton.joints[2].end_sites_m, testing::SizeIs(2));
  }
}

TEST_F(BvhTest, HasTheRootsOffsetInItsPositions) {
  const Clip bvh = ToBvhChannels(TurnedClip());
  EXPECT_EQ(bvh.skeleton.joints[0].offset_m, Vector3d::Zero());
  EXPECT_TRUE(bvh.frames.row(0).head(3).isApprox(Eigen::RowVector3d(0.2, 1.0, 0.4), 1e-12));
}

TEST_F(BvhTest, SaysWhatItCannotSay) {
  EXPECT_THROW(WrittenAndRead(TurnedClip()), std::logic_error);
  Clip clip = Read(kBvh);
  clip.skeleton.joints[0].name = "a\nb";
  EXPECT_THROW(WrittenAndRead(clip), std::logic_error);
  clip = Read(kBvh);
  clip.frames.resize(0, 13);
  EXPECT_THROW(WrittenAndRead(clip), std::logic_error);
}

TEST_F(BvhTest, WritesNoNumberThatItWouldNotRead) {
  Clip clip = Read(kBvh);
  for (const double bad : {std::nan(""), std::numeric_limits<double>::infinity(), 1e8}) {
    clip.frames(1, 0) = bad;
    EXPECT_THROW(WrittenAndRead(clip), MotionFileError) << bad;
    EXPECT_EQ(FileCount(), 1u);
  }
}

TEST_F(BvhTest, LeavesTheOldFileWhenThereIsNoRoomForTheNew) {
  const std::filesystem::path path = folder_.Write("b.bvh", "old");
  const Clip clip = Read(kBvh);
  std::signal(SIGXFSZ, SIG_IGN);
  rlimit room{};
  ASSERT_EQ(getrlimit(RLIMIT_FSIZE, &room), 0);
  const rlimit little{100, room.rlim_max};
  ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &little), 0);
  try {
    WriteBvh(clip, path);
    ADD_FAILURE() << "wrote without room";
  } catch (const MotionFileError& error) {
    EXPECT_THAT(error.what(), HasSubstr(path.string() + ": cannot be written"));
  }
  ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &room), 0);
  EXPECT_EQ(deixis::test::FileContent(path), "old");
  EXPECT_EQ(FileCount(), 2u);
}

TEST_F(BvhTest, IsNotWrittenIntoAFolderThatIsNotThere) {
  EXPECT_THROW(WriteBvh(Read(kBvh), folder_.path() / "none" / "b.bvh"), MotionFileError);
  EXPECT_THROW(WriteBvh(Read(kBvh), folder_.path()), MotionFileError);
}

TEST_F(BvhTest, LeavesAPipeInItsPlace) {
  const std::filesystem::path pipe = folder_.path() / "pipe";
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  EXPECT_THROW(WriteBvh(Read(kBvh), pipe), MotionFileError);
  EXPECT_TRUE(std::filesystem::is_fifo(pipe));
}

}  // namespace
}  // namespace deixis::motion
