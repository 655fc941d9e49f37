#include "common/motion/asf.h"

#include <gmock/gmock.h>

#include <cmath>

#include "common/motion/amc.h"
#include "common/motion/bvh.h"
#include "test/common/motion/fault_cases.h"
#include "test/common/motion/motion_samples.h"
#include "test/support/temporary_folder.h"

namespace deixis::motion {
namespace {

using Eigen::Vector3d;
using Kind = ChannelKind;
using testing::ElementsAre;

class AsfTest : public testing::Test {
 protected:
  Asf Read(const std::string& text) const { return ReadAsf(folder_.Write("a.asf", text)); }
  Clip ReadMotion(const std::string& asf, const std::string& amc) const {
    return ReadAmc(Read(asf), folder_.Write("a.amc", amc), 120.0);
  }

  deixis::test::TemporaryFolder folder_;
};

void ExpectNear(const Vector3d& actual, const Vector3d& expected) {
  EXPECT_LT((actual - expected).norm(), 1e-9) << actual.transpose();
}

std::vector<Eigen::Isometry3d> Poses(const Clip& clip, Eigen::Index frame) {
  return ForwardKinematics(clip.skeleton, clip.frames.row(frame).transpose());
}

TEST_F(AsfTest, HasItsBonesDepthFirst) {
  const Skeleton skeleton = Read(kAsf).skeleton;
  std::vector<std::string> names;
  std::vector<int> parents;
  for (const Joint& joint : skeleton.joints) {
    names.push_back(joint.name);
    parents.push_back(joint.parent);
  }
  EXPECT_THAT(names, ElementsAre("root", "leg", "upper", "lower", "hand"));
  EXPECT_THAT(parents, ElementsAre(-1, 0, 0, 2, 3));
  // XYZ means z leftmost, ZXY y leftmost, whatever the order of a bone's numbers.
  EXPECT_THAT(skeleton.joints[2].channels,
              ElementsAre(Kind::kZRotation, Kind::kYRotation, Kind::kXRotation));
  EXPECT_THAT(skeleton.joints[3].channels, ElementsAre(Kind::kYRotation, Kind::kZRotation));
}

TEST_F(AsfTest, HasJointsWhereTheirParentsBonesEnd) {
  const auto joints = Read(kAsf).skeleton.joints;
  constexpr double kUnit_m = 0.0254 / 0.5;
  ExpectNear(joints[0].offset_m, kUnit_m * Vector3d(1.0, 2.0, 3.0));
  ExpectNear(joints[1].offset_m, Vector3d::Zero());
  ExpectNear(joints[3].offset_m, kUnit_m * Vector3d(4.0, 0.0, 0.0));
  ExpectNear(joints[4].offset_m, kUnit_m * Vector3d(1.8, -2.4, 0.0));
  EXPECT_TRUE(joints[3].end_sites_m.empty());
  ExpectNear(joints[4].end_sites_m.at(0), kUnit_m * Vector3d(0.0, 1.2, 0.9));
}

TEST_F(AsfTest, MovesAsNumpyComputes) {
  const Clip clip = ReadMotion(kAsf, kAmc);
  EXPECT_EQ(clip.frames.rows(), 2);
  EXPECT_EQ(clip.frame_rate_hz, 120.0);
  const auto poses = Poses(clip, 0);
  const auto& joints = clip.skeleton.joints;
  ExpectNear(poses[0].translation(), {1.0668, 1.6256, 0.6604});
  ExpectNear(poses[1] * joints[1].end_sites_m.at(0),
             {1.257784332568, 1.486837926057, 0.566665953098});
  ExpectNear(poses[2].translation(), {1.0668, 1.6256, 0.6604});
  ExpectNear(poses[3].translation(), {1.084441585391, 1.828024971437, 0.662173528537});
  ExpectNear(poses[4].translation(), {1.153547063488, 1.963802964896, 0.658361784936});
  ExpectNear(poses[4] * joints[4].end_sites_m.at(0),
             {1.179826698410, 1.896357969575, 0.682173408033});
}

TEST_F(AsfTest, KeepsItsDirectionsWhenNothingTurns) {
  const std::string straight = Replaced(kAsf, "orientation 10 -20 30", "orientation 0 0 0");
  const auto poses = Poses(ReadMotion(straight, kAmc), 1);
  ExpectNear(poses[4].translation(), 0.0508 * Vector3d(1.0 + 4.0 + 1.8, 2.0 - 2.4, 3.0));
}

TEST_F(AsfTest, MovesTheSameAsBvh) {
  const Clip clip = ReadMotion(kAsf, kAmc);
  WriteBvh(ToBvhChannels(clip), folder_.path() / "a.bvh");
  const Clip bvh = ReadBvh(folder_.path() / "a.bvh");
  for (Eigen::Index frame = 0; frame < 2; ++frame) {
    const auto poses = Poses(clip, frame);
    const auto copies = Poses(bvh, frame);
    ASSERT_EQ(copies.size(), poses.size());
    for (std::size_t i = 0; i < poses.size(); ++i) {
      EXPECT_LT((copies[i].matrix() - poses[i].matrix()).cwiseAbs().maxCoeff(), 1e-6) << i;
    }
  }
  ExpectNear(bvh.skeleton.joints[4].end_sites_m.at(0), clip.skeleton.joints[4].end_sites_m[0]);
}

TEST_F(AsfTest, TakesAnglesInRadiansWhereTheFilesSaySo) {
  const Clip clip = ReadMotion(kAsf, Replaced(kAmc, ":DEGREES", ":RADIANS"));
  EXPECT_DOUBLE_EQ(clip.frames(0, 3), 50.0);  // Z of the root.
  std::string radians = Replaced(kAsf, "angle deg", "angle rad");
  radians = Replaced(radians, "axis 20 -30 40", "axis 0 0 0.5");
  const Clip asf_says = ReadMotion(radians, Replaced(kAmc, ":DEGREES\n", ""));
  EXPECT_DOUBLE_EQ(asf_says.frames(0, 3), 50.0);
  EXPECT_NEAR(asf_says.skeleton.joints[2].pre_rotation.z(), std::sin(0.25), 1e-12);
}

TEST_F(AsfTest, ReadsOtherLineEndsAndCase) {
  std::string odd = Replaced(kAmc, "root 10", "  root\t10");
  odd = Replaced(odd, ":DEGREES", ":Degrees \n\n# remark");
  std::string crlf;
  for (const char c : odd) crlf += c == '\n' ? "\r\n" : std::string(1, c);
  EXPECT_EQ(ReadMotion(kAsf, crlf).frames, ReadMotion(kAsf, kAmc).frames);
  const std::string upper = Replaced(kAsf, "dof rx ry rz", "DOF RX RY RZ");
  EXPECT_EQ(ReadMotion(upper, kAmc).frames, ReadMotion(kAsf, kAmc).frames);
}

TEST_F(AsfTest, BeginsAtAnyFrameNumber) {
  const std::string later = Replaced(Replaced(kAmc, "\n1\n", "\n41\n"), "\n2\n", "\n42\n");
  EXPECT_EQ(ReadMotion(kAsf, later).frames, ReadMotion(kAsf, kAmc).frames);
}

TEST_F(AsfTest, RefusesARateThatIsNone) {
  const Asf asf = Read(kAsf);
  const auto amc = folder_.Write("a.amc", kAmc);
  for (const double rate_hz : {0.0, -120.0, std::nan(""), HUGE_VAL}) {
    EXPECT_THROW(ReadAmc(asf, amc, rate_hz), MotionFileError) << rate_hz;
  }
}

}  // namespace
}  // namespace deixis::motion
