#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "common/body_model/body_model.h"
#include "common/motion/read_clip.h"
#include "common/retargeting/retarget.h"

namespace deixis::anthropometer {

/// Motion files of a folder and those below, sorted: .bvh and .amc. Throws ConfigError when there
/// are none.
std::vector<std::filesystem::path> FindMotionFiles(const std::filesystem::path& folder);

/// Who was recorded, by the file's name: of an AMC file its skeleton's name, of a BVH file what
/// stands before the last underscore.
std::string ActorOf(const std::filesystem::path& file);

/// Reads motion files into poses of one model.
class RecordingReader {
 public:
  /// With the shipped maps of skeletons and the usual sizes of people of both sexes. Throws
  /// ConfigError when `model`, a name in config/body_models, is none.
  RecordingReader(const std::string& model, motion::ClipOptions options);

  /// Throws MotionFileError or ConfigError naming the file.
  retargeting::Retargeted Read(const std::filesystem::path& file) const;

 private:
  std::vector<retargeting::SkeletonMap> maps_;
  body_model::BodyModel average_;
  motion::ClipOptions options_;
};

}  // namespace deixis::anthropometer
