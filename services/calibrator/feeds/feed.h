#pragma once
#include <cstdint>
#include <memory>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <string>
#include <vector>

#include "common/capture/source.h"

namespace deixis::calibrator {

/// The pictures of one moment, one per camera. A picture that could not be read is empty.
struct Sight {
  std::string name;
  Timestamp time;
  std::vector<cv::Mat> bgr;
};

/// How the pictures of a feed follow one another.
enum class FeedKind {
  kSeparate,   ///< Each was taken on purpose: files, a folder without times.
  kRecording,  ///< A stream with an end: the board must be held still for a moment.
  kLive        ///< A stream without one: somebody moves the board and wants to be told.
};

struct Take {
  capture::SourceState state = capture::SourceState::kWaiting;
  std::optional<Sight> sight;  ///< Set with kPicture only.
};

/// Where the pictures to calibrate from come from.
class Feed {
 public:
  virtual ~Feed() = default;
  virtual Take Next() = 0;  ///< Waits some milliseconds at most.
  virtual FeedKind kind() const = 0;
  virtual std::string trouble() const = 0;  ///< What is wrong or was passed over; empty = nothing.
};

}  // namespace deixis::calibrator
