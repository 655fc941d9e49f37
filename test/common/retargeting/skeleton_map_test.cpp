#include "common/retargeting/skeleton_map.h"

#include <gmock/gmock.h>

#include "common/config/config.h"
#include "test/support/temporary_folder.h"

namespace deixis::retargeting {
namespace {

SkeletonMap Shipped(const std::string& name) {
  return LoadSkeletonMap(DEIXIS_SOURCE_DIR "/config/skeletons/" + name + ".yaml");
}

motion::Skeleton Named(const std::vector<std::string>& names) {
  motion::Skeleton skeleton;
  for (const std::string& name : names) {
    motion::Joint joint;
    joint.name = name;
    joint.parent = static_cast<int>(skeleton.joints.size()) - 1;
    skeleton.joints.push_back(joint);
  }
  return skeleton;
}

std::vector<std::string> LimbsOf(const std::vector<DrivenLimb>& driven) {
  std::vector<std::string> names;
  for (const DrivenLimb& limb : driven) names.push_back(limb.limb);
  return names;
}

TEST(SkeletonMap, BindsBothSidesByTheirNames) {
  const auto driven = Bind(Shipped("biovision"), Named({"LeftArm", "RightArm", "RightForeArm"}));
  EXPECT_THAT(LimbsOf(driven), testing::UnorderedElementsAre("left_upper_arm", "right_upper_arm",
                                                             "right_lower_arm"));
}

TEST(SkeletonMap, TakesNamesWithAPrefixAndInAnyCase) {
  const auto driven = Bind(Shipped("biovision"), Named({"mixamorig:Hips", "mixamorig:LEFTUPLEG"}));
  EXPECT_THAT(LimbsOf(driven), testing::UnorderedElementsAre("pelvis", "left_thigh"));
}

TEST(SkeletonMap, IsChosenByMostLimbs) {
  const std::vector<SkeletonMap> maps{Shipped("acclaim"), Shipped("biovision"), Shipped("deixis")};
  EXPECT_EQ(BestMap(maps, Named({"root", "lfemur", "rfemur"})).name, "acclaim");
  EXPECT_EQ(BestMap(maps, Named({"Hips", "LeftUpLeg", "RightUpLeg"})).name, "biovision");
  EXPECT_EQ(BestMap(maps, Named({"pelvis", "left_thigh", "right_thigh"})).name, "deixis");
}

TEST(SkeletonMap, ListsTheJointsThatNoMapKnows) {
  const std::vector<SkeletonMap> maps{Shipped("acclaim")};
  try {
    BestMap(maps, Named({"Bip01", "Bip01_Spine"}));
    FAIL();
  } catch (const config::ConfigError& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("Bip01_Spine"));
    EXPECT_THAT(error.what(), testing::HasSubstr("config/skeletons"));
  }
}

TEST(SkeletonMap, NamesFileLineAndKeyOfWhatIsWrong) {
  const test::TemporaryFolder folder;
  const std::string head = "name: m\nright: r\nleft: l\nlimbs:\n";
  const std::string hand = "  - {limb: hand, side: both, joint: \"{side}hand\"}\n";
  struct Broken {
    std::string text, complaint;
  };
  for (const Broken& broken :
       {Broken{"", "key 'limbs'"}, Broken{"name: m\nlimbs: []\n", "map.yaml:2: key 'limbs'"},
        Broken{"name: ''\nlimbs:\n  - {limb: head, joint: Head}\n", "map.yaml:1: key 'name'"},
        Broken{head + hand + hand, "map.yaml:6: key 'limbs[1].limb'"},
        Broken{head + hand + "  - {limb: left_hand, joint: x}\n", "'left_hand' is there already"},
        Broken{head + "  - {limb: head, joint: Head, ends_at: Head}\n", "limbs[0].ends_at"},
        Broken{head + "  - {limb: head, joint: a, starts_at: b, ends_at: b}\n", ".ends_at"}}) {
    const auto path = folder.Write("map.yaml", broken.text);
    try {
      LoadSkeletonMap(path);
      ADD_FAILURE() << broken.text << " was taken";
    } catch (const config::ConfigError& error) {
      EXPECT_THAT(error.what(), testing::HasSubstr(broken.complaint));
    }
  }
}

TEST(SkeletonMap, RefusesALimbOnBothSidesWithOneJoint) {
  const test::TemporaryFolder folder;
  const auto path = folder.Write("map.yaml",
                                 "name: m\nright: r\nleft: l\nlimbs:\n"
                                 "  - {limb: hand, side: both, joint: hand}\n");
  try {
    LoadSkeletonMap(path);
    FAIL();
  } catch (const config::ConfigError& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("map.yaml"));
    EXPECT_THAT(error.what(), testing::HasSubstr("{side}"));
  }
}

TEST(SkeletonMap, RefusesBothSidesOfOneName) {
  const test::TemporaryFolder folder;
  const auto path = folder.Write("map.yaml",
                                 "name: m\nright: r\nleft: r\nlimbs:\n"
                                 "  - {limb: hand, side: both, joint: \"{side}hand\"}\n");
  try {
    LoadSkeletonMap(path);
    FAIL();
  } catch (const config::ConfigError& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("map.yaml"));
    EXPECT_THAT(error.what(), testing::HasSubstr("left"));
  }
}

}  // namespace
}  // namespace deixis::retargeting
