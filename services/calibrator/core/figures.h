#pragma once
#include <string>

namespace deixis::calibrator {

/// A text with figures in it, as printf has it.
__attribute__((format(printf, 1, 2))) std::string Figures(const char* format, ...);

}  // namespace deixis::calibrator
