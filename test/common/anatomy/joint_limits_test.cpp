#include "common/anatomy/joint_limits.h"

#include <gmock/gmock.h>

#include <map>

#include "common/config/config.h"
#include "test/support/temporary_folder.h"

namespace deixis::anatomy {
namespace {

using testing::HasSubstr;

const JointLimits& Shipped() {
  static const JointLimits limits =
      JointLimits::Load(DEIXIS_SOURCE_DIR "/config/kinematics/joint_limits.yaml");
  return limits;
}

TEST(JointLimits, AreAllRowsOfTheSource) {
  std::map<std::string, int> rows;
  for (const JointLimit& row : Shipped().rows()) ++rows[row.joint];
  EXPECT_EQ(rows, (std::map<std::string, int>{{"cervical_spine", 4},
                                              {"thoracolumbar_spine", 4},
                                              {"spine", 4},
                                              {"shoulder", 6},
                                              {"elbow", 4},
                                              {"wrist", 4},
                                              {"hip", 10},
                                              {"knee", 4},
                                              {"ankle", 6}}));
}

// Sums of the source's column, counted twice: one wrong digit changes one of them.
TEST(JointLimits, AddUpToTheSumsOfTheSource) {
  double low_deg = 0.0, high_deg = 0.0;
  for (const JointLimit& row : Shipped().rows()) {
    low_deg += row.low_deg;
    high_deg += row.high_deg;
  }
  EXPECT_EQ(low_deg, 2775.0);
  EXPECT_EQ(high_deg, 2890.0);
}

TEST(JointLimits, HoldToBothSidesForTheSpineOnly) {
  for (const JointLimit& row : Shipped().rows()) {
    const bool is_spine = row.joint.find("spine") != std::string::npos;
    const bool has_sides = row.motion == "lateral_flexion" || row.motion == "rotation";
    EXPECT_EQ(row.is_to_both_sides, is_spine && has_sides) << row.joint << " " << row.motion;
  }
}

TEST(JointLimits, SayWhyWhereTheyDifferFromWhatWasPrinted) {
  int corrected = 0;
  for (const JointLimit& row : Shipped().rows()) {
    EXPECT_EQ(row.printed.empty(), row.why.empty()) << row.joint << " " << row.motion;
    corrected += row.printed.empty() ? 0 : 1;
  }
  EXPECT_EQ(corrected, 13);  // Vental 3, refelexion, outside rotation, defection 6, the knee 2.
}

TEST(JointLimits, AreFoundHoweverWideTheSpacesAre) {
  EXPECT_EQ(Shipped().Of("knee  joint").size(), 4u);
  EXPECT_TRUE(Shipped().Of("kneejoint").empty());
}

TEST(JointLimits, AreRefusedWithoutRows) {
  const test::TemporaryFolder folder;
  for (const char* text : {"", "joints: []\nmotions: []\nlimits: []\n"}) {
    const auto path = folder.Write("limits.yaml", text);
    try {
      JointLimits::Load(path);
      ADD_FAILURE() << "were taken";
    } catch (const config::ConfigError& error) {
      EXPECT_THAT(error.what(), HasSubstr("limits.yaml"));
      EXPECT_THAT(error.what(), HasSubstr("'limits'"));
    }
  }
}

TEST(JointLimits, KeepRangesAsRanges) {
  const JointLimit& wrist = Shipped().At("wrist", Posture::kAny, "dorsal_extension");
  EXPECT_EQ(wrist.low_deg, 40.0);
  EXPECT_EQ(wrist.high_deg, 60.0);
}

TEST(JointLimits, OfTheSpinesPartsAddUpToThoseOfTheWhole) {
  for (const char* motion : {"lateral_flexion", "ventral_flexion", "dorsal_flexion", "rotation"}) {
    const auto limit = [motion](const char* joint) {
      return Shipped().At(joint, Posture::kAny, motion).high_deg;
    };
    EXPECT_EQ(limit("cervical_spine") + limit("thoracolumbar_spine"), limit("spine")) << motion;
  }
}

TEST(JointLimits, CorrectTheKneeAndKeepWhatWasPrinted) {
  const JointLimit& flexion = Shipped().At("knee", Posture::kStretched, "flexion");
  EXPECT_EQ(flexion.low_deg, 120.0);
  EXPECT_EQ(flexion.high_deg, 150.0);
  EXPECT_THAT(flexion.printed, HasSubstr("5"));
  EXPECT_THAT(flexion.why, HasSubstr("exchanged"));
  EXPECT_EQ(Shipped().At("knee", Posture::kStretched, "extension").high_deg, 10.0);
  EXPECT_EQ(Shipped().At("shoulder", Posture::kAny, "outside_rotation").high_deg, 90.0);
}

TEST(JointLimits, AreFoundByTheJointsNameInAnyLanguage) {
  for (const std::string name : {"knee", "Knee joint", "Kniegelenk", "articulatio genus"}) {
    EXPECT_EQ(Shipped().Of(name).size(), 4u) << name;
  }
  EXPECT_TRUE(Shipped().Of("tail").empty());
}

TEST(JointLimits, NameFileAndKeyOfWhatIsWrong) {
  const test::TemporaryFolder folder;
  const std::string good =
      "joints:\n  - {name: knee, english: knee, german: Knie, latin: genu}\n"
      "motions:\n  - {name: flexion, english: flexion, german: Beugen, latin: flexio}\n"
      "limits:\n  - {joint: knee, motion: flexion, low_deg: 5, high_deg: 9}\n";
  const auto loading = [&folder](const std::string& text) {
    return [&folder, text] { JointLimits::Load(folder.Write("limits.yaml", text)); };
  };
  EXPECT_NO_THROW(loading(good)());
  const auto replaced = [&good](const std::string& from, const std::string& to) {
    std::string text = good;
    return text.replace(text.find(from), from.size(), to);
  };
  for (const auto& [from, to, says] : std::vector<std::array<std::string, 3>>{
           {"joint: knee", "joint: tail", "limits[0].joint"},
           {"motion: flexion", "motion: wagging", "limits[0].motion"},
           {"high_deg: 9", "high_deg: 4", "limits[0].high_deg"},
           {"low_deg: 5", "low_deg: 0", "limits[0].low_deg"},
           {"latin: genu", "latin: ''", "joints[0].latin"},
           {"motion: flexion", "motion: flexion, posture: lying", "limits[0].posture"}}) {
    EXPECT_THAT(loading(replaced(from, to)),
                testing::ThrowsMessage<config::ConfigError>(
                    testing::AllOf(HasSubstr("limits.yaml"), HasSubstr(says))))
        << to;
  }
  EXPECT_THAT(loading(good + good.substr(good.find("  - {joint"))),
              testing::ThrowsMessage<config::ConfigError>(HasSubstr("is there already")));
}

}  // namespace
}  // namespace deixis::anatomy
