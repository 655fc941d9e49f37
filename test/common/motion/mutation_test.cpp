#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>
#include <string>

#include "common/motion/amc.h"
#include "common/motion/asf.h"
#include "common/motion/bvh.h"
#include "test/common/motion/motion_samples.h"
#include "test/support/temporary_folder.h"

namespace deixis::motion {
namespace {

constexpr int kMutations = 4000;

/// A text with a few of its bytes changed, left out, doubled or moved.
class Mutation {
 public:
  explicit Mutation(unsigned seed) : random_(seed) {}

  std::string Of(std::string text) {
    for (std::size_t i = Below(2) + 1; i > 0 && !text.empty(); --i) Change(text);
    return text;
  }

 private:
  void Change(std::string& text) {
    const std::string kBytes = "0123456789.-+eE{}():# \t\r\nxyzXYZ";
    const std::size_t at = Below(text.size());
    switch (Below(6)) {
      case 0:
        text[at] = static_cast<char>(Below(256));
        break;
      case 1:
        text[at] = kBytes[Below(kBytes.size())];
        break;
      case 2:
        text.erase(at, Below(8) + 1);
        break;
      case 3:
        text.insert(at, 1, kBytes[Below(kBytes.size())]);
        break;
      case 4:
        text.insert(at, text.substr(Below(text.size()), Below(60)));
        break;
      default:
        text.resize(at + 1);
    }
  }

  std::size_t Below(std::size_t end) { return random_() % end; }

  std::mt19937 random_;
};

struct Outcomes {
  int read = 0;
  int refused = 0;
};

bool IsFinite(const Skeleton& skeleton) {
  bool is_finite = true;
  for (const Joint& joint : skeleton.joints) {
    is_finite = is_finite && joint.offset_m.allFinite() &&
                joint.pre_rotation.coeffs().allFinite() && joint.rest_rotation.coeffs().allFinite();
    for (const Eigen::Vector3d& end_m : joint.end_sites_m) {
      is_finite = is_finite && end_m.allFinite();
    }
  }
  return is_finite;
}

bool IsFinite(const Clip& clip) {
  if (!IsFinite(clip.skeleton) || !clip.frames.allFinite() || clip.frames.rows() == 0) return false;
  for (Eigen::Index row = 0; row < clip.frames.rows(); ++row) {
    for (const auto& pose : ForwardKinematics(clip.skeleton, clip.frames.row(row).transpose())) {
      if (!pose.matrix().allFinite()) return false;
    }
  }
  return std::isfinite(clip.frame_rate_hz) && clip.frame_rate_hz > 0.0;
}

/// Anything else that `read` throws fails the test.
Outcomes MutationsOf(const std::string& good, const std::function<Clip(const std::string&)>& read) {
  Mutation mutation(20);
  Outcomes outcomes;
  for (int i = 0; i < kMutations; ++i) {
    const std::string text = mutation.Of(good);
    try {
      EXPECT_TRUE(IsFinite(read(text))) << text;
      ++outcomes.read;
    } catch (const MotionFileError&) {
      ++outcomes.refused;
    }
  }
  return outcomes;
}

/// Both happen often, or the mutations try nothing.
void ExpectBoth(const Outcomes& outcomes) {
  EXPECT_GT(outcomes.read, kMutations / 40);
  EXPECT_GT(outcomes.refused, kMutations / 40);
}

class MutationTest : public testing::Test {
 protected:
  deixis::test::TemporaryFolder folder_;
};

TEST_F(MutationTest, OfBvhIsReadOrRefused) {
  ExpectBoth(MutationsOf(
      kBvh, [this](const std::string& text) { return ReadBvh(folder_.Write("a.bvh", text)); }));
}

TEST_F(MutationTest, OfAmcIsReadOrRefused) {
  const Asf asf = ReadAsf(folder_.Write("a.asf", kAsf));
  ExpectBoth(MutationsOf(kAmc, [&](const std::string& text) {
    return ReadAmc(asf, folder_.Write("a.amc", text), 120.0);
  }));
}

TEST_F(MutationTest, OfAsfIsReadOrRefused) {
  ExpectBoth(MutationsOf(kAsf, [this](const std::string& text) {
    Skeleton skeleton = ReadAsf(folder_.Write("a.asf", text)).skeleton;
    const Eigen::Index channels = skeleton.ChannelCount();
    return Clip{std::move(skeleton), 120.0, decltype(Clip::frames)::Constant(1, channels, 0.5)};
  }));
}

TEST_F(MutationTest, OfAClipThatIsReadIsWrittenAndReadAgain) {
  MutationsOf(kBvh, [this](const std::string& text) {
    const Clip clip = ReadBvh(folder_.Write("a.bvh", text));
    WriteBvh(clip, folder_.path() / "b.bvh");
    Clip again = ReadBvh(folder_.path() / "b.bvh");
    EXPECT_TRUE(again.frames.isApprox(clip.frames, 1e-12)) << text;
    return again;
  });
}

}  // namespace
}  // namespace deixis::motion
