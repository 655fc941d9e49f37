#include "common/capture/folder_source.h"

#include <fnmatch.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <fstream>
#include <opencv2/imgcodecs.hpp>
#include <optional>
#include <utility>

#include "common/capture/picture_file.h"
#include "common/images/picture_size.h"

namespace deixis::capture {
namespace {
namespace fs = std::filesystem;

constexpr double kPeriodOfSinglePicture_s = 1.0;
constexpr double kFarthest_s =
    1e11;  // Of a time from 0: the year 5000, in microseconds since 1970.

bool IsDigit(char c) { return c >= '0' && c <= '9'; }

std::string Lower(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

/// The run of digits that starts at `position`, without leading zeros; moves `position` behind it.
std::string TakeNumber(const std::string& text, std::size_t& position) {
  std::size_t end = position;
  while (end < text.size() && IsDigit(text[end])) ++end;
  std::size_t begin = position;
  while (begin + 1 < end && text[begin] == '0') ++begin;
  position = end;
  return text.substr(begin, end - begin);
}

bool IsPicture(const fs::path& file) {
  static const std::array<std::string, 9> kSuffixes{".jpg", ".jpeg", ".png",  ".bmp", ".ppm",
                                                    ".pgm", ".tif",  ".tiff", ".webp"};
  const std::string suffix = Lower(file.extension().string());
  return std::find(kSuffixes.begin(), kSuffixes.end(), suffix) != kSuffixes.end();
}

bool IsJpeg(const std::vector<std::uint8_t>& bytes) {
  return bytes.size() > 3 && bytes[0] == 0xFF && bytes[1] == 0xD8 && bytes[2] == 0xFF;
}

// Larger ones no receiver takes.
bool IsUsable(const cv::Mat& pixels) { return images::IsPictureSize(pixels.cols, pixels.rows); }

std::optional<Picture> ReadDepth(const fs::path& file) {
  Picture picture;
  picture.depth = DecodePicture(ReadBytes(file), cv::IMREAD_UNCHANGED);
  if (!IsUsable(picture.depth) || picture.depth.type() != CV_16UC1) return std::nullopt;
  return picture;
}

std::optional<Picture> ReadPicture(const fs::path& file, FolderContent content) {
  if (content == FolderContent::kDepth) return ReadDepth(file);
  Picture picture;
  picture.jpeg = ReadBytes(file);
  picture.bgr = DecodePicture(picture.jpeg, cv::IMREAD_COLOR);
  if (!IsUsable(picture.bgr)) return std::nullopt;
  if (!IsJpeg(picture.jpeg)) picture.jpeg.clear();
  return picture;
}

std::vector<fs::path> FilesInNaturalOrder(const fs::path& folder, const std::string& pattern) {
  std::vector<fs::path> files;
  std::error_code error;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end;
       entry.increment(error)) {
    const std::string name = entry->path().filename().string();
    const bool is_wanted = fnmatch(pattern.c_str(), name.c_str(), 0) == 0;
    std::error_code is_no_file;  // A link in a circle, say.
    if (is_wanted && IsPicture(entry->path()) && entry->is_regular_file(is_no_file)) {
      files.push_back(entry->path());
    }
  }
  if (error) {
    throw config::ConfigError("folder '" + folder.string() +
                              "' cannot be read: " + error.message() + "; check its rights");
  }
  std::sort(files.begin(), files.end(), [](const fs::path& a, const fs::path& b) {
    return NaturallyBefore(a.filename().string(), b.filename().string());
  });
  return files;
}

struct TimedFile {
  std::string file;
  double time_s = 0.0;
};

[[noreturn]] void FailAt(const fs::path& file, int line, const std::string& fault) {
  throw config::ConfigError(file.string() + ":" + std::to_string(line) + ": " + fault);
}

TimedFile ParseTimedFile(const std::string& line, const fs::path& file, int number) {
  const auto comma = line.find(',');
  if (comma == std::string::npos) FailAt(file, number, "is not of the form file,time_s");
  try {
    std::size_t used = 0;
    const std::string field = line.substr(comma + 1);
    const double time_s = std::stod(field, &used);
    if (used == field.size() && std::abs(time_s) <= kFarthest_s) {
      return {line.substr(0, comma), time_s};
    }
  } catch (const std::exception&) {
    // Falls through to the one message for all that is not a number.
  }
  FailAt(file, number, "time_s is not a number of seconds (1e11 at most)");
}

std::ifstream OpenTimes(const fs::path& file) {
  std::error_code ignored;
  if (!fs::is_regular_file(file, ignored)) {
    throw config::ConfigError(
        file.string() +
        ": is no regular file (but a folder, pipe or device); make it one with "
        "the lines file,time_s, or take it away and set rate_hz");
  }
  std::ifstream stream(file);
  if (!stream) throw config::ConfigError(file.string() + ": cannot be read; check its rights");
  return stream;
}

std::vector<TimedFile> ReadTimes(const fs::path& file) {
  std::ifstream stream = OpenTimes(file);
  std::vector<TimedFile> rows;
  std::string line;
  for (int number = 1; std::getline(stream, line); ++number) {
    if (!line.empty() && line.back() == '\r') line.pop_back();
    if (number == 1 && line != "file,time_s") FailAt(file, 1, "the header must be file,time_s");
    if (number == 1 || line.empty()) continue;
    const TimedFile row = ParseTimedFile(line, file, number);
    if (!rows.empty() && row.time_s <= rows.back().time_s) {
      FailAt(file, number, "time_s does not grow; sort the lines by time");
    }
    rows.push_back(row);
  }
  return rows;
}

Timestamp FromSeconds(double seconds) { return {std::llround(1e6 * seconds)}; }

void RequireFolder(const SourceConfig& config) {
  std::error_code ignored;
  if (fs::is_directory(config.path, ignored)) return;
  throw config::ConfigError("folder '" + config.path + "' does not exist; set " + config.key +
                            ".path to a folder of pictures");
}

}  // namespace

bool NaturallyBefore(const std::string& a, const std::string& b) {
  std::size_t i = 0;
  std::size_t j = 0;
  while (i < a.size() && j < b.size()) {
    if (IsDigit(a[i]) && IsDigit(b[j])) {
      const std::string number_a = TakeNumber(a, i);
      const std::string number_b = TakeNumber(b, j);
      if (number_a.size() != number_b.size()) return number_a.size() < number_b.size();
      if (number_a != number_b) return number_a < number_b;
    } else {
      if (a[i] != b[j]) return a[i] < b[j];
      ++i;
      ++j;
    }
  }
  if (a.size() - i != b.size() - j) return a.size() - i < b.size() - j;
  return a < b;  // They differ in leading zeros at most.
}

std::vector<FolderSource::Entry> FolderSource::ListPictures(const SourceConfig& config) {
  const fs::path folder = config.path;
  RequireFolder(config);
  std::error_code ignored;  // What cannot be looked at is not there.
  const bool has_times = fs::exists(folder / "times.csv", ignored);
  if (!has_times && config.rate_hz <= 0.0) {
    throw config::ConfigError("folder '" + config.path + "' has no times.csv; set " + config.key +
                              ".rate_hz or add one (file,time_s)");
  }
  std::vector<Entry> entries;
  if (has_times) {
    const std::vector<TimedFile> rows = ReadTimes(folder / "times.csv");
    for (const TimedFile& row : rows) {
      entries.push_back({folder / row.file, FromSeconds(row.time_s - rows.front().time_s)});
    }
  } else {
    for (const fs::path& file : FilesInNaturalOrder(folder, config.pattern)) {
      entries.push_back({file, {}});
    }
  }
  for (std::size_t i = 0; config.rate_hz > 0.0 && i < entries.size(); ++i) {
    entries[i].time = FromSeconds(static_cast<double>(i) / config.rate_hz);
  }
  return entries;
}

FolderSource::FolderSource(const SourceConfig& config, FolderContent content)
    : content_(content),
      entries_(ListPictures(config)),
      period_s_(config.rate_hz > 0.0 ? 1.0 / config.rate_hz : 0.0) {
  if (entries_.empty()) {
    throw config::ConfigError("folder '" + config.path + "' has no picture that matches '" +
                              config.pattern + "'; check " + config.key + ".path and " +
                              config.key + ".pattern");
  }
}

Grab FolderSource::Next() {
  while (next_ < entries_.size()) {
    const std::size_t index = next_++;
    std::optional<Picture> picture = ReadPicture(entries_[index].file, content_);
    if (!picture) {
      ++corrupt_;
      last_corrupt_ = entries_[index].file.string();
      continue;
    }
    picture->time = entries_[index].time;
    picture->period_s = PeriodAfter(index);
    return {SourceState::kPicture, std::move(picture)};
  }
  return {SourceState::kFinished, std::nullopt};
}

SourceStatus FolderSource::status() const {
  SourceStatus status;
  status.corrupt = corrupt_;
  status.last_corrupt = last_corrupt_;
  return status;
}

double FolderSource::PeriodAfter(std::size_t index) const {
  if (period_s_ > 0.0) return period_s_;
  if (entries_.size() < 2) return kPeriodOfSinglePicture_s;
  const std::size_t from = std::min(index, entries_.size() - 2);
  return SecondsBetween(entries_[from].time, entries_[from + 1].time);
}

}  // namespace deixis::capture
