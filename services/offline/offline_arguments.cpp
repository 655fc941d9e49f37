#include "services/offline/offline_arguments.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <utility>

#include "common/program/command_line.h"

namespace deixis::offline {
namespace {

constexpr int kMostThreads = 256;

struct Texts {
  std::vector<std::string> files;
  std::vector<std::string> overrides;
};

void Describe(CLI::App& app, Arguments& arguments, Texts& texts) {
  app.set_version_flag("--version", "deixis-offline " DEIXIS_VERSION);
  app.add_option("input", arguments.input, "Log to read")->required();
  app.add_option("output", arguments.output, "Log to write")->required();
  app.add_option("--services", arguments.services, "Services to run, separated by commas")
      ->delimiter(',')
      ->check(CLI::IsMember(KnownServices()))
      ->capture_default_str();
  app.add_option("--config", texts.files, "service=FILE: another configuration file")
      ->allow_extra_args(false);
  app.add_option("--set", texts.overrides, "service.key=value: one key of a configuration")
      ->check(program::AssignmentFault)
      ->allow_extra_args(false);
  app.add_option("--channel-prefix", arguments.channel_prefix, "In front of every channel name");
  app.add_option("--threads", arguments.threads,
                 "Threads for OpenCV's image operations; the result does not depend on it")
      ->check(CLI::Range(1, kMostThreads));
  app.add_option("--times", arguments.times,
                 "Write a table of the CPU time that each service spends on each message (CSV)");
  app.add_flag("--results-only", arguments.results_only, "Leave the input out of the output");
}

// "service<separator>rest", or an error that names the option.
std::pair<std::string, std::string> Split(const std::string& text, char separator,
                                          const std::string& option) {
  const auto at = text.find(separator);
  if (at == std::string::npos || at == 0 || at + 1 == text.size()) {
    throw CLI::ValidationError(
        option, "'" + text + "' does not begin with a service and '" + separator + "'");
  }
  return {text.substr(0, at), text.substr(at + 1)};
}

void RequireHosted(const std::string& service, const std::string& option,
                   const Arguments& arguments) {
  const auto& all = arguments.services;
  if (std::find(all.begin(), all.end(), service) != all.end()) return;
  throw CLI::ValidationError(option, "'" + service + "' is configured but not among --services");
}

Configuration ConfigurationOf(const Texts& texts, const Arguments& arguments) {
  Configuration configuration;
  for (const std::string& text : texts.files) {
    const auto [service, file] = Split(text, '=', "--config");
    RequireHosted(service, "--config", arguments);
    configuration.files[service] = file;
  }
  for (const std::string& text : texts.overrides) {
    const auto [service, assignment] = Split(text, '.', "--set");
    RequireHosted(service, "--set", arguments);
    configuration.overrides[service].push_back(assignment);
  }
  return configuration;
}

}  // namespace

ParsedArguments ParseArguments(int argc, const char* const* argv) {
  ParsedArguments parsed;
  Texts texts;
  CLI::App app("Runs services over a log in one process, deterministically.", "deixis-offline");
  Describe(app, parsed.arguments, texts);
  try {
    app.parse(argc, argv);
    parsed.arguments.configuration = ConfigurationOf(texts, parsed.arguments);
  } catch (const CLI::ParseError& error) {
    parsed.exit_code = app.exit(error) == 0 ? program::kStopped : program::kWrongCommand;
  }
  return parsed;
}

}  // namespace deixis::offline
