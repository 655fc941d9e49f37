// Runs services over a log in one process: log in, log out, deterministic. See README.md.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <filesystem>
#include <iostream>
#include <opencv2/core/utility.hpp>

#include "common/config/config.h"
#include "common/logging/log.h"
#include "common/program/command_line.h"
#include "common/program/service_loop.h"
#include "services/offline/registry.h"

namespace {

using deixis::config::ConfigError;
namespace offline = deixis::offline;
namespace logging = deixis::logging;

struct Arguments {
  std::string input;
  std::string output;
  std::vector<std::string> services = offline::KnownServices();
  std::vector<std::string> files;
  std::vector<std::string> overrides;
  std::string channel_prefix;
  bool results_only = false;
  int threads = -1;
};

void Describe(CLI::App& app, Arguments& arguments) {
  app.set_version_flag("--version", "deixis-offline " DEIXIS_VERSION);
  app.add_option("input", arguments.input, "Log to read")->required();
  app.add_option("output", arguments.output, "Log to write")->required();
  app.add_option("--services", arguments.services, "Services to run, separated by commas")
      ->delimiter(',')
      ->capture_default_str();
  app.add_option("--config", arguments.files, "service=FILE: another configuration file")
      ->allow_extra_args(false);
  app.add_option("--set", arguments.overrides, "service.key=value: one key of a configuration")
      ->allow_extra_args(false);
  app.add_option("--channel-prefix", arguments.channel_prefix, "In front of every channel name");
  app.add_option("--threads", arguments.threads,
                 "Threads for OpenCV's image operations; the result does not depend on it");
  app.add_flag("--results-only", arguments.results_only, "Leave the input out of the output");
}

// "service<separator>rest", or an error that names the option.
std::pair<std::string, std::string> Split(const std::string& text, char separator,
                                          const std::string& option) {
  const auto at = text.find(separator);
  if (at == std::string::npos || at == 0) {
    throw ConfigError(option + " '" + text + "' does not begin with a service and '" + separator +
                      "'");
  }
  return {text.substr(0, at), text.substr(at + 1)};
}

void RequireHosted(const std::string& service, const Arguments& arguments) {
  const auto& all = arguments.services;
  if (std::find(all.begin(), all.end(), service) != all.end()) return;
  throw ConfigError("'" + service + "' is configured but not among --services");
}

offline::Configuration ConfigurationOf(const Arguments& arguments) {
  offline::Configuration configuration;
  for (const std::string& text : arguments.files) {
    const auto [service, file] = Split(text, '=', "--config");
    RequireHosted(service, arguments);
    configuration.files[service] = file;
  }
  for (const std::string& text : arguments.overrides) {
    const auto [service, assignment] = Split(text, '.', "--set");
    RequireHosted(service, arguments);
    configuration.overrides[service].push_back(assignment);
  }
  return configuration;
}

void RequireDifferentFiles(const Arguments& arguments) {
  std::error_code ignored;
  if (std::filesystem::equivalent(arguments.input, arguments.output, ignored)) {
    throw ConfigError("input and output are the same file '" + arguments.input + "'; name another");
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

void Tell(const offline::Summary& summary, const Arguments& arguments) {
  if (summary.events_read == 0)
    throw ConfigError("log '" + arguments.input + "' holds no messages");
  if (summary.unreadable_bytes > 0) {
    logging::Warn("input_damaged", {{"log", arguments.input},
                                    {"unreadable_bytes", summary.unreadable_bytes},
                                    {"used_events", summary.events_read}});
  }
  for (const auto& [what, count] : summary.drops) {
    logging::Warn("messages_dropped", {{"what", what}, {"count", count}});
  }
  if (summary.events_replaced > 0) {
    logging::Info("input_replaced", {{"messages", summary.events_replaced}});
  }
  for (const auto& [channel, count] : summary.published) {
    logging::Info("published", {{"channel", channel}, {"messages", count}});
  }
}

void Run(const Arguments& arguments) {
  if (arguments.threads >= 0) cv::setNumThreads(arguments.threads);
  RequireDifferentFiles(arguments);
  offline::LogReader input(arguments.input);
  offline::OfflineHost host(arguments.channel_prefix);
  const offline::Configuration configuration = ConfigurationOf(arguments);
  for (const std::string& name : arguments.services) {
    host.Add(offline::MakeService(name, configuration, host.bus()));
  }
  deixis::transport::BusOptions output_options;
  output_options.url = "file://" + arguments.output + "?mode=w";
  deixis::transport::Bus output(output_options);
  const auto content = arguments.results_only ? offline::OutputContent::kResultsOnly
                                              : offline::OutputContent::kEverything;
  Tell(host.Run(input, output, content, Progress{}), arguments);
}

}  // namespace

int main(int argc, char** argv) {
  Arguments arguments;
  CLI::App app("Runs services over a log in one process, deterministically.", "deixis-offline");
  Describe(app, arguments);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? deixis::program::kStopped : deixis::program::kWrongCommand;
  }
  return deixis::program::Guarded({"offline", ""}, [&] { Run(arguments); });
}
