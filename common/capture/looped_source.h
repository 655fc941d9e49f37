#pragma once
#include <functional>
#include <memory>

#include "common/capture/source.h"

namespace deixis::capture {

/// A recording without end: opened again whenever it is over. Time goes on: the first picture of a
/// round comes one period after the last one of the round before.
class LoopedSource final : public Source {
 public:
  explicit LoopedSource(std::function<std::unique_ptr<Source>()> open);

  Grab Next()
      override;  ///< kFinished only when a round gave no picture at all, or time is up (2^59).
  SourceStatus status() const override;

 private:
  Grab ShiftToThisRound(Grab grab);
  void BeginNextRound();

  std::function<std::unique_ptr<Source>()> open_;
  std::unique_ptr<Source> source_;
  std::int64_t corrupt_before_ = 0;  ///< Corrupt pictures of the earlier rounds.
  std::int64_t pictures_in_round_ = 0;
  Timestamp round_start_;
  Timestamp next_round_start_;
};

}  // namespace deixis::capture
