#include "common/motion/amc.h"

#include <algorithm>
#include <map>

#include "common/motion/frame_table.h"

namespace deixis::motion {
namespace {

using std::string_view;

class AmcReader {
 public:
  AmcReader(const Asf& asf, const std::filesystem::path& path)
      : asf_(asf),
        text_(path),
        radians_per_unit_(asf.radians_per_unit),
        table_(asf.skeleton.ChannelCount()),
        row_(static_cast<std::size_t>(asf.skeleton.ChannelCount())),
        is_given_(asf.skeleton.joints.size()) {
    for (std::size_t i = 0; i < asf.skeleton.joints.size(); ++i) {
      joints_by_name_.emplace(asf.skeleton.joints[i].name, i);
    }
  }

  FrameMatrix Read() {
    while (!text_.Peek().empty() && text_.Peek().front() == ':') ReadDirective();
    columns_ = ColumnsOf(asf_.skeleton, {asf_.metres_per_unit, radians_per_unit_});
    if (text_.Peek().empty()) text_.Fail("frame", "is missing: the file ends here");
    frame_ = text_.ToWholeNumber(text_.Take(), "frame number");
    ReadFrame();
    while (!text_.Peek().empty()) {
      TakeFrameNumber();
      ReadFrame();
    }
    return table_.Matrix();
  }

 private:
  void ReadDirective() {
    const string_view directive = text_.Take();
    if (IsWord(directive, ":DEGREES")) {
      radians_per_unit_ = kRadiansPerDegree;
    } else if (IsWord(directive, ":RADIANS")) {
      radians_per_unit_ = 1.0;
    } else if (!IsWord(directive, ":FULLY-SPECIFIED")) {
      text_.Fail(directive, "is not known; known are: :FULLY-SPECIFIED, :DEGREES, :RADIANS");
    }
  }

  void TakeFrameNumber() {
    const std::int64_t number = text_.ToWholeNumber(text_.Take(), "frame number");
    // Compared so that no number overflows.
    if (number - 1 != frame_) {
      text_.Fail("frame number",
                 "is " + std::to_string(number) + " after " + std::to_string(frame_));
    }
    frame_ = number;
  }

  void ReadFrame() {
    const std::size_t line = text_.line();
    if (text_.LineHasMore()) text_.Fail("frame number", "must stand alone in its line");
    std::fill(is_given_.begin(), is_given_.end(), false);
    while (NextIsBone()) ReadBone();
    for (std::size_t i = 0; i < is_given_.size(); ++i) {
      const Joint& joint = asf_.skeleton.joints[i];
      if (!is_given_[i] && !joint.channels.empty()) {
        text_.FailAt(line, joint.name, "is missing in frame " + std::to_string(frame_));
      }
    }
    table_.Add(row_);
  }

  bool NextIsBone() {
    const string_view word = text_.Peek();
    return !word.empty() && (joints_by_name_.count(word) != 0 || !IsNumber(word));
  }

  static bool IsNumber(string_view word) {
    return word.find_first_not_of("0123456789") == string_view::npos;
  }

  void ReadBone() {
    const string_view name = text_.Take();
    const auto found = joints_by_name_.find(name);
    if (found == joints_by_name_.end()) text_.Fail(name, "is no bone of the skeleton");
    if (is_given_[found->second]) {
      text_.Fail(name, "is given twice in frame " + std::to_string(frame_));
    }
    is_given_[found->second] = true;
    const auto& columns = asf_.columns[found->second];
    for (const Eigen::Index index : columns) {
      const Column& column = columns_[static_cast<std::size_t>(index)];
      if (!text_.LineHasMore()) FailCount(name, columns.size());
      row_[static_cast<std::size_t>(index)] = column.factor * text_.TakeNumber(column.name);
    }
    if (text_.LineHasMore()) FailCount(name, columns.size());
  }

  [[noreturn]] void FailCount(string_view name, std::size_t count) const {
    text_.Fail(name, "must have " + Counted(static_cast<std::int64_t>(count), "value") +
                         " in its line, as its skeleton says");
  }

  const Asf& asf_;
  MotionText text_;
  double radians_per_unit_;
  std::map<std::string, std::size_t, std::less<>> joints_by_name_;
  std::vector<Column> columns_;
  FrameTable table_;
  std::vector<double> row_;
  std::vector<bool> is_given_;
  std::int64_t frame_ = 0;
};

}  // namespace

Clip ReadAmc(const Asf& asf, const std::filesystem::path& path, double frame_rate_hz) {
  RequireRate(frame_rate_hz, path);
  return {asf.skeleton, frame_rate_hz, AmcReader(asf, path).Read()};
}

}  // namespace deixis::motion
