#pragma once
#include <type_traits>
#include <utility>

#include "common/config/config.h"
#include "common/logging/log.h"
#include "common/program/command_line.h"
#include "common/program/service_loop.h"
#include "common/transport/bus.h"
#include "common/transport/status_reporter.h"

namespace deixis::program {

template <typename Service, typename = void>
struct HasStep : std::false_type {};
template <typename Service>
struct HasStep<Service, std::void_t<decltype(std::declval<Service&>().Step())>> : std::true_type {};

template <typename Service, typename = void>
struct HasHealth : std::false_type {};
template <typename Service>
struct HasHealth<Service, std::void_t<decltype(std::declval<const Service&>().health())>>
    : std::true_type {};

/// The service's optional parts, `StepResult Step()` and `Health health() const`, as the loop calls
/// them.
template <typename Service>
Hosted HostedBy(Service& service) {
  Hosted hosted;
  if constexpr (HasStep<Service>::value) hosted.step = [&service] { return service.Step(); };
  if constexpr (HasHealth<Service>::value) hosted.health = [&service] { return service.health(); };
  return hosted;
}

/// A whole service program: arguments, configuration, bus, `Service(config, input, output)`, loop,
/// exit code.
template <typename Service, typename Config>
int RunService(const Description& description, int argc, char** argv) {
  const auto [line, exit_code] = ParseCommandLine(description, argc, argv);
  if (exit_code) return *exit_code;
  return Guarded(description, [&description, &line = line] {
    StopOnSignals();
    const std::string file =
        line.config_file.empty() ? description.name + ".yaml" : line.config_file;
    const auto config = config::Load<Config>(config::FindConfig(file), line.overrides);
    transport::Bus bus(line.bus);
    Service service(config, bus, bus);
    transport::StatusReporter status({description.name, line.instance}, bus, bus);
    logging::Info("started", {{"version", DEIXIS_VERSION}, {"lcm_url", bus.url()}});
    Loop(HostedBy(service), bus, status);
    logging::Info("stopped");
  });
}

}  // namespace deixis::program
