#include "services/calibrator/feeds/file_feed.h"

#include <glob.h>

#include <algorithm>
#include <opencv2/imgcodecs.hpp>

#include "common/capture/folder_source.h"
#include "common/capture/picture_file.h"
#include "common/config/config.h"

namespace deixis::calibrator {
namespace {
namespace fs = std::filesystem;

std::vector<fs::path> Matches(const std::string& pattern) {
  std::error_code ignored;
  if (fs::exists(pattern, ignored)) return {pattern};  // A name may hold brackets.
  glob_t found{};
  std::vector<fs::path> files;
  if (glob(pattern.c_str(), GLOB_TILDE, nullptr, &found) == 0) {
    files.assign(found.gl_pathv, found.gl_pathv + found.gl_pathc);
  }
  globfree(&found);
  return files;
}

bool Before(const fs::path& a, const fs::path& b) {
  if (a.parent_path() != b.parent_path()) return a.parent_path() < b.parent_path();
  return capture::NaturallyBefore(a.filename().string(), b.filename().string());
}

std::string Text(std::size_t number) { return std::to_string(number); }

}  // namespace

std::vector<fs::path> FilesOf(const std::vector<std::string>& words, const std::string& option) {
  std::vector<fs::path> files;
  for (const std::string& word : words) {
    const auto matches = Matches(word);
    if (matches.empty()) {
      throw config::ConfigError(option + " '" + word + "' names no file; check the path");
    }
    for (const fs::path& file : matches) {
      std::error_code ignored;
      if (fs::is_directory(file, ignored)) {
        throw config::ConfigError(option + " '" + file.string() + "' is a folder; name '" +
                                  (file / "*.png").string() +
                                  "' or give --source folder:" + file.string());
      }
      files.push_back(file);
    }
  }
  std::sort(files.begin(), files.end(), Before);
  files.erase(std::unique(files.begin(), files.end()), files.end());
  return files;
}

FileFeed::FileFeed(std::vector<std::vector<fs::path>> files) : files_(std::move(files)) {
  for (const auto& list : files_) {
    if (list.size() == files_.front().size()) continue;
    throw config::ConfigError("--left names " + Text(files_.front().size()) +
                              " pictures but --right " + Text(list.size()) +
                              "; name those that belong together, in the same order");
  }
}

Take FileFeed::Next() {
  if (next_ == files_.front().size()) return {capture::SourceState::kFinished, std::nullopt};
  Sight sight;
  sight.time = {static_cast<std::int64_t>(next_) * 1000000};
  for (const auto& list : files_) {
    const fs::path& file = list[next_];
    sight.name += (sight.name.empty() ? "" : " + ") + file.filename().string();
    sight.bgr.push_back(capture::DecodePicture(capture::ReadBytes(file), cv::IMREAD_COLOR));
    if (!sight.bgr.back().empty()) continue;
    ++unreadable_;
    last_unreadable_ = file.string();
  }
  ++next_;
  return {capture::SourceState::kPicture, std::move(sight)};
}

std::string FileFeed::trouble() const {
  if (unreadable_ == 0) return "";
  return "files that cannot be read as pictures: " + std::to_string(unreadable_) +
         ", the last one " + last_unreadable_;
}

}  // namespace deixis::calibrator
