#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <set>

#include "common/motion/bvh.h"
#include "common/motion/frame_table.h"

namespace deixis::motion {
namespace {

using std::string_view;

constexpr double kLargestRateHz = 1e6;
constexpr int kKinds = 6;  // Of channels.

/// An open '{'.
struct Block {
  int joint = 0;
  bool is_end_site = false;
  bool has_offset = false;
  bool has_channels = false;
  bool has_children = false;
};

/// The part of a file before MOTION. Goes by a list of open blocks: files may nest without end.
class HierarchyReader {
 public:
  HierarchyReader(MotionText& text, double metres_per_unit)
      : text_(text), metres_per_unit_(metres_per_unit) {}

  Skeleton Read() {
    text_.Expect("HIERARCHY");
    while (ReadWord(text_.Take())) {
    }
    if (skeleton_.joints.empty()) text_.Fail("ROOT", "is missing: the file has no joints");
    if (skeleton_.ChannelCount() == 0) text_.Fail("CHANNELS", "are none in this file");
    return std::move(skeleton_);
  }

 private:
  bool ReadWord(string_view word) {
    if (word.empty()) text_.Fail("MOTION", "is missing: the file ends here");
    if (open_.empty()) {
      if (IsWord(word, "MOTION")) return false;
      if (!IsWord(word, "ROOT")) text_.Fail(word, "stands where ROOT or MOTION must stand");
      BeginJoint(-1);
    } else if (word == "}") {
      End();
    } else {
      ReadInBlock(word, open_.back());
    }
    return true;
  }

  void ReadInBlock(string_view word, Block& block) {
    if (IsWord(word, "OFFSET")) {
      ReadOffset(block);
    } else if (block.is_end_site) {
      text_.Fail(word, "stands in the End Site of " + Name(block) + ", which has an OFFSET only");
    } else if (IsWord(word, "CHANNELS")) {
      ReadChannels(block);
    } else if (IsWord(word, "JOINT")) {
      block.has_children = true;
      BeginJoint(block.joint);
    } else if (IsWord(word, "End")) {
      block.has_children = true;
      BeginEndSite(block.joint);
    } else {
      text_.Fail(word, "is not known in " + Name(block) +
                           "; known are: OFFSET, CHANNELS, JOINT, End Site, }");
    }
  }

  void BeginJoint(int parent) {
    Joint joint;
    joint.parent = parent;
    joint.name = TakeName();
    if (joint.name.empty()) text_.Fail(parent < 0 ? "ROOT" : "JOINT", "has no name");
    if (!names_.insert(joint.name).second) text_.Fail(joint.name, "is the name of two joints");
    if (open_.size() >= kDeepestNesting) {
      text_.Fail(joint.name, "lies more than " + std::to_string(kDeepestNesting) + " levels deep");
    }
    skeleton_.joints.push_back(std::move(joint));
    open_.push_back({static_cast<int>(skeleton_.joints.size()) - 1});
    text_.Expect("{");
  }

  void BeginEndSite(int joint) {
    text_.Expect("Site");
    TakeName();  // Some writers give one; nobody refers to it.
    open_.push_back({joint, true});
    text_.Expect("{");
  }

  /// Names may hold blanks.
  std::string TakeName() {
    std::string name;
    while (text_.LineHasMore() && text_.Peek() != "{") {
      name += (name.empty() ? "" : " ") + std::string(text_.Take());
    }
    return name;
  }

  void ReadOffset(Block& block) {
    if (block.has_offset) text_.Fail("OFFSET", "of " + Name(block) + " is given twice");
    block.has_offset = true;
    Eigen::Vector3d offset_m;
    for (double& value : offset_m) value = metres_per_unit_ * text_.TakeNumber("OFFSET");
    Joint& joint = JointOf(block);
    if (block.is_end_site) {
      joint.end_sites_m.push_back(offset_m);
    } else {
      joint.offset_m = offset_m;
    }
  }

  void ReadChannels(Block& block) {
    if (block.has_channels) text_.Fail("CHANNELS", "of " + Name(block) + " are given twice");
    // Else their columns would not be in the order of the joints.
    if (block.has_children) {
      text_.Fail("CHANNELS", "of " + Name(block) + " must stand before the joints below it");
    }
    block.has_channels = true;
    const std::int64_t count = text_.ToWholeNumber(text_.Take(), "CHANNELS");
    if (count < 0 || count > kKinds) text_.Fail("CHANNELS", "must be from 0 to 6 per joint");
    for (std::int64_t i = 0; i < count; ++i) JointOf(block).channels.push_back(TakeChannel(block));
  }

  ChannelKind TakeChannel(const Block& block) {
    const string_view word = text_.Take();
    for (int i = 0; i < kKinds; ++i) {
      if (IsWord(word, ChannelName(static_cast<ChannelKind>(i))))
        return static_cast<ChannelKind>(i);
    }
    text_.Fail("CHANNELS", "of " + Name(block) + " are fewer than it says, or one is not of " +
                               "Xposition, Yposition, Zposition, Xrotation, Yrotation, Zrotation");
  }

  void End() {
    const Block& block = open_.back();
    if (!block.has_offset) {
      text_.Fail("OFFSET", std::string("is missing in ") +
                               (block.is_end_site ? "the End Site of " : "") + Name(block));
    }
    open_.pop_back();
  }

