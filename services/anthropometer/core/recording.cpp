#include "services/anthropometer/core/recording.h"

#include <algorithm>
#include <cctype>
#include <utility>

#include "common/anthropometry/person_estimate.h"
#include "common/body_model/body_plan.h"
#include "common/config/config.h"
#include "services/anthropometer/core/model_file.h"

namespace deixis::anthropometer {
namespace {

namespace fs = std::filesystem;

std::string ExtensionOf(const fs::path& file) {
  std::string extension = file.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char letter) { return static_cast<char>(std::tolower(letter)); });
  return extension;
}

body_model::BodyModel AveragePerson(const std::string& model) {
  const auto populations =
      anthropometry::Populations::Load(config::FindConfig("kinematics/population.yaml"));
  return body_model::LoadBody(FindModelFile(model), EstimatePerson(populations, {}).Sizes_m());
}

}  // namespace

std::vector<fs::path> FindMotionFiles(const fs::path& folder) {
  std::vector<fs::path> files;
  std::error_code fault;
  for (fs::recursive_directory_iterator at(folder, fault), end; at != end; at.increment(fault)) {
    const std::string extension = ExtensionOf(at->path());
    if (extension == ".bvh" || extension == ".amc") files.push_back(at->path());
  }
  if (fault) throw config::ConfigError(folder.string() + ": " + fault.message());
  if (files.empty()) throw config::ConfigError(folder.string() + " holds no .bvh or .amc file");
  std::sort(files.begin(), files.end());
  return files;
}

std::string ActorOf(const fs::path& file) {
  if (ExtensionOf(file) == ".amc") return motion::FindAsf(file).stem().string();
  const std::string stem = file.stem().string();
  return stem.substr(0, stem.rfind('_'));
}

RecordingReader::RecordingReader(const std::string& model, motion::ClipOptions options)
    : maps_(retargeting::LoadSkeletonMaps(config::FindConfigs("skeletons"))),
      average_(AveragePerson(model)),
      options_(std::move(options)) {}

retargeting::Retargeted RecordingReader::Read(const fs::path& file) const {
  const motion::Clip clip = motion::ReadClip(file, options_);
  try {
    return Retarget(clip, BestMap(maps_, clip.skeleton), average_);
  } catch (const config::ConfigError& error) {
    throw config::ConfigError(file.string() + ": " + error.what());
  }
}

}  // namespace deixis::anthropometer
