#include "common/motion/asf_text.h"

#include <algorithm>
#include <charconv>
#include <map>
#include <set>

#include "common/motion/frame_table.h"
#include "common/motion/motion_text.h"

namespace deixis::motion {
namespace {

using std::string_view;

constexpr double kMetresPerInch = 0.0254;
constexpr int kRoot = -1;

/// "XYZ" in any order.
AxisOrder TakeAxisOrder(MotionText& text, string_view key) {
  const string_view word = text.Take();
  AxisOrder axes{};
  std::set<int> seen;
  for (std::size_t i = 0; i < std::min(word.size(), axes.size()); ++i) {
    for (int axis = 0; axis < 3; ++axis) {
      if (IsWord(word.substr(i, 1), string_view("XYZ").substr(static_cast<std::size_t>(axis), 1))) {
        axes[i] = axis;
        seen.insert(axis);
      }
    }
  }
  if (word.size() != 3 || seen.size() != 3) {
    text.Fail(key, "must end in an order of axes such as XYZ");
  }
  return axes;
}

/// The words that are left in the line, "TX" or "rx", each once.
std::vector<ChannelKind> TakeChannels(MotionText& text, string_view key) {
  constexpr std::array<string_view, 6> kNames = {"tx", "ty", "tz", "rx", "ry", "rz"};
  std::vector<ChannelKind> kinds;
  while (text.LineHasMore()) {
    const string_view word = text.Take();
    const auto* name = std::find_if(kNames.begin(), kNames.end(),
                                    [word](string_view known) { return IsWord(word, known); });
    if (name == kNames.end()) text.Fail(key, "has a word that is not one of tx ty tz rx ry rz");
    const auto kind = static_cast<ChannelKind>(name - kNames.begin());
    if (std::count(kinds.begin(), kinds.end(), kind) != 0) text.Fail(key, "names a channel twice");
    kinds.push_back(kind);
  }
  return kinds;
}

Eigen::Vector3d TakeVector(MotionText& text, string_view key) {
  Eigen::Vector3d vector;
  for (double& value : vector) value = text.TakeNumber(key);
  return vector;
}

/// A bone from `begin` to `end`.
class BoneReader {
 public:
  explicit BoneReader(MotionText& text) : text_(text) {}

  AsfBone Read() {
    text_.Expect("begin");
    begin_line_ = text_.line();
    while (!IsWord(text_.Peek(), "end")) ReadEntry(text_.Take());
    text_.Expect("end");
    for (const char* key : {"name", "direction", "length", "axis"}) {
      if (seen_.count(key) == 0) text_.FailAt(begin_line_, key, "of this bone is missing");
    }
    RequireDirection();
    return std::move(bone_);
  }

