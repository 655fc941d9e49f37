#pragma once
#include <functional>
#include <memory>

#include "common/capture/rounds.h"
#include "common/capture/source.h"

namespace deixis::capture {

/// A recording without end: opened again whenever it is over. Time goes on: the first picture of a
/// round comes one period after the last one of the round before. Recordings whose pictures are
/// paired must not be looped one by one: they would drift apart by the difference of their lengths.
class LoopedSource final : public Source {
 public:
  explicit LoopedSource(std::function<std::unique_ptr<Source>()> open);

  Grab Next()
      override;  ///< kFinished only when a round gave no picture at all, or time is up (2^59).
  SourceStatus status() const override;

 private:
  void BeginNextRound();

  std::function<std::unique_ptr<Source>()> open_;
  std::unique_ptr<Source> source_;
  SourceStatus before_;  ///< What the earlier rounds have counted.
  Rounds rounds_;
};

}  // namespace deixis::capture
