#pragma once
#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <string>
#include <vector>

#include "common/time/timestamp.h"

namespace deixis::capture {

/// The latest time that a recording may have, in itself and where it starts: the sum of both still
/// is a time that receivers take (below 2^60).
inline constexpr Timestamp kLatestTime{std::int64_t{1} << 59};

/// One picture as a source gives it.
struct Picture {
  Timestamp time;         ///< Live: capture time. Recorded: time since the recording began.
  double period_s = 0.0;  ///< Nominal time to the next picture; 0 = not known (live).
  cv::Mat bgr;            ///< rows x cols, CV_8UC3; empty when it could not be decoded.
  cv::Mat depth;          ///< rows x cols, CV_16UC1; of depth sources, which have no `bgr`.
  std::vector<std::uint8_t> jpeg;  ///< The file that `bgr` was decoded from; empty = there is none.
};

enum class SourceState {
  kPicture,   ///< Here is the next picture.
  kWaiting,   ///< Nothing new yet.
  kFinished,  ///< A recording is at its end.
};

struct Grab {
  SourceState state = SourceState::kWaiting;
  std::optional<Picture> picture;  ///< Set with kPicture only.
};

struct SourceStatus {
  bool is_live = false;  ///< Whether picture times are wall-clock times of capture.
  std::string
      trouble;  ///< What is wrong now ("device lost, trying again in 4 s"); empty = nothing.
  std::int64_t skipped =
      0;  ///< Live pictures that a newer one replaced before they were asked for.
  std::int64_t corrupt = 0;  ///< Pictures that were to be there but could not be read.
  std::string last_corrupt;  ///< File of the last one of these; empty when it has none of its own.
};

/// `now` with what has been counted before it, of the same recording opened earlier.
inline SourceStatus WithEarlier(const SourceStatus& earlier, SourceStatus now) {
  now.skipped += earlier.skipped;
  now.corrupt += earlier.corrupt;
  if (now.last_corrupt.empty()) now.last_corrupt = earlier.last_corrupt;
  return now;
}

/// Where pictures come from: a camera, a stream, a file, a folder.
class Source {
 public:
  virtual ~Source() = default;

  /// The next picture, if there is one. Never waits for a camera: returns within a picture's
  /// decoding time. Pictures that cannot be decoded are counted and passed over.
  virtual Grab Next() = 0;

  virtual SourceStatus status() const = 0;
};

}  // namespace deixis::capture
