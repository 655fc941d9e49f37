#pragma once
#include <filesystem>
#include <string>

namespace deixis::anthropometer {

/// The file of a body model: of a name the shipped one of config/body_models; a name that ends in
/// .yaml is a path. Throws ConfigError when there is none.
std::filesystem::path FindModelFile(const std::string& name);

}  // namespace deixis::anthropometer
