#pragma once
#include <filesystem>

#include "services/calibrator/feeds/feed.h"

namespace deixis::calibrator {

/// The picture files that `words` (paths, or patterns as a shell has them) name, as people count
/// them: left2 before left10. `option`: for messages. Throws ConfigError when a word names nothing.
std::vector<std::filesystem::path> FilesOf(const std::vector<std::string>& words,
                                           const std::string& option);

/// Pictures from files; of several cameras, those at the same place of each list belong together.
class FileFeed final : public Feed {
 public:
  /// Throws ConfigError when the lists differ in length.
  explicit FileFeed(std::vector<std::vector<std::filesystem::path>> files);

  Take Next() override;
  FeedKind kind() const override { return FeedKind::kSeparate; }
  std::string trouble() const override;

 private:
  std::vector<std::vector<std::filesystem::path>> files_;
  std::size_t next_ = 0;
  int unreadable_ = 0;
  std::string last_unreadable_;
};

}  // namespace deixis::calibrator
