#include "common/body_model/body_plan.h"

#include <gmock/gmock.h>

#include <cmath>

#include "common/body_model/kinematics.h"
#include "common/config/config.h"
#include "test/support/temporary_folder.h"

namespace deixis::body_model {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;

const char* const kTorso = R"(name: sample
limbs:
  - name: torso
    length: [{of: trunk}]
    proximal: {a: [{metres: 0.1}], b: [{metres: 0.15}]}
    distal: {a: [{metres: 0.1}], b: [{metres: 0.15}]}
)";

const char* const kArm = R"(  - name: upper_arm
    parent: torso
    side: both
    origin: {x: [{metres: 0.01}], y: [{of: width, share: -0.5}], z: [{of: trunk}, {metres: -0.02}]}
    rest_z: [0.2, -1, 0]
    rest_x: [1, 0, 0]
    length: [{of: arm}]
    proximal: {a: [{metres: 0.05}], b: [{metres: 0.04}], y: [{metres: 0.01}]}
    distal: {a: [{metres: 0.04}], b: [{metres: 0.03}]}
    angles:
      - {name: abduction, kind: swing, axis: [1, 0, 0], min_deg: -90, max_deg: 90}
      - {name: flexion, kind: swing, axis: [0, 1, 0], min_deg: -60, max_deg: 120}
      - {name: rotation, kind: twist, axis: [0, 0, -1], min_deg: -90, max_deg: 100}
  - name: lower_arm
    parent: upper_arm
    side: both
    origin: {z: [{of: arm}]}
    rest_z: [0, 0, 1]
    rest_x: [1, 0, 0]
    length: [{of: arm, share: 0.8}]
    proximal: {a: [{metres: 0.04}], b: [{metres: 0.04}]}
    distal: {a: [{metres: 0.03}], b: [{metres: 0.03}]}
    angles:
      - {name: flexion, kind: hinge, axis: [0, 1, 0], min_deg: 0, max_deg: 150}
)";

const Sizes kSizes{{"trunk", 0.5}, {"width", 0.4}, {"arm", 0.3}};

class BodyPlanTest : public testing::Test {
 protected:
  BodyModel Made(const std::string& text, const Sizes& sizes = kSizes) {
    return Build(LoadBodyPlan(folder_.Write("sample.yaml", text)), sizes);
  }
  testing::AssertionResult SaysOf(const std::string& text, const std::string& says) {
    try {
      Made(text);
    } catch (const config::ConfigError& error) {
      if (std::string(error.what()).find(says) != std::string::npos) {
        return testing::AssertionSuccess();
      }
      return testing::AssertionFailure() << error.what();
    }
    return testing::AssertionFailure() << "nothing is said";
  }

  test::TemporaryFolder folder_;
};

TEST_F(BodyPlanTest, MakesBothSidesMirrorImages) {
  const BodyModel model = Made(std::string(kTorso) + kArm);
  ASSERT_EQ(model.limb_count(), 5);
  EXPECT_EQ(model.limbs()[3].name, "right_lower_arm");
  EXPECT_EQ(model.limbs()[3].parent, *model.Find("right_upper_arm"));
  EXPECT_EQ(model.limbs()[4].parent, *model.Find("left_upper_arm"));
  const auto mirrored = [](const Eigen::Vector3d& v) { return Eigen::Vector3d(v[0], -v[1], v[2]); };
  Kinematics kinematics(model);
  BodyPose pose = RestPose(model);
  const Eigen::Vector4d angles(0.3, -0.5, 0.7, 1.1);
  for (const char* side : {"right_", "left_"}) {
    const int upper = model.first_angle(*model.Find(side + std::string("upper_arm")));
    const int lower = model.first_angle(*model.Find(side + std::string("lower_arm")));
    pose.angles_rad.segment<3>(upper) = angles.head<3>();
    pose.angles_rad[lower] = angles[3];
  }
  kinematics.Update(pose);
  for (const int right : {1, 3}) {
    const int left = right + 1;
    EXPECT_LE((mirrored(kinematics.distal_m(right)) - kinematics.distal_m(left)).norm(), 1e-12);
    const auto side_point = [&](int limb, double y) {
      return kinematics.limb(limb) * Eigen::Vector3d(0.03, y, 0.1);
    };
    EXPECT_LE((mirrored(side_point(right, 0.02)) - side_point(left, -0.02)).norm(), 1e-12);
  }
  EXPECT_EQ(model.limbs()[1].shape.centre0_m.y(), 0.01);
  EXPECT_EQ(model.limbs()[2].shape.centre0_m.y(), -0.01);
}

TEST_F(BodyPlanTest, TakesLengthsFromMeasures) {
  const BodyModel model = Made(std::string(kTorso) + kArm);
  EXPECT_NEAR(model.limbs()[3].shape.length_m, 0.24, 1e-12);
  EXPECT_NEAR(model.limbs()[1].rest_in_parent.translation_m.y(), -0.2, 1e-12);
  EXPECT_NEAR(model.limbs()[1].rest_in_parent.translation_m.z(), 0.48, 1e-12);
}

TEST_F(BodyPlanTest, NamesTheMeasuresThatItNeeds) {
  const BodyPlan plan = LoadBodyPlan(folder_.Write("a.yaml", std::string(kTorso) + kArm));
  EXPECT_THAT(MeasuresOf(plan), ElementsAre("arm", "trunk", "width"));
}

struct BrokenBody {
  std::string from, to, place, complaint;
};

