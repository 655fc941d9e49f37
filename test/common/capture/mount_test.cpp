#include "common/capture/mount.h"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>

#include "test/support/temporary_folder.h"

namespace deixis::capture {
namespace {

using testing::HasSubstr;

MountConfig OnTheHead() { return {"base_link", {0.1, 0.0, 1.2}, {0.5, -0.5, 0.5, -0.5}}; }

/// The key that is named as being wrong; "" when nothing is.
std::string FaultyKey(void (*change)(MountConfig&)) {
  MountConfig config = OnTheHead();
  change(config);
  try {
    config.Validate();
  } catch (const config::FaultsFound& found) {
    return found.faults().at(0).key;
  }
  return "";
}

TEST(MountConfig, NamesTheKeyThatIsWrong) {
  EXPECT_EQ(FaultyKey([](auto&) {}), "");
  EXPECT_EQ(FaultyKey([](auto& m) { m.rotation_wxyz = {1, 1, 0, 0}; }), "rotation_wxyz");
  EXPECT_EQ(FaultyKey([](auto& m) { m.rotation_wxyz = {0, 0, 0, 0}; }), "rotation_wxyz");
  EXPECT_EQ(FaultyKey([](auto& m) { m.rotation_wxyz = {1, 0, 0}; }), "rotation_wxyz");
  EXPECT_EQ(FaultyKey([](auto& m) { m.rotation_wxyz = {1.002, 0, 0, 0}; }), "rotation_wxyz");
  EXPECT_EQ(FaultyKey([](auto& m) { m.rotation_wxyz[0] = std::nan(""); }), "rotation_wxyz");
  EXPECT_EQ(FaultyKey([](auto& m) { m.translation_m[1] = std::nan(""); }), "translation_m");
  EXPECT_EQ(
      FaultyKey([](auto& m) { m.translation_m[2] = std::numeric_limits<double>::infinity(); }),
      "translation_m");
  EXPECT_EQ(FaultyKey([](auto& m) { m.translation_m = {1, 2, 3, 4}; }), "translation_m");
  EXPECT_EQ(FaultyKey([](auto& m) { m.parent_frame = "base\n"; }), "parent_frame");
  EXPECT_EQ(FaultyKey([](auto& m) { m.parent_frame = ""; }), "parent_frame");
}

TEST(MountConfig, IsNoneUntilAFrameIsNamed) {
  const MountConfig config;
  config.Validate();
  EXPECT_TRUE(config.IsIdentity());
  EXPECT_FALSE(MountOf(config));
}

TEST(MountConfig, QuaternionThatIsNearlyOneIsMadeOfLengthOne) {
  MountConfig config = OnTheHead();
  config.rotation_wxyz = {0.5004, -0.5, 0.5, -0.5};
  config.Validate();
  const auto mount = MountOf(config);
  ASSERT_TRUE(mount);
  EXPECT_NEAR(mount->parent_from_camera.rotation.norm(), 1.0, 1e-15);
  EXPECT_EQ(mount->parent_from_camera.translation_m, Eigen::Vector3d(0.1, 0.0, 1.2));
  EXPECT_EQ(mount->parent_frame, "base_link");
}

TEST(MountConfig, FaultInAFileIsNamedWithItsPlace) {
  const test::TemporaryFolder folder;
  const auto file = folder.Write("mount.yaml", "parent_frame: base\nrotation_wxyz: [1, 1, 0, 0]\n");
  EXPECT_THAT([&] { config::Load<MountConfig>(file); },
              testing::ThrowsMessage<config::ConfigError>(
                  testing::AllOf(HasSubstr("mount.yaml:2"), HasSubstr("rotation_wxyz"),
                                 HasSubstr("[0.5, -0.5, 0.5, -0.5]"))));
  folder.Write("mount.yaml", "parent_frame: base\ntranslation_m: [0, .nan, 0]\n");
  EXPECT_THAT([&] { config::Load<MountConfig>(file); },
              testing::ThrowsMessage<config::ConfigError>(HasSubstr("translation_m")));
}

}  // namespace
}  // namespace deixis::capture
