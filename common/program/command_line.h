#pragma once
#include <iosfwd>
#include <optional>
#include <string>
#include <vector>

#include "common/transport/bus.h"

namespace deixis::program {

/// What a program is, for --help and for its status messages.
struct Description {
  std::string name;     ///< "some_name"; the program is then deixis-some-name.
  std::string purpose;  ///< One sentence.
};

/// Exit codes of all programs.
enum ExitCode : int {
  kStopped = 0,  ///< Asked to stop, or the work is done.
  kCannotWork =
      1,  ///< Wrong configuration, missing file or device; one line says which and the cure.
  kWrongCommand = 2,  ///< The command line is not understood.
};

/// What is wrong with a command line's text "key=value"; empty when nothing is.
std::string AssignmentFault(const std::string& text);

/// What is wrong with a text that must name something; empty when nothing is.
std::string EmptyFault(const std::string& text);

/// Ends what a program prints: throws std::runtime_error unless all of it is written, as on a full
/// disk.
void FinishOutput(std::ostream& out);

/// What the command line of a service says.
struct CommandLine {
  std::string config_file;             ///< --config; empty: config/<name>.yaml.
  std::vector<std::string> overrides;  ///< --set key=value
  std::string instance;                ///< --instance
  transport::BusOptions bus;           ///< --lcm-url, --channel-prefix
};

/// Reads the arguments. Where they ask for help or the version, or are wrong, prints what is due
/// and returns the exit code instead.
struct ParsedCommandLine {
  CommandLine command_line;
  std::optional<int> exit_code;
};
ParsedCommandLine ParseCommandLine(const Description& description, int argc, char** argv);

}  // namespace deixis::program
