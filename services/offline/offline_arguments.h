#pragma once
#include <optional>
#include <string>
#include <vector>

#include "services/offline/registry.h"

namespace deixis::offline {

/// What the command line of deixis-offline says.
struct Arguments {
  std::string input;
  std::string output;
  std::vector<std::string> services = DefaultServices();
  Configuration configuration;
  std::string channel_prefix;
  std::string times;  ///< File for the services' CPU times; empty: none.
  bool results_only = false;
  std::optional<int> threads;  ///< For OpenCV; its own choice without.
};

/// Reads the arguments. Where they ask for help or the version, or are wrong, prints what is due
/// and returns the exit code instead.
struct ParsedArguments {
  Arguments arguments;
  std::optional<int> exit_code;
};
ParsedArguments ParseArguments(int argc, const char* const* argv);

}  // namespace deixis::offline
