#pragma once
#include <functional>
#include <string>

#include "common/program/command_line.h"
#include "common/transport/bus.h"
#include "common/transport/status_reporter.h"

namespace deixis::program {

/// What a source that works without being sent messages has done in one step.
enum class StepResult {
  kContinue,  ///< Something; call again at once.
  kIdle,      ///< Nothing to do yet; call again in a few milliseconds.
  kFinished   ///< The source has come to its end.
};

/// A service as the loop sees it.
struct Hosted {
  std::function<StepResult()> step;           ///< Empty for services that only answer messages.
  std::function<transport::Health()> health;  ///< Empty for services that are always well.
};

/// Makes SIGINT and SIGTERM end the loop, and the program at once while it has not begun; call
/// before threads are started.
void StopOnSignals();

/// Handles messages, steps the source, reports status, until a signal arrives, the source is
/// finished, or a log that is being read has ended. Throws BusError when the bus is lost.
void Loop(const Hosted& hosted, transport::Bus& bus, transport::StatusReporter& status);

/// Runs `work`; prints one line about an exception that leaves it. Returns the exit code.
int Guarded(const Description& description, const std::function<void()>& work);

}  // namespace deixis::program
