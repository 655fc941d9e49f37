#pragma once
#include <string>

#include "services/offline/offline_host.h"

namespace deixis::offline {

/// Says in the log what a run over the log file `input` has used, lost and published. Throws
/// ConfigError with the cure when that is no result: nothing was published, or most of the input
/// cannot be read.
void Report(const Summary& summary, const std::string& input);

}  // namespace deixis::offline