 private:
  void ReadEntry(string_view key) {
    if (key.empty()) text_.Fail("end", "of " + Name() + " is missing: the file ends here");
    std::string name(key);
    std::transform(name.begin(), name.end(), name.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    if (!seen_.insert(name).second) text_.Fail(name, "of " + Name() + " is given twice");
    ReadValue(name);
    if (text_.LineHasMore()) text_.Fail(name, "of " + Name() + " has too many words");
  }

  void ReadValue(const std::string& key) {
    if (key == "name") {
      bone_.line = text_.line();
      bone_.name = text_.LineHasMore() ? text_.Take() : "";
      if (bone_.name.empty()) text_.Fail("name", "of a bone is missing");
    } else if (key == "direction") {
      bone_.direction = TakeVector(text_, key);
    } else if (key == "length") {
      bone_.length = text_.TakeNumber(key);
      if (bone_.length < 0.0) text_.Fail(key, "of " + Name() + " must not be negative");
    } else if (key == "axis") {
      bone_.axis = TakeVector(text_, key);
      bone_.axes = TakeAxisOrder(text_, key);
    } else if (key == "dof") {
      ReadDof();
    } else if (key == "limits") {
      for (std::size_t i = 0; i < bone_.dof.size(); ++i) CheckLimits();
    } else if (key == "id" || key == "bodymass" || key == "cofmass") {
      text_.TakeNumber(key);  // Nobody refers to it.
    } else {
      text_.Fail(key, "is not known in " + Name() +
                          "; known are: id, name, direction, length, axis, dof, limits, bodymass, "
                          "cofmass, end");
    }
  }

  void ReadDof() {
    bone_.dof = TakeChannels(text_, "dof");
    if (std::any_of(bone_.dof.begin(), bone_.dof.end(), IsTranslation)) {
      text_.Fail("dof", "of " + Name() + " moves the bone; only rx, ry and rz are read");
    }
  }

  /// "(-10.0 170.0)". They are not kept: a recording has what it has.
  void CheckLimits() {
    std::string pair;
    do {
      const string_view word = text_.LineHasMore() || pair.empty() ? text_.Take() : "";
      if (word.empty())
        text_.Fail("limits", "of " + Name() + " must be a pair per dof: (low high)");
      pair += std::string(word) + " ";
    } while (pair.find(')') == std::string::npos);
    const bool has_begin = pair.front() == '(';
    std::replace_if(
        pair.begin(), pair.end(), [](char c) { return c == '(' || c == ')' || c == ','; }, ' ');
    std::vector<double> bounds;
    const char* at = pair.data();
    const char* const end = at + pair.size();
    while (at = std::find_if(at, end, [](char c) { return c != ' '; }), at != end) {
      // Infinite bounds are limits, too.
      const auto [stop, error] = std::from_chars(at, end, bounds.emplace_back());
      if (error != std::errc() || *stop != ' ') break;
      at = stop;
    }
    if (!has_begin || at != end || bounds.size() != 2 || !(bounds[0] <= bounds[1])) {
      text_.Fail("limits", "of " + Name() + " must be a pair per dof: (low high)");
    }
  }

  void RequireDirection() const {
    constexpr double kRounding = 0.01;  // Of files with two digits.
    const double norm = bone_.direction.norm();
    if (bone_.length > 0.0 && !(std::abs(norm - 1.0) < kRounding)) {
      text_.FailAt(bone_.line, bone_.name, "has a direction that is not of length 1");
    }
  }

  std::string Name() const { return bone_.name.empty() ? "a bone" : "'" + bone_.name + "'"; }

  MotionText& text_;
  std::size_t begin_line_ = 0;
  AsfBone bone_;
  std::set<std::string> seen_;
};

class AsfReader {
 public:
  explicit AsfReader(const std::filesystem::path& path) : text_(path) {}

  AsfText Read() {
    while (!text_.Peek().empty()) ReadSection(std::string(text_.Take()));
    for (const char* section : {":units", ":root", ":bonedata", ":hierarchy"}) {
      if (sections_.count(section) == 0) text_.Fail(section, "is missing: the file ends here");
    }
    RequireAllBelowRoot();
    return std::move(asf_);
  }

 private:
  void ReadSection(const std::string& name) {
    for (const auto& [section, read] : Sections()) {
      if (!IsWord(name, section)) continue;
      if (!sections_.insert(section).second) text_.Fail(name, "is given twice");
      return (this->*read)();
    }
    text_.Fail(name, "is no section of an ASF file, which begin with ':'");
  }

  using Section = void (AsfReader::*)();
  static const std::map<std::string, Section>& Sections() {
    static const std::map<std::string, Section> kSections = {
        {":units", &AsfReader::ReadUnits},        {":root", &AsfReader::ReadRoot},
        {":bonedata", &AsfReader::ReadBones},     {":hierarchy", &AsfReader::ReadHierarchy},
        {":version", &AsfReader::PassOver},       {":name", &AsfReader::PassOver},
        {":documentation", &AsfReader::PassOver}, {":skin", &AsfReader::PassOver},
    };
    return kSections;
  }

  bool SectionHasMore() { return !text_.Peek().empty() && text_.Peek().front() != ':'; }

  void PassOver() {
    text_.TakeLine();
    while (SectionHasMore()) text_.TakeLine();
  }

  void ReadUnits() {
    while (SectionHasMore()) {
      const string_view key = text_.Take();
      if (IsWord(key, "length")) {
        ReadLengthUnit();
      } else if (IsWord(key, "angle")) {
        ReadAngleUnit();
      } else if (IsWord(key, "mass")) {
        text_.TakeNumber(key);
      } else {
        text_.Fail(key, "is not known; known are: mass, length, angle");
      }
    }
    if (asf_.metres_per_unit <= 0.0) text_.Fail("length", "is missing in :units");
    if (asf_.radians_per_unit <= 0.0) text_.Fail("angle", "is missing in :units");
  }

