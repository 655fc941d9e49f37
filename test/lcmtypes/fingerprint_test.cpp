// The fingerprints of all types. A changed one silences every log and every robot that has the old
// type: change a published type by adding a new one (lcmtypes/README.md).
#include <gmock/gmock.h>

#include <cstdint>
#include <deixis/message_types.hpp>
#include <fstream>
#include <iomanip>
#include <map>
#include <sstream>
#include <string>

namespace {

using Fingerprints = std::map<std::string, std::string>;  // "deixis.hand_t" -> 16 hex digits

std::string Hex(std::int64_t fingerprint) {
  std::ostringstream text;
  text << std::hex << std::setw(16) << std::setfill('0') << static_cast<std::uint64_t>(fingerprint);
  return text.str();
}

Fingerprints GeneratedFingerprints() {
  Fingerprints fingerprints;
  deixis::VisitMessageTypes([&fingerprints](auto message_type) {
    fingerprints[message_type.name] = Hex(decltype(message_type)::type::getHash());
  });
  return fingerprints;
}

Fingerprints CheckedInFingerprints() {
  std::ifstream file(DEIXIS_SOURCE_DIR "/test/lcmtypes/fingerprints.txt");
  Fingerprints fingerprints;
  for (std::string line; std::getline(file, line);) {
    if (line.empty() || line.front() == '#') continue;
    std::istringstream words(line);
    std::string name;
    words >> name >> fingerprints[name];
  }
  return fingerprints;
}

// Equal maps: no type without a line in the table, no line without a type.
TEST(Fingerprints, AreThoseOfTheCheckedInTable) {
  EXPECT_THAT(GeneratedFingerprints(), testing::ContainerEq(CheckedInFingerprints()));
}

// Types of other LCM systems, whose fingerprints are given.
TEST(Fingerprints, AreThoseOfTheSystemsThatTheTypesComeFrom) {
  const Fingerprints known = {
      {"bot_core.image_t", "14739ffe13d5f5f0"},
      {"bot_core.images_t", "20ba4f05e8f5e33a"},
      {"bot_core.pointcloud2_t", "0bcd5ce4bf5a1b4a"},
      {"bot_core.rigid_transform_t", "ea9ffbf2acc5c5ae"},
      {"bot_core.joint_state_t", "3e377b4cebc593a4"},
      {"kinect.frame_msg_t", "ac3dd2c457d02257"},
      {"kinect.skeleton_msg_t", "f8e4ed6f5ff9d605"},
  };
  const Fingerprints generated = GeneratedFingerprints();
  for (const auto& fingerprint : known) EXPECT_THAT(generated, testing::Contains(fingerprint));
}

// A fingerprint covers the names and types of fields, not that of the struct. These two, of other
// systems both, have three doubles x y z. Neither is ever sent alone, so neither is told apart by
// it.
constexpr const char* kTwinOfVector3 = "kinect.point3d_t";

// Types with one fingerprint decode as each other without an error.
TEST(Fingerprints, TellAllTypesApart) {
  Fingerprints generated = GeneratedFingerprints();
  ASSERT_EQ(generated.at("geometry_msgs.Vector3"), generated.at(kTwinOfVector3));
  generated.erase(kTwinOfVector3);
  std::map<std::string, std::string> name_of;
  for (const auto& [name, fingerprint] : generated) {
    EXPECT_EQ(name_of.count(fingerprint), 0U) << name << " and " << name_of[fingerprint];
    name_of[fingerprint] = name;
  }
}

}  // namespace
