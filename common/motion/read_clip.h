#pragma once
#include <filesystem>

#include "common/motion/bvh.h"

namespace deixis::motion {

struct ClipOptions {
  BvhOptions bvh;
  /// Skeleton of an AMC file; empty: the one ASF file beside it whose name its own begins with.
  std::filesystem::path asf;
  double amc_frame_rate_hz = 120.0;  ///< AMC files state no rate; most were recorded at 120 Hz.
};

/// The one ASF file beside an AMC file whose name its own begins with, as HDM_bd.asf of
/// HDM_bd_grab.amc. Throws MotionFileError when there is none or several.
std::filesystem::path FindAsf(const std::filesystem::path& amc);

/// Reads a motion file by its extension, .bvh or .amc. Throws MotionFileError.
Clip ReadClip(const std::filesystem::path& path, const ClipOptions& options = {});

}  // namespace deixis::motion
