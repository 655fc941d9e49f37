#pragma once
#include <array>
#include <cstdint>
#include <memory>
#include <optional>

#include "common/capture/source.h"
#include "common/time/time_matcher.h"

namespace deixis::capture {

/// Two pictures that were taken together.
using PicturePair = TimeMatch<Picture, Picture>;

struct PairGrab {
  SourceState state = SourceState::kWaiting;
  std::optional<PicturePair> pair;  ///< Set with kPicture only.
};

/// Two sources whose pictures are paired by time. What waits in a live camera is the newest
/// picture, which would be lost: it is fetched always. Of a recording the next one is fetched when
/// it may find its partner. Few pictures wait, since a decoded one may take 200 MB.
class PairedSources {
 public:
  /// `begun`: what has been fetched of either before.
  PairedSources(std::unique_ptr<Source> first, std::unique_ptr<Source> second, double max_skew_s,
                std::array<Grab, 2> begun = {});

  /// The next pair, if there is one; returns within the decoding time of two pictures.
  PairGrab Next();

  const Source& first() const { return *first_.source; }
  const Source& second() const { return *second_.source; }
  double max_skew_s() const { return max_skew_s_; }
  /// Pictures that found no partner.
  std::int64_t unmatched_first() const { return matcher_.unmatched_first(); }
  std::int64_t unmatched_second() const { return matcher_.unmatched_second(); }

 private:
  struct Side {
    std::unique_ptr<Source> source;
    SourceState state = SourceState::kWaiting;
  };

  static std::optional<Picture> Fetch(Side& side, bool is_wanted);
  static std::optional<Picture> Taken(Side& side, Grab grab);
  void Add(std::optional<Picture> first, std::optional<Picture> second);

  double max_skew_s_;
  Side first_;
  Side second_;
  TimeMatcher<Picture, Picture> matcher_;
};

}  // namespace deixis::capture
