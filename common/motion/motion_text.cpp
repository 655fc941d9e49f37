#include "common/motion/motion_text.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>

#include "common/capture/regular_file.h"

namespace deixis::motion {
namespace {

using std::string_view;

constexpr std::size_t kLargestFile = std::size_t{512} * 1024 * 1024;
constexpr string_view kBlanks = " \t\f\v";
constexpr string_view kLineEnds = "\r\n";

void DropBlanks(string_view& text) {
  text.remove_prefix(std::min(text.find_first_not_of(kBlanks), text.size()));
}

char Lower(char c) { return static_cast<char>(std::tolower(static_cast<unsigned char>(c))); }

/// For a message: broken files have words without end.
std::string Quoted(string_view word) {
  constexpr std::size_t kMost = 40;
  return "'" + std::string(word.substr(0, kMost)) + (word.size() > kMost ? "...'" : "'");
}

bool IsBinary(char c) {
  const auto byte = static_cast<unsigned char>(c);
  return byte < ' ' && kBlanks.find(c) == string_view::npos &&
         kLineEnds.find(c) == string_view::npos;
}

std::string ReasonOf(const capture::FileContent& content) {
  switch (content.fault) {
    case capture::FileFault::kNone:
      return "is empty";
    case capture::FileFault::kNoRegularFile:
      return "is not there, or no file";
    case capture::FileFault::kTooLarge:
      return "is longer than 512 MiB; cut it into several";
    case capture::FileFault::kUnreadable:
      break;
  }
  return "cannot be read: " + content.reason;
}

}  // namespace

bool IsWord(string_view word, string_view keyword) {
  return std::equal(word.begin(), word.end(), keyword.begin(), keyword.end(),
                    [](char a, char b) { return Lower(a) == Lower(b); });
}

std::string Counted(std::int64_t count, const std::string& noun) {
  return std::to_string(count) + " " + noun + (count == 1 ? "" : "s");
}

MotionText::MotionText(const std::filesystem::path& path) : file_(path.string()) {
  capture::FileContent content = capture::ReadRegularFile(path, kLargestFile);
  if (content.bytes.empty()) throw MotionFileError(file_ + ": " + ReasonOf(content));
  bytes_ = std::move(content.bytes);
  to_come_ = {reinterpret_cast<const char*>(bytes_.data()), bytes_.size()};
  constexpr string_view kByteOrderMark = "\xEF\xBB\xBF";
  if (to_come_.substr(0, kByteOrderMark.size()) == kByteOrderMark) {
    to_come_.remove_prefix(kByteOrderMark.size());
  }
  RefuseBinary();
}

void MotionText::RefuseBinary() const {
  const auto found = std::find_if(to_come_.begin(), to_come_.end(), IsBinary);
  if (found == to_come_.end()) return;
  const auto lines = std::count(to_come_.begin(), found, '\n');
  FailAt(static_cast<std::size_t>(lines) + 1, "text", "is binary; unpack it, or export it as text");
}

void MotionText::GoToNextLine() {
  const std::size_t end = std::min(to_come_.find_first_of(kLineEnds), to_come_.size());
  rest_ = to_come_.substr(0, end);
  to_come_.remove_prefix(end);
  const std::size_t end_size = to_come_.substr(0, 2) == "\r\n" ? 2 : 1;
  to_come_.remove_prefix(std::min(end_size, to_come_.size()));
  ++line_;
  DropBlanks(rest_);
  if (!rest_.empty() && rest_.front() == '#') rest_ = {};
}

string_view MotionText::Peek() {
  while (!LineHasMore()) {
    if (to_come_.empty()) return {};
    GoToNextLine();
  }
  return rest_.substr(0, rest_.find_first_of(kBlanks));
}

string_view MotionText::Take() {
  const string_view word = Peek();
  rest_.remove_prefix(word.size());
  return word;
}

bool MotionText::LineHasMore() {
  DropBlanks(rest_);
  return !rest_.empty();
}

string_view MotionText::TakeLine() {
  DropBlanks(rest_);
  const string_view line = rest_.substr(0, rest_.find_last_not_of(kBlanks) + 1);
  rest_ = {};
  return line;
}

void MotionText::Expect(string_view keyword) {
  const string_view word = Take();
  if (word.empty()) Fail(keyword, "is missing: the file ends here");
  if (!IsWord(word, keyword)) Fail(keyword, "must stand here, not " + Quoted(word));
}

double MotionText::TakeNumber(string_view key) {
  const string_view word = Take();
  if (word.empty()) Fail(key, "lacks a number: the file ends here");
  return ToNumber(word, key);
}

double MotionText::ToNumber(string_view word, string_view key) const {
  string_view digits = word;
  if (digits.size() > 1 && digits[0] == '+' && digits[1] != '-') digits.remove_prefix(1);
  double number = 0.0;
  const char* end = digits.data() + digits.size();
  const auto [stop, error] = std::from_chars(digits.data(), end, number);
  if (error == std::errc::invalid_argument || stop != end) {
    Fail(key, "must be a number, not " + Quoted(word));
  }
  // The negation refuses NaN, too.
  if (error != std::errc() || !(std::abs(number) <= kLargestNumber)) {
    Fail(key, "must be a finite number of at most 1e9, not " + Quoted(word));
  }
  return number;
}

std::int64_t MotionText::ToWholeNumber(string_view word, string_view key) const {
  std::int64_t number = 0;
  const char* end = word.data() + word.size();
  const auto [stop, error] = std::from_chars(word.data(), end, number);
  if (word.empty() || error != std::errc() || stop != end) {
    Fail(key, "must be a whole number, not " + Quoted(word));
  }
  return number;
}

void MotionText::Fail(string_view key, const std::string& fault) const {
  FailAt(line_, key, fault);
}

void MotionText::FailAt(std::size_t line, string_view key, const std::string& fault) const {
  throw MotionFileError(file_ + ":" + std::to_string(line) + ": " + Quoted(key) + " " + fault);
}

}  // namespace deixis::motion
