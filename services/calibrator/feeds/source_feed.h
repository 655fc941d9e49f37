#pragma once

#include "common/capture/paired_sources.h"
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
  SourceFeed(std::unique_ptr<capture::Source> source, PictureLayout layout, FeedKind kind);

  Take Next() override;
  FeedKind kind() const override;
  std::string trouble() const override;

 private:
  std::unique_ptr<capture::Source> source_;
  PictureLayout layout_;
  FeedKind kind_;
  int pictures_ = 0;
};

/// Two sources together, their pictures paired by time: recordings within half a period (a picture
/// that cannot be read is missed on its own side only), both they and live cameras within 40 ms.
class TwoSourceFeed final : public Feed {
 public:
  /// Throws ConfigError when one is live and the other is not.
  TwoSourceFeed(std::unique_ptr<capture::Source> left, std::unique_ptr<capture::Source> right,
                FeedKind kind);

  Take Next() override;
  FeedKind kind() const override;
  std::string trouble() const override;

 private:
  FeedKind kind_;
  capture::PairedSources sources_;  ///< Left, right.
  int pairs_ = 0;
};

/// When one of `configs` is a folder that does not say when its pictures were taken, gives all the
/// recordings among them one picture per second, since only their order counts then. A rate that is
/// set stays.
void TimeByOrderUnlessAllHaveTimes(std::vector<capture::SourceConfig>& configs);

/// How the pictures of `configs` follow one another: where a folder does not say when its pictures
/// were taken, they are no stream.
FeedKind KindOf(const std::vector<capture::SourceConfig>& configs);

/// "device:0", "video:walk.mp4", "folder:DIR", "url:rtsp://..." as a source's configuration.
/// Throws ConfigError.
capture::SourceConfig ParseSource(const std::string& text, const std::string& option);

/// Opens it; OpenCV itself stays silent. Throws ConfigError.
std::unique_ptr<capture::Source> OpenSource(const capture::SourceConfig& config);

}  // namespace deixis::calibrator
