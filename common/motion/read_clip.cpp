#include "common/motion/read_clip.h"

#include <algorithm>
#include <system_error>
#include <vector>

#include "common/motion/amc.h"

namespace deixis::motion {
namespace {

namespace fs = std::filesystem;

bool HasExtension(const fs::path& path, const char* extension) {
  return IsWord(path.extension().string(), extension);
}

/// ASF files beside `amc` such as HDM_bd.asf of HDM_bd_grab.amc.
std::vector<fs::path> AsfsBeside(const fs::path& amc) {
  std::vector<fs::path> found;
  const std::string motion = amc.stem().string();
  const fs::path folder = amc.has_parent_path() ? amc.parent_path() : fs::path(".");
  std::error_code ignored;  // Of a folder that cannot be listed: there is none.
  for (fs::directory_iterator entry(folder, ignored), end; !ignored && entry != end;
       entry.increment(ignored)) {
    const std::string skeleton = entry->path().stem().string();
    if (HasExtension(entry->path(), ".asf") && motion.compare(0, skeleton.size(), skeleton) == 0) {
      found.push_back(entry->path());
    }
  }
  std::sort(found.begin(), found.end());
  return found;
}

}  // namespace

fs::path FindAsf(const fs::path& amc) {
  const std::vector<fs::path> found = AsfsBeside(amc);
  if (found.size() == 1) return found[0];
  std::string names;
  for (const fs::path& path : found) names += " " + path.filename().string();
  throw MotionFileError(
      amc.string() + ": an AMC file needs its skeleton: name the ASF file, or put one beside it " +
      "whose name this one begins with (now there are " + std::to_string(found.size()) +
      (names.empty() ? "" : ":") + names + ")");
}

Clip ReadClip(const fs::path& path, const ClipOptions& options) {
  if (HasExtension(path, ".bvh")) return ReadBvh(path, options.bvh);
  if (HasExtension(path, ".amc")) {
    const fs::path asf = options.asf.empty() ? FindAsf(path) : options.asf;
    return ReadAmc(ReadAsf(asf), path, options.amc_frame_rate_hz);
  }
  throw MotionFileError(path.string() + ": is no motion file by its name; known are .bvh and .amc");
}

}  // namespace deixis::motion
