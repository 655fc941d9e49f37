#include <gtest/gtest.h>

#include "common/motion/amc.h"
#include "common/motion/asf.h"
#include "test/common/motion/fault_cases.h"
#include "test/common/motion/motion_samples.h"
#include "test/support/temporary_folder.h"

namespace deixis::motion {
namespace {

FaultCase Asf(const std::string& what, const std::string& from, const std::string& to, int line,
              const std::string& key) {
  return {what, Replaced(kAsf, from, to), line, key};
}

FaultCase Amc(const std::string& what, const std::string& from, const std::string& to, int line,
              const std::string& key) {
  return {what, Replaced(kAmc, from, to), line, key};
}

std::string CutBefore(const std::string& text, const std::string& word) {
  return text.substr(0, text.find(word));
}

/// A chain of bones; line 8 and on hold one each.
std::string Chain(int bones) {
  std::string text = ":units\nlength 1\nangle deg\n:root\norder RX\naxis XYZ\n:bonedata\n";
  std::string hierarchy = ":hierarchy\nbegin\nroot b0\n";
  for (int i = 0; i < bones; ++i) {
    const std::string name = "b" + std::to_string(i);
    text += "begin name " + name + "\ndirection 1 0 0\nlength 1\naxis 0 0 0 XYZ\nend\n";
    if (i > 0) hierarchy += "b" + std::to_string(i - 1) + " " + name + "\n";
  }
  return text + hierarchy + "end\n";
}

const std::string kLength = "length 0.5";
const std::string kUpperAxis = "axis 20 -30 40 XYZ";

const std::vector<FaultCase> kAsfFaults = {
    {"blank text", "\n\n", 2, ":units"},
    {"another format", "HIERARCHY\n", 1, "HIERARCHY"},
    {"a binary file", Replaced(kAsf, "upper", "up\x01per"), 26, "text"},
    {"a file cut in a bone", CutBefore(kAsf, "length 4"), 28, "end"},
    {"a file cut before its hierarchy", CutBefore(kAsf, ":hierarchy"), 50, ":hierarchy"},
    {"a file cut in its hierarchy", CutBefore(kAsf, "lower hand"), 55, "end"},
    Asf("a section that nobody knows", ":documentation", ":foo", 8, ":foo"),
    Asf("a section twice", ":documentation", ":units", 8, ":units"),
    Asf("no unit of length", kLength, "", 8, "length"),
    Asf("no unit of angles", "angle deg", "", 8, "angle"),
    Asf("a unit of length of zero", kLength, "length 0", 6, "length"),
    Asf("a negative unit of length", kLength, "length -1", 6, "length"),
    Asf("a unit of length that is not finite", kLength, "length inf", 6, "length"),
    Asf("a unit of angles that nobody knows", "angle deg", "angle grad", 7, "angle"),
    Asf("a unit that nobody knows", "mass 1.0", "time 1.0", 5, "time"),
    Asf("a root without order", "order TZ TX TY RX RZ RY", "", 16, "order"),
    Asf("a root without axis", "  axis XYZ\n", "", 15, "axis"),
    Asf("a root's order that nobody knows", "TZ TX", "TW TX", 12, "order"),
    Asf("a root's channel twice", "TZ TX", "TX TX", 12, "order"),
    Asf("a root's axis without order", "axis XYZ", "axis XXZ", 13, "axis"),
    Asf("a root's word that nobody knows", "position", "place", 14, "place"),
    Asf("a root's position of two", "1 2 3", "1 2", 15, "position"),
    Asf("a bone without begin", "  begin\n    id 1", "    id 1", 17, "begin"),
    Asf("a bone without a name", "    name upper\n", "", 24, "name"),
    Asf("an empty name", "name upper", "name", 26, "name"),
    Asf("a bone without a direction", "    direction 1 0 0\n", "", 24, "direction"),
    Asf("a bone without a length", "    length 4\n", "", 24, "length"),
    Asf("a bone without an axis", "    " + kUpperAxis + "\n", "", 24, "axis"),
    Asf("two bones of one name", "name upper", "name hand", 26, "hand"),
    Asf("a bone with the root's name", "name upper", "name root", 26, "root"),
    Asf("a word twice", kUpperAxis, kUpperAxis + "\n" + kUpperAxis, 30, "axis"),
    Asf("a word that nobody knows", kUpperAxis, "axes 20 -30 40 XYZ", 29, "axes"),
    Asf("a word too many", kUpperAxis, kUpperAxis + " 7", 29, "axis"),
    Asf("an axis without order", kUpperAxis, "axis 20 -30 40", 30, "axis"),
    Asf("an axis of other letters", kUpperAxis, "axis 20 -30 40 XYW", 29, "axis"),
    Asf("an axis that is NaN", kUpperAxis, "axis 20 nan 40 XYZ", 29, "axis"),
    Asf("a length that is negative", "length 4", "length -4", 28, "length"),
    Asf("a length that no double holds", "length 4", "length 1e999", 28, "length"),
    Asf("a NaN as old Windows writes it", "length 4", "length -1.#IND", 28, "length"),
    Asf("a direction that is zero", "direction 1 0 0", "direction 0 0 0", 26, "upper"),
    Asf("a direction that is long", "direction 1 0 0", "direction 1 1 0", 26, "upper"),
    Asf("a dof that nobody knows", "dof rx ry rz", "dof rx ry rw", 30, "dof"),
    Asf("a dof twice", "dof rx ry rz", "dof rx ry rx", 30, "dof"),
    Asf("a bone that moves along", "dof rx ry rz", "dof rx ry tz", 30, "dof"),
    Asf("a bone that stretches", "dof rx ry rz", "dof rx ry l", 30, "dof"),
    Asf("fewer limits than dof", "           (-inf inf)\n", "", 33, "limits"),
    Asf("more limits than dof", "(-inf inf)", "(-inf inf)\n(0 1)", 34, "(0"),
    Asf("limits without brackets", "(-160.0 20.0)", "-160.0 20.0", 31, "limits"),
    Asf("limits upside down", "(-160.0 20.0)", "(20.0 -160.0)", 31, "limits"),
    Asf("limits of three", "(-160.0 20.0)", "(-160.0 0 20.0)", 31, "limits"),
    Asf("limits that are no numbers", "(-160.0 20.0)", "(-160.0 wide)", 31, "limits"),
    Asf("a hierarchy without begin", "hierarchy\n  begin", "hierarchy", 52, "begin"),
    Asf("an unknown parent", "upper lower", "uper lower", 54, "uper"),
    Asf("an unknown child", "upper lower", "upper lowr", 54, "lowr"),
    Asf("a bone below two", "leg upper", "leg upper lower", 54, "lower"),
    Asf("bones below no root", "root leg upper", "root leg", 19, "hand"),
    Asf("a root below a bone", "lower hand", "lower hand root", 55, "root"),
    Asf("a loose bone", "root leg", "root", 46, "leg"),
    Asf("a cycle", "root leg upper", "root leg\nhand upper", 19, "hand"),
    {"bones 10,000 deep", Chain(10000), 8 + 5 * 255, "b255"},
};

const std::vector<FaultCase> kAmcFaults = {
    {"a blank file", "\n\n", 2, "frame"},
    {"another format", "HIERARCHY\n", 1, "frame number"},
    {"a binary file", Replaced(kAmc, "upper", "up\x01per"), 6, "text"},
    {"a file without frames", ":FULLY-SPECIFIED\n:DEGREES\n", 2, "frame"},
    {"a file cut before a bone", CutBefore(kAmc, "root 0"), 8, "root"},
    {"a file cut in a line", CutBefore(kAmc, " 0\nroot"), 10, "upper"},
    {"a file that ends with a frame's number", kAmc + "3\n", 12, "root"},
    Amc("a directive that nobody knows", ":DEGREES", ":GRADS", 3, ":GRADS"),
    Amc("a directive in a frame", "2\n", ":RADIANS\n2\n", 8, ":RADIANS"),
    Amc("no number of a frame", "1\nroot", "root", 4, "frame number"),
    Amc("no number of a later frame", "2\n", "", 8, "lower"),
    Amc("a negative number of a frame", "1\nroot", "-1\nroot", 8, "frame number"),
    Amc("a frame of no int's number", "1\nroot", std::string(30, '9') + "\nroot", 4,
        "frame number"),
    Amc("a frame left out", "2\n", "3\n", 8, "frame number"),
    Amc("a frame twice", "2\n", "1\n", 8, "frame number"),
    Amc("two numbers of a frame", "2\n", "2 3\n", 8, "frame number"),
    Amc("an unknown bone", "upper 15", "uper 15", 6, "uper"),
    Amc("a bone twice", "lower 45 -55\n", "lower 45 -55\nupper 0 0 0\n", 8, "upper"),
    Amc("a bone that is missing", "upper 15 -25 35\n", "", 4, "upper"),
    Amc("a value too few", "15 -25 35", "15 -25", 6, "upper"),
    Amc("a value too many", "15 -25 35", "15 -25 35 45", 6, "upper"),
    Amc("values of a bone that does not turn", "2\n", "leg 1\n2\n", 8, "leg"),
    Amc("a value that is NaN", "15 -25 35", "15 nan 35", 6, "upper Yrotation"),
    Amc("a value that is infinite", "15 -25 35", "15 -inf 35", 6, "upper Yrotation"),
    Amc("a value that no double holds", "15 -25 35", "15 1e999 35", 6, "upper Yrotation"),
    Amc("a NaN as old Windows writes it", "15 -25 35", "15 -1.#IND 35", 6, "upper Yrotation"),
    Amc("a value that is no number", "15 -25 35", "15 x 35", 6, "upper Yrotation"),
};

TEST(AsfFaults, AreToldWithLineAndKey) {
  const deixis::test::TemporaryFolder folder;
  const std::string file = (folder.path() / "a.asf").string();
  for (const FaultCase& fault : kAsfFaults) {
    ExpectFault(fault, file,
                [&](const std::string& text) { ReadAsf(folder.Write("a.asf", text)); });
  }
}

TEST(AmcFaults, AreToldWithLineAndKey) {
  const deixis::test::TemporaryFolder folder;
  const auto asf = ReadAsf(folder.Write("a.asf", kAsf));
  const std::string file = (folder.path() / "a.amc").string();
  for (const FaultCase& fault : kAmcFaults) {
    ExpectFault(fault, file,
                [&](const std::string& text) { ReadAmc(asf, folder.Write("a.amc", text), 120.0); });
  }
}

TEST(AsfFaults, AreToldOfWhatIsNoFile) {
  const deixis::test::TemporaryFolder folder;
  const auto asf = ReadAsf(folder.Write("a.asf", kAsf));
  for (const std::filesystem::path& path :
       {folder.path(), folder.path() / "none", folder.Write("empty", "")}) {
    EXPECT_THROW(ReadAsf(path), MotionFileError) << path;
    EXPECT_THROW(ReadAmc(asf, path, 120.0), MotionFileError) << path;
  }
}

}  // namespace
}  // namespace deixis::motion
