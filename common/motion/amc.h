#pragma once
#include <filesystem>

#include "common/motion/asf.h"

namespace deixis::motion {

/// Reads an Acclaim motion of the skeleton `asf`: every bone that moves once per frame, in any
/// order; frames numbered one after the other from any number. The format states no rate. Throws
/// MotionFileError.
Clip ReadAmc(const Asf& asf, const std::filesystem::path& path, double frame_rate_hz);

}  // namespace deixis::motion
