#include <gtest/gtest.h>

#include "common/motion/bvh.h"
#include "test/common/motion/fault_cases.h"
#include "test/common/motion/motion_samples.h"
#include "test/support/temporary_folder.h"

namespace deixis::motion {
namespace {

std::string Nested(int levels) {
  std::string text = "HIERARCHY\nROOT j0\n";
  for (int i = 1; i <= levels; ++i) {
    text += "{ OFFSET 0 1 0 CHANNELS 1 Xrotation JOINT j" + std::to_string(i) + "\n";
  }
  return text;
}

FaultCase Broken(const std::string& what, const std::string& from, const std::string& to, int line,
                 const std::string& key) {
  return {what, Replaced(kBvh, from, to), line, key};
}

std::string CutBefore(const std::string& word) { return kBvh.substr(0, kBvh.find(word)); }

const std::string kFrames = "Frames: 2";
const std::string kTime = "Frame Time: 0.025";

const std::vector<FaultCase> kFaults = {
    {"blank text", " \n\n", 2, "HIERARCHY"},
    {"another format", "PNG\n", 1, "HIERARCHY"},
    {"a binary file", Replaced(kBvh, "Chest", std::string("Ch\0st", 5)), 6, "text"},
    {"no joint", "HIERARCHY\nMOTION\n", 2, "ROOT"},
    {"a file cut in the hierarchy", CutBefore("JOINT Head"), 10, "MOTION"},
    {"a file cut in an offset", CutBefore("1\n      End"), 12, "OFFSET"},
    {"a file cut before its motion", CutBefore("MOTION"), 28, "MOTION"},
    {"a file cut before its frames", CutBefore("Frames"), 29, "Frames"},
    {"a file cut in its frames", CutBefore("0 0 0 0 0 0"), 32, "Frames"},
    {"a file cut in a frame", CutBefore("1.5 70"), 32, "Left Hand Zposition"},
    Broken("a joint without a name", "JOINT Chest", "JOINT", 6, "JOINT"),
    Broken("two joints of one name", "JOINT Left Hand", "JOINT Hips", 18, "Hips"),
    Broken("no brace", "Head\n    {", "Head\n", 12, "{"),
    Broken("a brace too many", "MOTION", "}\nMOTION", 29, "}"),
    Broken("a word that nobody knows", "  JOINT Chest", "  JOIN Chest", 6, "JOIN"),
    Broken("no offset", "    OFFSET 0 10 0\n", "", 26, "OFFSET"),
    Broken("an end site without an offset", "OFFSET 2 0 0", "", 25, "OFFSET"),
    Broken("an offset twice", "OFFSET 0 10 0", "OFFSET 0 10 0\nOFFSET 0 10 0", 9, "OFFSET"),
    Broken("an offset of two", "OFFSET 0 10 0", "OFFSET 0 10", 9, "OFFSET"),
    Broken("an offset of four", "OFFSET 0 10 0", "OFFSET 0 10 0 0", 8, "0"),
    Broken("an offset that is no number", "0 10 0", "0 1O 0", 8, "OFFSET"),
    Broken("an offset that is not finite", "0 10 0", "0 nan 0", 8, "OFFSET"),
    Broken("a channel in an end site", "OFFSET 2 0 0", "OFFSET 2 0 0 CHANNELS 0", 24, "CHANNELS"),
    Broken("fewer channels than said", "CHANNELS 4", "CHANNELS 5", 22, "CHANNELS"),
    Broken("more channels than said", "CHANNELS 4", "CHANNELS 3", 21, "Yrotation"),
    Broken("a channel that nobody knows", "Zrotation Xrotation Yrotation\n  JOINT",
           "Zrotation Wrotation Yrotation\n  JOINT", 5, "CHANNELS"),
    Broken("seven channels", "CHANNELS 4", "CHANNELS 7", 21, "CHANNELS"),
    Broken("channels below zero", "CHANNELS 4", "CHANNELS -4", 21, "CHANNELS"),
    Broken("channels twice", "CHANNELS 4", "CHANNELS 0\nCHANNELS 4", 22, "CHANNELS"),
    {"channels after a joint",
     "HIERARCHY\nROOT a { OFFSET 0 0 0\nJOINT b { OFFSET 0 0 0 }\nCHANNELS 1 Xrotation", 4,
     "CHANNELS"},
    {"no channel", "HIERARCHY\nROOT a { OFFSET 0 0 0 }\nMOTION", 3, "CHANNELS"},
    {"joints 10,000 deep", Nested(10000), 258, "j256"},
    Broken("no count of frames", kFrames, "", 31, "Frames"),
    Broken("no frame", kFrames, "Frames: 0", 30, "Frames"),
    Broken("frames below zero", kFrames, "Frames: -2", 30, "Frames"),
    Broken("half a frame", kFrames, "Frames: 1.5", 30, "Frames"),
    Broken("a count without digits", kFrames, "Frames:", 30, "Frames"),
    Broken("fewer frames than there are", kFrames, "Frames: 1", 33, "Frames"),
    Broken("more frames than there are", kFrames, "Frames: 3", 33, "Frames"),
    Broken("10^15 frames", kFrames, "Frames: 1000000000000000", 33, "Frames"),
    Broken("10^30 frames", kFrames, "Frames: 1" + std::string(30, '0'), 30, "Frames"),
    Broken("no frame time", kTime, "", 32, "Frame Time"),
    Broken("a frame time of zero", kTime, "Frame Time: 0", 31, "Frame Time"),
    Broken("a frame time below zero", kTime, "Frame Time: -0.025", 31, "Frame Time"),
    Broken("a frame time that is no number", kTime, "Frame Time: fast", 31, "Frame Time"),
    Broken("a frame time of two numbers", kTime, "Frame Time: 0.1 0.2", 31, "Frame Time"),
    Broken("a frame time that is not finite", kTime, "Frame Time: inf", 31, "Frame Time"),
    Broken("a frame time with no end of a rate", kTime, "Frame Time: 1e-320", 31, "Frame Time"),
    Broken("a value that is NaN", "-5 30", "NaN 30", 32, "Hips Zposition"),
    Broken("a value that is infinite", "-5 30", "-inf 30", 32, "Hips Zposition"),
    Broken("a value that no double holds", "-5 30", "1e999 30", 32, "Hips Zposition"),
    Broken("a value that no motion holds", "-5 30", "1e10 30", 32, "Hips Zposition"),
    Broken("a NaN as old Windows writes it", "-5 30", "-1.#IND 30", 32, "Hips Zposition"),
    Broken("a decimal comma", "-5 30", "-5,0 30", 32, "Hips Zposition"),
    Broken("a value too few", "-0.5 -25", "-0.5", 32, "Left Hand Yrotation"),
    Broken("a value too many", "-0.5 -25", "-0.5 -25 8", 32, "8"),
};

TEST(BvhFaults, AreToldWithLineAndKey) {
  const deixis::test::TemporaryFolder folder;
  const std::string file = (folder.path() / "a.bvh").string();
  for (const FaultCase& fault : kFaults) {
    ExpectFault(fault, file,
                [&](const std::string& text) { ReadBvh(folder.Write("a.bvh", text)); });
  }
}

TEST(BvhFaults, AreToldOfWhatIsNoFile) {
  const deixis::test::TemporaryFolder folder;
  for (const std::filesystem::path& path :
       {folder.path(), folder.path() / "none.bvh", folder.Write("empty.bvh", "")}) {
    try {
      ReadBvh(path);
      ADD_FAILURE() << path;
    } catch (const MotionFileError& error) {
      EXPECT_THAT(error.what(), testing::StartsWith(path.string() + ": is ")) << path;
    }
  }
}

}  // namespace
}  // namespace deixis::motion
