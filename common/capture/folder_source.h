#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "common/capture/sources.h"

namespace deixis::capture {

/// Whether `a` comes before `b` as people count: img2 before img10.
bool NaturallyBefore(const std::string& a, const std::string& b);

/// What the pictures of a folder hold.
enum class FolderContent {
  kColour,  ///< Any picture, made into 8-bit colour.
  kDepth    ///< One channel of 16 bits; other pictures count as corrupt.
};

/// A folder of pictures. Without `times.csv` in it they come in natural order of their names at
/// `rate_hz`. With `times.csv` (header `file,time_s`, one picture per line, times growing) it says
/// which pictures, in which order, and when; a `rate_hz` above 0 replaces its times.
class FolderSource final : public Source {
 public:
  /// Throws ConfigError when there is no picture, or nothing says when they were taken.
  explicit FolderSource(const SourceConfig& config, FolderContent content = FolderContent::kColour);

  Grab Next() override;
  SourceStatus status() const override;

 private:
  struct Entry {
    std::filesystem::path file;
    Timestamp time;  ///< Since the first picture.
  };
  static std::vector<Entry> ListPictures(const SourceConfig& config);
  double PeriodAfter(std::size_t index) const;

  FolderContent content_;
  std::vector<Entry> entries_;
  double period_s_;  ///< 0 = from the entries' times.
  std::size_t next_ = 0;
  std::int64_t corrupt_ = 0;
  std::string last_corrupt_;
};

}  // namespace deixis::capture
