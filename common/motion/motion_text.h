#pragma once
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace deixis::motion {

/// What is wrong with a file of motion: names the file, the line and the key, joint or bone.
class MotionFileError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Larger numbers stand in no motion; with this bound nothing that is computed from them is
/// infinite.
inline constexpr double kLargestNumber = 1e9;
/// Joints below one another. A spine and a hand have about 30.
inline constexpr int kDeepestNesting = 256;

/// Whether `word` is `keyword`, in upper or lower case.
bool IsWord(std::string_view word, std::string_view keyword);

/// "3 values", "1 value".
std::string Counted(std::int64_t count, const std::string& noun);

/// The words of a text file in their lines. Lines end in LF, CRLF or CR; blank ones and those that
/// begin with '#' are passed over. What fails throws MotionFileError with file, line and `key`.
class MotionText {
 public:
  /// Reads the whole file. Throws when it is no regular file, empty, binary or longer than 512 MiB.
  explicit MotionText(const std::filesystem::path& path);
  MotionText(const MotionText&) = delete;
  MotionText& operator=(const MotionText&) = delete;

  std::string_view Peek();      ///< The next word, of a later line if need be; empty at the end.
  std::string_view Take();      ///< The same, and goes on behind it.
  bool LineHasMore();           ///< Whether a word follows in the line of the last one.
  std::string_view TakeLine();  ///< What is left of the line of the last word, trimmed.

  void Expect(std::string_view keyword);  ///< Takes it; throws when something else follows.
  double TakeNumber(std::string_view key);
  double ToNumber(std::string_view word, std::string_view key) const;
  std::int64_t ToWholeNumber(std::string_view word, std::string_view key) const;

  std::size_t line() const { return line_; }  ///< Of the last word, from 1.
  [[noreturn]] void Fail(std::string_view key, const std::string& fault) const;
  [[noreturn]] void FailAt(std::size_t line, std::string_view key, const std::string& fault) const;

 private:
  void RefuseBinary() const;
  void GoToNextLine();

  std::string file_;
  std::vector<std::uint8_t> bytes_;
  std::string_view rest_;     // Of the current line.
  std::string_view to_come_;  // Lines after it.
  std::size_t line_ = 0;
};

}  // namespace deixis::motion
