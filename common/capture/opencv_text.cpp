#include "common/capture/opencv_text.h"

#include <algorithm>
#include <cctype>

namespace deixis::capture {
namespace {

using std::string_view;

bool Holds(string_view text, string_view part) { return text.find(part) != string_view::npos; }

bool IsBlank(char c) { return c == ' ' || c == '\t'; }

/// Where in a line a closer is what it looks like. OpenCV takes texts of one line, a key ends in a
/// colon, a comment at the line's end.
class SureParts {
 public:
  explicit SureParts(string_view line)
      : first_end_(Holds(line, ":") ? 0 : std::min(line.find_first_of("\"'"), line.size())),
        second_begin_(line.find_last_of("\"':") + 1),  // Of none: 0.
        comment_(std::min({line.find('#'), line.find("//"), line.size()})) {}

  bool Has(std::size_t at) const {
    return at < comment_ && (at < first_end_ || at >= second_begin_);
  }

 private:
  std::size_t first_end_, second_begin_, comment_;
};

/// Levels of brackets and of XML's tags.
class Nesting {
 public:
  void Add(string_view line) {
    // Comments of more than one line: where they end is not looked for.
    has_long_comment_ = has_long_comment_ || Holds(line, "/*") || Holds(line, "<!--");
    const SureParts sure(line);
    for (std::size_t i = 0; i < line.size(); ++i) {
      const char next = i + 1 < line.size() ? line[i + 1] : '\0';
      const int step = Step(line[i], next);
      if (step > 0 || (sure.Has(i) && !has_long_comment_)) levels_ = std::max(0, levels_ + step);
      deepest_ = std::max(deepest_, levels_);
    }
  }
  int deepest() const { return deepest_; }

 private:
  static int Step(char c, char next) {
    if (c == '[' || c == '{') return 1;
    if (c == ']' || c == '}') return -1;
    if (c != '<') return 0;
    if (next == '/') return -1;
    return std::isalpha(static_cast<unsigned char>(next)) != 0 || next == '_' ? 1 : 0;
  }

  int levels_ = 0;
  int deepest_ = 0;
  bool has_long_comment_ = false;
};

/// Levels of YAML's blocks at the end of a line: one around it is at least a column to its left,
/// and a line opens no more than it has dashes and colons.
int BlockLevels(string_view line) {
  const auto first = std::find_if_not(line.begin(), line.end(), IsBlank);
  auto levels = first - line.begin();
  for (std::size_t i = 0; i < line.size(); ++i) {
    const bool is_dash = line[i] == '-' && (i + 1 == line.size() || IsBlank(line[i + 1]));
    if (is_dash || line[i] == ':') ++levels;
  }
  return static_cast<int>(levels);
}

bool IsTooDeep(string_view text) {
  // JSON, which has no blocks, may be one long line.
  const std::size_t start = text.find_first_not_of(" \t\r\n");
  const bool has_blocks = start == string_view::npos || text[start] != '{';
  Nesting nesting;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find_first_of("\r\n"), text.size());
    const string_view line = text.substr(0, end);
    nesting.Add(line);
    if (has_blocks && BlockLevels(line) > kDeepestNesting) return true;
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return nesting.deepest() > kDeepestNesting;
}

}  // namespace

std::string OpenCvTextFault(string_view text) {
  if (Holds(text, string_view("\0", 1))) {
    return "is binary or compressed; unpack it, or write it as text with OpenCV's calibration";
  }
  if (IsTooDeep(text)) {
    return "nests more than " + std::to_string(kDeepestNesting) +
           " levels, as no calibration does; write it with OpenCV's calibration";
  }
  return "";
}

}  // namespace deixis::capture
