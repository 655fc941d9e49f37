#pragma once
#include <functional>
#include <ostream>

#include "services/calibrator/arguments.h"

namespace deixis::calibrator {

/// The whole task that `arguments` set: collects, calibrates, reports to `out`, writes.
/// `is_stopped` ends the collecting. Returns the exit code: 1 when the result was refused. Throws
/// with one line that names what is wrong and the cure.
int Run(const Arguments& arguments, const std::function<bool()>& is_stopped, std::ostream& out);

}  // namespace deixis::calibrator
