// Runs services over a log in one process: log in, log out, deterministic. See README.md.
#include <chrono>
#include <filesystem>
#include <iostream>
#include <opencv2/core/utility.hpp>
#include <optional>

#include "common/config/config.h"
#include "common/program/command_line.h"
#include "common/program/service_loop.h"
#include "services/offline/offline_arguments.h"
#include "services/offline/offline_report.h"

namespace {

namespace offline = deixis::offline;

void RequireDifferentFiles(const offline::Arguments& arguments) {
  std::error_code ignored;
  if (std::filesystem::equivalent(arguments.input, arguments.output, ignored)) {
    throw deixis::config::ConfigError("input and output are the same file '" + arguments.input +
                                      "'; name another");
  }
}

// A log in which nothing was for these services leaves nothing behind.
void RemoveIfEmpty(const std::string& file) {
  std::error_code ignored;
  if (std::filesystem::is_regular_file(file, ignored) &&
      std::filesystem::file_size(file, ignored) == 0) {
    std::filesystem::remove(file, ignored);
  }
}

// One line every two seconds while a long log is worked on.
class Progress {
 public:
  void operator()(double share) {
    const auto now = std::chrono::steady_clock::now();
    if (now < next_) return;
    next_ = now + std::chrono::seconds(2);
    std::cerr << "deixis-offline: " << static_cast<int>(100.0 * share) << " %\n";
  }

 private:
  std::chrono::steady_clock::time_point next_ =
      std::chrono::steady_clock::now() + std::chrono::seconds(2);
};

void Run(const offline::Arguments& arguments) {
  if (arguments.threads) cv::setNumThreads(*arguments.threads);
  RequireDifferentFiles(arguments);
  offline::LogReader input(arguments.input);
  std::optional<offline::ServiceTimes> times;
  if (!arguments.times.empty()) times.emplace(arguments.times);
  offline::OfflineHost host(arguments.channel_prefix, times ? &*times : nullptr);
  for (const std::string& name : arguments.services) {
    host.Add(offline::MakeService(name, arguments.configuration, host.bus()), name);
  }
  deixis::transport::BusOptions output_options;
  output_options.url = "file://" + arguments.output + "?mode=w";
  deixis::transport::Bus output(output_options);
  const auto content = arguments.results_only ? offline::OutputContent::kResultsOnly
                                              : offline::OutputContent::kEverything;
  const auto summary = host.Run(input, output, content, Progress{});
  try {
    offline::Report(summary, arguments.input);
  } catch (const std::exception&) {
    RemoveIfEmpty(arguments.output);
    throw;
  }
}

}  // namespace

int main(int argc, char** argv) {
  const auto [arguments, exit_code] = offline::ParseArguments(argc, argv);
  if (exit_code) return *exit_code;
  return deixis::program::Guarded({"offline", ""}, [&arguments = arguments] { Run(arguments); });
}
