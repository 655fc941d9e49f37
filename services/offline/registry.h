#pragma once
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "common/transport/bus.h"
#include "services/offline/offline_host.h"

namespace deixis::offline {

/// How the services of a run are configured, by service name.
struct Configuration {
  std::map<std::string, std::string> files;  ///< Instead of the shipped <name>.yaml.
  std::map<std::string, std::vector<std::string>> overrides;  ///< key=value
};

/// The services that can be hosted, in the order in which data flows.
std::vector<std::string> KnownServices();
/// Those that a run hosts when none are named.
std::vector<std::string> DefaultServices();

/// Makes service `name` on `bus`. Throws config::ConfigError for an unknown name or a wrong file.
std::unique_ptr<HostedService> MakeService(const std::string& name,
                                           const Configuration& configuration, transport::Bus& bus);

}  // namespace deixis::offline
