#pragma once
#include "common/capture/source.h"
#include "common/program/service_loop.h"

namespace deixis::program {

/// What a step that asked a source has done.
inline StepResult ResultOf(capture::SourceState state) {
  switch (state) {
    case capture::SourceState::kPicture:
      return StepResult::kContinue;
    case capture::SourceState::kWaiting:
      return StepResult::kIdle;
    case capture::SourceState::kFinished:
      return StepResult::kFinished;
  }
  return StepResult::kFinished;
}

}  // namespace deixis::program
