#include "services/stereo_driver/core/matching/people/windows.h"

#include <algorithm>
#include <array>

namespace deixis::stereo_driver {
namespace {

constexpr int kLeast_px = 16;  // Narrower windows have no room for alignment.
constexpr double kWellFilled = 1.15;

cv::Rect Evened(const cv::Rect& window, cv::Size size) {
  const cv::Rect inside = window & cv::Rect({0, 0}, size);
  const int left = inside.x / 2 * 2;
  const int top = inside.y / 2 * 2;
  const int right = std::min((inside.x + inside.width + 1) / 2 * 2, size.width / 2 * 2);
  const int bottom = std::min((inside.y + inside.height + 1) / 2 * 2, size.height / 2 * 2);
  return {left, top, std::max(0, right - left), std::max(0, bottom - top)};
}

bool IsUsable(const cv::Rect& window) { return std::min(window.width, window.height) >= kLeast_px; }

/// Two windows fill their common rectangle so well that nothing is lost by taking that.
bool FillRectangle(const cv::Rect& a, const cv::Rect& b) {
  return (a | b).area() <= kWellFilled * (a.area() + b.area() - (a & b).area());
}

/// The largest part of `window` on one side of `taken`.
cv::Rect Beside(const cv::Rect& window, const cv::Rect& taken) {
  const cv::Rect shared = window & taken;
  if (shared.empty()) return window;
  const cv::Point low = window.tl();
  const cv::Point high = window.br();
  const std::array<cv::Rect, 4> sides = {
      cv::Rect(low, cv::Point(shared.x, high.y)), cv::Rect(cv::Point(shared.br().x, low.y), high),
      cv::Rect(low, cv::Point(high.x, shared.y)), cv::Rect(cv::Point(low.x, shared.br().y), high)};
  return *std::max_element(sides.begin(), sides.end(), [](const cv::Rect& a, const cv::Rect& b) {
    return a.area() < b.area();
  });
}

/// Joins the first two that overlap and fill a rectangle well; false when none do.
bool JoinTwo(Windows& windows) {
  for (std::size_t i = 0; i < windows.size(); ++i) {
    for (std::size_t j = i + 1; j < windows.size(); ++j) {
      if ((windows[i] & windows[j]).empty() || !FillRectangle(windows[i], windows[j])) continue;
      windows[i] |= windows[j];
      windows.erase(windows.begin() + static_cast<std::ptrdiff_t>(j));
      return true;
    }
  }
  return false;
}

}  // namespace

Windows Tidied(const Windows& windows, cv::Size size, double largest_share) {
  Windows joined;
  for (const cv::Rect& window : windows) joined.push_back(Evened(window, size));
  while (JoinTwo(joined)) {
  }
  double room_px = largest_share * size.area();
  Windows tidied;
  for (cv::Rect window : joined) {
    for (const cv::Rect& taken : tidied) window = Beside(window, taken);
    if (!IsUsable(window) || window.area() > room_px) continue;
    room_px -= window.area();
    tidied.push_back(window);
  }
  return tidied;
}

}  // namespace deixis::stereo_driver
