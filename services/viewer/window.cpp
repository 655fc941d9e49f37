#include "services/viewer/window.h"

#include <cstdlib>
#include <opencv2/highgui.hpp>

#include "common/config/config.h"

namespace deixis::viewer {
namespace {

constexpr const char* kTitle = "Deixis";

[[noreturn]] void FailWithoutDisplay() {
  throw config::ConfigError(
      "window: there is no display; log in with one ($DISPLAY), or set window to false and "
      "save_folder to a folder");
}

}  // namespace

void OpenWindow() {
  if (std::getenv("DISPLAY") == nullptr && std::getenv("WAYLAND_DISPLAY") == nullptr) {
    FailWithoutDisplay();
  }
  try {
    cv::namedWindow(kTitle, cv::WINDOW_NORMAL | cv::WINDOW_KEEPRATIO);
  } catch (const cv::Exception&) {
    FailWithoutDisplay();
  }
}

void ShowInWindow(const cv::Mat& bgr) {
  cv::imshow(kTitle, bgr);
  cv::waitKey(1);  // Lets the window draw itself.
}

}  // namespace deixis::viewer
