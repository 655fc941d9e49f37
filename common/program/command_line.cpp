#include "common/program/command_line.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <iostream>
#include <ostream>
#include <stdexcept>

namespace deixis::program {

std::string AssignmentFault(const std::string& text) {
  const auto equals = text.find('=');
  if (equals != std::string::npos && equals > 0) return "";
  return "'" + text + "' is not of the form key=value";
}

std::string EmptyFault(const std::string& text) {
  return text.empty() ? "is empty; give a name or leave the option out" : "";
}

void FinishOutput(std::ostream& out) {
  if (!out.flush()) throw std::runtime_error("cannot write the output: is there room?");
}

ParsedCommandLine ParseCommandLine(const Description& description, int argc, char** argv) {
  ParsedCommandLine parsed;
  CommandLine& line = parsed.command_line;
  std::string program = "deixis-" + description.name;
  std::replace(program.begin(), program.end(), '_', '-');

  CLI::App app(description.purpose, program);
  app.set_version_flag("--version", program + " " DEIXIS_VERSION);
  app.add_option("-c,--config", line.config_file,
                 "Configuration file (default: the shipped " + description.name + ".yaml)")
      ->check(EmptyFault);
  app.add_option("--set", line.overrides,
                 "Set one key of the configuration: key=value, dots for nested keys; repeatable")
      ->check(AssignmentFault)
      ->allow_extra_args(false);
  app.add_option("-l,--lcm-url", line.bus.url,
                 "LCM URL (default: $LCM_DEFAULT_URL, else LCM's own)");
  app.add_option("--channel-prefix", line.bus.channel_prefix, "Set in front of every channel name");
  app.add_option("--instance", line.instance, "Tells two processes of one service apart");
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    parsed.exit_code = app.exit(error) == 0 ? kStopped : kWrongCommand;
  }
  return parsed;
}

}  // namespace deixis::program
