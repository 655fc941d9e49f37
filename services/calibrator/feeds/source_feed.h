#pragma once
#include "common/capture/sources.h"
#include "services/calibrator/feeds/feed.h"

namespace deixis::calibrator {

/// How many cameras a source's picture shows.
enum class PictureLayout {
  kOneCamera,
  kSideBySide  ///< The left camera's picture in the left half, the right one's in the right half.
};

/// Pictures of one camera, stream, video or folder.
class SourceFeed final : public Feed {
 public:
  SourceFeed(std::unique_ptr<capture::Source> source, PictureLayout layout);

  Take Next() override;
  FeedKind kind() const override;
  std::string trouble() const override;

 private:
  std::unique_ptr<capture::Source> source_;
  PictureLayout layout_;
  int pictures_ = 0;
};

/// Two sources together: recordings picture by picture, live cameras by their times.
class TwoSourceFeed final : public Feed {
 public:
  /// Throws ConfigError when one is live and the other is not.
  TwoSourceFeed(std::unique_ptr<capture::Source> left, std::unique_ptr<capture::Source> right);

  Take Next() override;
  FeedKind kind() const override;
  std::string trouble() const override;

 private:
  bool Fetch(std::size_t side);  ///< False when the source is at its end.
  bool BelongTogether();

  std::vector<std::unique_ptr<capture::Source>> sources_;
  std::vector<std::optional<capture::Picture>> waiting_{2};
  int pairs_ = 0;
  int unpaired_ = 0;
};

/// "device:0", "video:walk.mp4", "folder:DIR", "url:rtsp://..." as a source's configuration.
/// Throws ConfigError.
capture::SourceConfig ParseSource(const std::string& text, const std::string& option);

/// Opens it; OpenCV itself stays silent. Throws ConfigError.
std::unique_ptr<capture::Source> OpenSource(const capture::SourceConfig& config);

}  // namespace deixis::calibrator
