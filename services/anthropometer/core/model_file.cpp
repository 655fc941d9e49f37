#include "services/anthropometer/core/model_file.h"

#include "common/config/config.h"

namespace deixis::anthropometer {

std::filesystem::path FindModelFile(const std::string& name) {
  if (std::filesystem::path(name).extension() == ".yaml") return config::FindConfig(name);
  return config::FindConfig("body_models/" + name + ".yaml");
}

}  // namespace deixis::anthropometer
