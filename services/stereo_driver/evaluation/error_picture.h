#pragma once
#include <filesystem>
#include <opencv2/core/mat.hpp>
#include <string>

#include "services/stereo_driver/core/matching/stereo_matcher.h"

namespace deixis::stereo_driver {

/// Writes <folder>/depth_<name>.png: the rectified picture, its depth (near red, far blue, black =
/// none), and the errors on the raw pixels (black 0 to white 0.1 m; red = body not measured, blue =
/// no body), each with a caption below.
/// Throws ConfigError when it cannot be written.
void WriteErrorPicture(const std::filesystem::path& folder, const std::string& name,
                       const RectifiedDepth& result, const cv::Mat& errors_m);

}  // namespace deixis::stereo_driver