TEST_F(BodyPlanTest, NamesFileLineAndKeyOfWhatIsWrong) {
  const std::string good = std::string(kTorso) + kArm;
  for (const BrokenBody& broken :
       {BrokenBody{"parent: torso", "parent: tail", "sample.yaml:8: key 'limbs[1].parent'",
                   "parent 'tail' is no limb"},
        BrokenBody{"parent: torso", "parent: lower_arm", "sample.yaml:8: key 'limbs[1].parent'",
                   "is its own ancestor"},
        BrokenBody{"    parent: torso\n    side: both\n", "", "sample.yaml:7: key 'limbs[1]",
                   "has no parent"},
        BrokenBody{"{of: arm}", "{of: arm, share: -1}", "sample.yaml:13: key 'limbs[1].length'",
                   "length is -0.3"},
        BrokenBody{"{of: arm}", "{of: arm, share: 10.0}, {of: arm}",
                   "sample.yaml:13: key 'limbs[1].length'", "at most 3"},
        BrokenBody{"a: [{metres: 0.05}]", "a: [{metres: -0.05}]",
                   "sample.yaml:14: key 'limbs[1].proximal.a'", "must be positive"},
        BrokenBody{"{of: arm}", "{of: tail}", "sample.yaml:7: key 'limbs[1]'",
                   "measure 'tail' is not known"},
        BrokenBody{"min_deg: -90", "min_deg: 95",
                   "sample.yaml:17: key 'limbs[1].angles[0].max_deg'", "between min_deg and 360"},
        BrokenBody{"min_deg: -90, max_deg: 90", "min_deg: 10, max_deg: 20",
                   "sample.yaml:17: key 'limbs[1].angles[0].min_deg'", "above 0"},
        BrokenBody{"min_deg: -90, max_deg: 90", "min_deg: -20, max_deg: -10",
                   "sample.yaml:17: key 'limbs[1].angles[0].max_deg'", "below 0"},
        BrokenBody{"axis: [1, 0, 0]", "axis: [0, -2, 0]", "key 'limbs[1].angles'",
                   "abduction and flexion swing about the same axis"},
        BrokenBody{"rest_x: [1, 0, 0]", "rest_x: [0.2, -1, 0]",
                   "sample.yaml:12: key 'limbs[1].rest_x'", "parallel"}}) {
    std::string text = good;
    text.replace(text.find(broken.from), broken.from.size(), broken.to);
    try {
      LoadBody(folder_.Write("sample.yaml", text), kSizes);
      ADD_FAILURE() << broken.complaint;
    } catch (const config::ConfigError& error) {
      EXPECT_THAT(error.what(), HasSubstr(broken.place));
      EXPECT_THAT(error.what(), HasSubstr(broken.complaint));
    }
  }
  EXPECT_EQ(LoadBody(folder_.Write("sample.yaml", good), kSizes).id(), Made(good).id());
}

TEST_F(BodyPlanTest, TakesLimbsInAnyOrder) {
  const std::string torso = std::string(kTorso).substr(std::string(kTorso).find("  - name"));
  const BodyModel model = Made("name: sample\nlimbs:\n" + std::string(kArm) + torso);
  EXPECT_EQ(model.limbs()[0].name, "torso");
  EXPECT_EQ(model.id(), Made(std::string(kTorso) + kArm).id());
}

TEST_F(BodyPlanTest, SaysWhatIsWrongWithATree) {
  const std::string torso(kTorso), arm(kArm);
  const auto replaced = [](std::string text, const std::string& from, const std::string& to) {
    return text.replace(text.find(from), from.size(), to);
  };
  EXPECT_TRUE(SaysOf(torso + replaced(arm, "parent: torso", "parent: tail"),
                     "'right_upper_arm': parent 'tail' is no limb"));
  EXPECT_TRUE(SaysOf(torso + replaced(arm, "parent: torso", "parent: lower_arm"),
                     "'right_upper_arm': is its own ancestor"));
  EXPECT_TRUE(SaysOf(torso + replaced(torso.substr(torso.find("  - name")), "torso", "tail"),
                     "'tail': has no parent, but 'torso' is the base limb"));
  EXPECT_TRUE(SaysOf("name: none\nlimbs: []\n", "key 'limbs' must have a limb"));
  EXPECT_TRUE(SaysOf(torso + replaced(arm, "of: arm", "of: leg"), "measure 'leg' is not known"));
  EXPECT_TRUE(SaysOf(torso + replaced(arm, "rest_x: [1, 0, 0]", "rest_x: [0.2, -1, 0]"),
                     "rest_x must not be parallel"));
}

TEST_F(BodyPlanTest, NamesFileLineAndKeyOfWrongValues) {
  const std::string torso(kTorso), arm(kArm);
  const auto replaced = [](std::string text, const std::string& from, const std::string& to) {
    return text.replace(text.find(from), from.size(), to);
  };
  for (const auto& [from, to, says] : std::vector<std::array<std::string, 3>>{
           {"min_deg: -90, max_deg: 90", "min_deg: 91, max_deg: 90", "max_deg"},
           {"kind: twist", "kind: turn", "limbs[1].angles[2].kind"},
           {"axis: [1, 0, 0]", "axis: [0, 0, 0]", "limbs[1].angles[0].axis"},
           {"rest_z: [0.2, -1, 0]", "rest_z: [0.2]", "limbs[1].rest_z"},
           {"{of: arm}", "{of: arm, metres: 1}", "limbs[1].length[0].metres"},
           {"{metres: 0.05}", "{metres: .nan}", "metres"},
           {"side: both", "side: left", "limbs[1].side"}}) {
    EXPECT_TRUE(SaysOf(torso + replaced(arm, from, to), says)) << to;
    EXPECT_TRUE(SaysOf(torso + replaced(arm, from, to), "sample.yaml:")) << to;
  }
  EXPECT_TRUE(SaysOf(torso + replaced(arm, "{metres: 0.05}", "{metres: -0.05}"),
                     "'right_upper_arm': proximal.a is -0.05"));
}

}  // namespace
}  // namespace deixis::body_model