  Joint& JointOf(const Block& block) {
    return skeleton_.joints[static_cast<std::size_t>(block.joint)];
  }
  std::string Name(const Block& block) { return "'" + JointOf(block).name + "'"; }

  MotionText& text_;
  double metres_per_unit_;
  Skeleton skeleton_;
  std::vector<Block> open_;
  std::set<std::string> names_;
};

/// The value of a line such as "Frame Time: 0.01", whose blanks vary.
string_view TakeSetting(MotionText& text, string_view key) {
  if (text.Peek().empty()) text.Fail(key, "is missing: the file ends here");
  const string_view line = text.TakeLine();
  const std::size_t colon = line.find(':');
  std::string name;
  for (const char c : line.substr(0, colon)) {
    const bool is_blank = std::isspace(static_cast<unsigned char>(c)) != 0;
    if (!is_blank) name += c;
    if (is_blank && !name.empty() && name.back() != ' ') name += ' ';
  }
  if (!name.empty() && name.back() == ' ') name.pop_back();
  if (colon == string_view::npos || !IsWord(name, key)) {
    text.Fail(key, "must stand here: '" + std::string(key) + ": ...'");
  }
  string_view value = line.substr(colon + 1);
  value.remove_prefix(std::min(value.find_first_not_of(" \t\f\v"), value.size()));
  return value;
}

std::int64_t TakeFrameCount(MotionText& text) {
  const std::int64_t frames = text.ToWholeNumber(TakeSetting(text, "Frames"), "Frames");
  if (frames < 1) text.Fail("Frames", "must be 1 or more");
  return frames;
}

double TakeFrameRate(MotionText& text) {
  const double time_s = text.ToNumber(TakeSetting(text, "Frame Time"), "Frame Time");
  if (!(time_s >= 1.0 / kLargestRateHz)) {
    text.Fail("Frame Time", "must be positive: seconds, a millionth or more");
  }
  return 1.0 / time_s;
}

void ReadFrame(MotionText& text, const std::vector<Column>& columns, FrameTable& table) {
  for (const Column& column : columns) {
    if (!text.LineHasMore()) {
      text.Fail(column.name, "has no value in this line: the skeleton has " +
                                 Counted(table.columns(), "channel"));
    }
    table.Add(column.factor * text.TakeNumber(column.name));
  }
  if (text.LineHasMore()) {
    text.Fail(text.Peek(),
              "is one value too many: the skeleton has " + Counted(table.columns(), "channel"));
  }
}

/// Takes no memory for frames that are not there, however many the file speaks of.
FrameMatrix ReadFrames(MotionText& text, const std::vector<Column>& columns, std::int64_t frames) {
  FrameTable table(static_cast<Eigen::Index>(columns.size()));
  for (std::int64_t i = 0; i < frames; ++i) {
    if (text.Peek().empty()) {
      text.Fail("Frames",
                "are " + std::to_string(frames) + ", but the file ends after " + std::to_string(i));
    }
    ReadFrame(text, columns, table);
  }
  if (!text.Peek().empty()) {
    text.Fail("Frames", "are " + std::to_string(frames) + ", but more lines follow");
  }
  return table.Matrix();
}

/// Some programs write a joint's place in its parent into its position channels, others only by how
/// much it differs from OFFSET. Those that come nearer to OFFSET than to zero, on the average, are
/// places: OFFSET is taken from them. Roots are left alone, whose OFFSET moves the whole body.
void TakeOffsetsFromPlaces(Clip& clip) {
  Eigen::Index column = 0;
  for (const Joint& joint : clip.skeleton.joints) {
    Eigen::Vector3d mean = Eigen::Vector3d::Zero();
    std::array<Eigen::Index, 3> columns{-1, -1, -1};
    for (const ChannelKind kind : joint.channels) {
      if (IsTranslation(kind)) {
        const auto axis = static_cast<std::size_t>(kind);
        columns[axis] = column;
        mean[static_cast<Eigen::Index>(axis)] = clip.frames.col(column).mean();
      }
      ++column;
    }
    const bool is_place = joint.parent >= 0 && (mean - joint.offset_m).norm() < mean.norm();
    if (!is_place) continue;
    for (std::size_t axis = 0; axis < columns.size(); ++axis) {
      if (columns[axis] >= 0) {
        clip.frames.col(columns[axis]).array() -= joint.offset_m[static_cast<Eigen::Index>(axis)];
      }
    }
  }
}

}  // namespace

Clip ReadBvh(const std::filesystem::path& path, const BvhOptions& options) {
  RequireUnit(options.metres_per_unit, path);
  MotionText text(path);
  Clip clip;
  clip.skeleton = HierarchyReader(text, options.metres_per_unit).Read();
  const std::int64_t frames = TakeFrameCount(text);
  clip.frame_rate_hz = TakeFrameRate(text);
  const Scales scales{options.metres_per_unit, kRadiansPerDegree};
  clip.frames = ReadFrames(text, ColumnsOf(clip.skeleton, scales), frames);
  TakeOffsetsFromPlaces(clip);
  return clip;
}

}  // namespace deixis::motion
