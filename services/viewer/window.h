#pragma once
#include <opencv2/core/mat.hpp>

namespace deixis::viewer {

/// Opens the window. Throws ConfigError, with the cure, where there is no display.
void OpenWindow();
void ShowInWindow(const cv::Mat& bgr);

}  // namespace deixis::viewer