  void ReadLengthUnit() {
    asf_.metres_per_unit = kMetresPerInch / text_.TakeNumber("length");
    // The negation refuses what a unit of zero gives, too.
    if (!(asf_.metres_per_unit >= 1e-6 && asf_.metres_per_unit <= 1e6)) {
      text_.Fail("length", "must be units per inch, above zero and of a size that people have");
    }
  }

  void ReadAngleUnit() {
    const string_view unit = text_.Take();
    if (!IsWord(unit, "deg") && !IsWord(unit, "rad")) text_.Fail("angle", "must be deg or rad");
    asf_.radians_per_unit = IsWord(unit, "deg") ? kRadiansPerDegree : 1.0;
  }

  void ReadRoot() {
    bool has_axis = false;
    while (SectionHasMore()) {
      const string_view key = text_.Take();
      if (IsWord(key, "order")) {
        asf_.root.order = TakeChannels(text_, key);
      } else if (IsWord(key, "axis")) {
        asf_.root.axes = TakeAxisOrder(text_, key);
        has_axis = true;
      } else if (IsWord(key, "position")) {
        asf_.root.position = TakeVector(text_, key);
      } else if (IsWord(key, "orientation")) {
        asf_.root.orientation = TakeVector(text_, key);
      } else {
        text_.Fail(key, "is not known; known are: order, axis, position, orientation");
      }
    }
    if (asf_.root.order.empty()) text_.Fail("order", "is missing in :root");
    if (!has_axis) text_.Fail("axis", "is missing in :root");
  }

  void ReadBones() {
    bones_by_name_["root"] = kRoot;
    while (SectionHasMore()) {
      AsfBone bone = BoneReader(text_).Read();
      const int index = static_cast<int>(asf_.bones.size());
      if (!bones_by_name_.emplace(bone.name, index).second) {
        text_.FailAt(bone.line, bone.name, "is the name of two bones");
      }
      asf_.bones.push_back(std::move(bone));
    }
    if (asf_.bones.empty()) text_.Fail(":bonedata", "has no bones");
  }

  void ReadHierarchy() {
    if (sections_.count(":bonedata") == 0) text_.Fail(":hierarchy", "must follow :bonedata");
    text_.Expect("begin");
    while (!IsWord(text_.Peek(), "end")) {
      if (text_.Peek().empty()) text_.Fail("end", "of :hierarchy is missing: the file ends here");
      const int parent = TakeBone();
      while (text_.LineHasMore()) AddChild(parent, TakeBone());
    }
    text_.Expect("end");
  }

  int TakeBone() {
    const string_view name = text_.Take();
    const auto found = bones_by_name_.find(std::string(name));
    if (found == bones_by_name_.end()) text_.Fail(name, "is no bone of :bonedata");
    return found->second;
  }

  void AddChild(int parent, int child) {
    if (child == kRoot) text_.Fail("root", "cannot hang below a bone");
    AsfBone& bone = asf_.bones[static_cast<std::size_t>(child)];
    if (!placed_.insert(child).second) text_.Fail(bone.name, "hangs below two bones");
    (parent == kRoot ? asf_.root_children : asf_.bones[static_cast<std::size_t>(parent)].children)
        .push_back(child);
  }

  /// As each bone hangs below one, those that the root does not lead to are loose or a cycle.
  void RequireAllBelowRoot() const {
    std::vector<bool> is_reached(asf_.bones.size(), false);
    std::vector<int> level = asf_.root_children;
    for (int depth = 1; !level.empty(); ++depth) {
      std::vector<int> next;
      for (const int index : level) {
        const AsfBone& bone = asf_.bones[static_cast<std::size_t>(index)];
        if (depth >= kDeepestNesting) {
          text_.FailAt(bone.line, bone.name, "lies more than 256 levels deep");
        }
        is_reached[static_cast<std::size_t>(index)] = true;
        next.insert(next.end(), bone.children.begin(), bone.children.end());
      }
      level = std::move(next);
    }
    const auto loose = std::find(is_reached.begin(), is_reached.end(), false);
    if (loose == is_reached.end()) return;
    const AsfBone& bone = asf_.bones[static_cast<std::size_t>(loose - is_reached.begin())];
    text_.FailAt(bone.line, bone.name, "does not hang below the root in :hierarchy");
  }

  MotionText text_;
  AsfText asf_;
  std::set<std::string> sections_;
  std::map<std::string, int> bones_by_name_;
  std::set<int> placed_;
};

}  // namespace

AsfText ReadAsfText(const std::filesystem::path& path) { return AsfReader(path).Read(); }

}  // namespace deixis::motion
