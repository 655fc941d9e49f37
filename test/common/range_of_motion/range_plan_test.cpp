// Files of config/kinematics/range_of_motion.yaml that are wrong.
#include "common/range_of_motion/range_plan.h"

#include <gmock/gmock.h>

#include <fstream>

#include "common/config/config.h"
#include "common/range_of_motion/range_of_motion.h"
#include "test/common/range_of_motion/range_samples.h"
#include "test/support/temporary_folder.h"

namespace deixis::range_of_motion {
namespace {

const std::string kGood = R"(joints:
  - joint: elbow
    limbs: [{limb: lower_arm, share: 1}]
    neutral_z: [0, 0, 1]
    neutral_x: [1, 0, 0]
    angles:
      - {name: flexion, axis: [0, 1, 0], positive: flexion, negative: extension}
)";

struct Broken {
  std::string name, old_text, new_text, complaint;
};

std::ostream& operator<<(std::ostream& out, const Broken& broken) { return out << broken.name; }

class BrokenPlans : public testing::TestWithParam<Broken> {};

TEST_P(BrokenPlans, AreRefusedByFileAndKey) {
  const Broken& broken = GetParam();
  std::string text = kGood;
  const auto at = text.find(broken.old_text);
  ASSERT_NE(at, std::string::npos);
  text.replace(at, broken.old_text.size(), broken.new_text);
  const test::TemporaryFolder folder;
  const auto path = folder.path() / "ranges.yaml";
  std::ofstream(path) << text;
  try {
    LoadRangePlan(path);
    FAIL() << "was taken";
  } catch (const config::ConfigError& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("ranges.yaml"));
    EXPECT_THAT(error.what(), testing::HasSubstr(broken.complaint));
  }
}

INSTANTIATE_TEST_SUITE_P(
    All, BrokenPlans,
    testing::Values(Broken{"NoLimb", "[{limb: lower_arm, share: 1}]", "[]", "limbs"},
                    Broken{"Share", "share: 1", "share: 1.5", "share"},
                    Broken{"Neutral", "[0, 0, 1]", "[0, 0]", "neutral_z"},
                    Broken{"Oblique", "[0, 1, 0]", "[0, 1, 1]", "axis"},
                    Broken{"NoMotion", "positive: flexion", "positive: ''", "positive"},
                    Broken{"UnknownKey", "neutral_x", "neutral_w", "neutral_w"},
                    Broken{"NoAngles", "      - {name", "      # - {name", "angles"},
                    Broken{"AllowanceOfNoMotion", "    angles:",
                           "    allowed_beyond: [{motion: flexoin, degrees: 5, why: seen}]\n"
                           "    angles:",
                           "flexoin"},
                    Broken{"SharesNoRotation",
                           "    angles:", "    shares_rotation_below_deg: 20\n    angles:",
                           "shares_rotation_below_deg"},
                    Broken{"Text", "share: 1", "share: many", "share"},
                    Broken{"FewKnots", "    angles:",
                           "    reach: {rest_z: [0, 1, 0], knots: [{motion: flexion, towards: [1, "
                           "0, 0]}]}\n    angles:",
                           "knots"}));

// What LoadRangePlan says of such a file.
std::string SaysOf(const std::string& text) {
  const test::TemporaryFolder folder;
  const auto path = folder.Write("ranges.yaml", text);
  try {
    LoadRangePlan(path, ShippedRows());
  } catch (const config::ConfigError& error) {
    return error.what();
  }
  return "";
}

TEST(RangePlan, IsRefusedWithoutJointsAndWithOneTwice) {
  EXPECT_EQ(SaysOf(kGood), "");
  EXPECT_THAT(SaysOf(""), testing::HasSubstr("ranges.yaml"));
  EXPECT_THAT(SaysOf(""), testing::HasSubstr("'joints'"));
  EXPECT_THAT(SaysOf("joints: []\n"), testing::HasSubstr("ranges.yaml:1: key 'joints'"));
  EXPECT_THAT(SaysOf(kGood + kGood.substr(kGood.find("  - joint"))),
              testing::HasSubstr("ranges.yaml:8: key 'joints[1].joint'"));
}

TEST(RangePlan, IsRefusedByFileAndLineWhenAMotionHasNoRow) {
  std::string text = kGood;
  text.replace(text.find("joint: elbow"), 12, "joint: tail");
  EXPECT_THAT(SaysOf(text), testing::HasSubstr("ranges.yaml:2: key 'joints[0]': joint 'tail'"));
}

TEST(RangePlan, IsReadWhenItIsRight) {
  const test::TemporaryFolder folder;
  std::ofstream(folder.path() / "ranges.yaml") << kGood;
  EXPECT_EQ(LoadRangePlan(folder.path() / "ranges.yaml").joints.size(), 1u);
}

}  // namespace
}  // namespace deixis::range_of_motion
