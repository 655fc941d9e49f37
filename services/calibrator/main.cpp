// Calibrates one camera, or two, from pictures of a board. See README.md.
#include <csignal>
#include <iostream>

#include "common/capture/quiet_opencv.h"
#include "common/program/command_line.h"
#include "services/calibrator/session.h"

namespace {

volatile std::sig_atomic_t stop_requested = 0;

extern "C" void RequestStop(int) { stop_requested = 1; }

// The first Ctrl-C ends the collecting, the second the program.
void StopOnSignals() {
  struct sigaction action {};
  action.sa_handler = RequestStop;
  action.sa_flags = static_cast<int>(SA_RESETHAND);
  sigemptyset(&action.sa_mask);
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
}

}  // namespace

int main(int argc, char** argv) {
  using namespace deixis::calibrator;
  const auto [arguments, exit_code] = ParseArguments(argc, argv);
  if (exit_code) return *exit_code;
  StopOnSignals();
  deixis::capture::KeepOpenCvQuiet();
  try {
    return Run(
        arguments, [] { return stop_requested != 0; }, std::cout);
  } catch (const std::exception& error) {
    std::cerr << "deixis-calibrator: " << error.what() << "\n";
    return deixis::program::kCannotWork;
  }
}
