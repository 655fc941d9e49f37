#include "common/program/service_loop.h"

#include <unistd.h>

#include <csignal>
#include <exception>

#include "common/logging/log.h"

namespace deixis::program {
namespace {

// The longest wait, so that a signal ends the loop well within a second.
constexpr std::chrono::milliseconds kLongestWait{100};
constexpr std::chrono::milliseconds kIdleWait{2};

volatile std::sig_atomic_t stop_requested = 0;
volatile std::sig_atomic_t loop_has_begun = 0;

// Before the loop nothing has been said that would have to be taken back, and opening a camera may
// take half a minute.
extern "C" void RequestStop(int) {
  if (loop_has_begun == 0) _exit(kStopped);
  stop_requested = 1;
}

std::chrono::milliseconds WaitAfter(StepResult result) {
  return result == StepResult::kContinue ? std::chrono::milliseconds{0} : kIdleWait;
}

void ReportIfDue(const Hosted& hosted, transport::StatusReporter& status) {
  const transport::Health health = hosted.health ? hosted.health() : transport::Health{};
  status.ReportIfDue(
      health.is_degraded ? messages::ServiceState::kDegraded : messages::ServiceState::kRunning,
      health.text);
}

}  // namespace

void StopOnSignals() {
  struct sigaction action {};
  action.sa_handler = RequestStop;
  sigemptyset(&action.sa_mask);
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
  std::signal(SIGPIPE, SIG_IGN);
}

void Loop(const Hosted& hosted, transport::Bus& bus, transport::StatusReporter& status) {
  loop_has_begun = 1;
  while (stop_requested == 0 && !bus.is_exhausted()) {
    std::chrono::milliseconds wait = kLongestWait;
    if (hosted.step) {
      const StepResult result = hosted.step();
      if (result == StepResult::kFinished) break;
      wait = WaitAfter(result);
    }
    bus.Handle(wait);
    if (bus.is_live()) ReportIfDue(hosted, status);
  }
  if (bus.is_live()) status.Report(messages::ServiceState::kStopping, "");
  bus.Flush();
}

int Guarded(const Description& description, const std::function<void()>& work) {
  logging::SetService(description.name);
  try {
    work();
    return kStopped;
  } catch (const std::exception& error) {
    logging::Error("cannot_work", {{"reason", error.what()}});
    return kCannotWork;
  }
}

}  // namespace deixis::program
