#include "services/calibrator/core/sharpness.h"

#include <algorithm>
#include <cmath>

#include "services/calibrator/core/median.h"

namespace deixis::calibrator {
namespace {

constexpr double kStep_px = 0.25;
constexpr double kLeastReach_px = 2.0;
constexpr double kLeastContrast = 15.0;  // Grey levels; below, noise makes the width.

std::optional<double> GreyAt(const cv::Mat& grey, cv::Point2d point) {
  const int u = static_cast<int>(std::floor(point.x));
  const int v = static_cast<int>(std::floor(point.y));
  if (u < 0 || v < 0 || u + 1 >= grey.cols || v + 1 >= grey.rows) return std::nullopt;
  const double du = point.x - u;
  const double dv = point.y - v;
  const auto value = [&](int row, int column) {
    return static_cast<double>(grey.at<std::uint8_t>(row, column));
  };
  return (1 - dv) * ((1 - du) * value(v, u) + du * value(v, u + 1)) +
         dv * ((1 - du) * value(v + 1, u) + du * value(v + 1, u + 1));
}

/// Grey along the way across the edge, mean over three ways side by side.
std::vector<double> Profile(const cv::Mat& grey, cv::Point2d middle, cv::Point2d along,
                            cv::Point2d across, double reach_px) {
  std::vector<double> profile;
  for (double s = -reach_px; s <= reach_px; s += kStep_px) {
    double sum = 0.0;
    for (const double shift : {-0.15, 0.0, 0.15}) {
      const auto value = GreyAt(grey, middle + shift * along + s * across);
      if (!value) return {};
      sum += *value;
    }
    profile.push_back(sum / 3.0);
  }
  return profile;
}

std::optional<double> RiseWidth_px(std::vector<double> profile) {
  if (profile.size() < 8) return std::nullopt;
  if (profile.front() > profile.back()) std::reverse(profile.begin(), profile.end());
  const double low = *std::min_element(profile.begin(), profile.end());
  const double high = *std::max_element(profile.begin(), profile.end());
  if (high - low < kLeastContrast) return std::nullopt;
  const double upper = low + 0.9 * (high - low);
  const double lower = low + 0.1 * (high - low);
  const auto end = std::find_if(profile.begin(), profile.end(),
                                [upper](double value) { return value >= upper; });
  auto begin = end;
  while (begin != profile.begin() && *begin > lower) --begin;
  return kStep_px * static_cast<double>(end - begin);
}

std::optional<double> WidthBetween(const cv::Mat& grey, cv::Point2d a, cv::Point2d b,
                                   double clear_share) {
  const cv::Point2d along = b - a;
  const double length = cv::norm(along);
  const double reach_px = clear_share * length;
  if (reach_px < kLeastReach_px) return std::nullopt;
  const cv::Point2d across(-along.y / length, along.x / length);
  return RiseWidth_px(Profile(grey, 0.5 * (a + b), along, across, reach_px));
}

}  // namespace

std::optional<double> EdgeWidth_px(const cv::Mat& grey, const Corners& corners,
                                   const BoardLayout& layout) {
  std::vector<double> widths;
  const double clear_share = layout.clear_m / layout.square_m;
  for (std::size_t i = 0; i < corners.ids.size(); ++i) {
    for (std::size_t j = i + 1; j < corners.ids.size(); ++j) {
      const int step = corners.ids[j] - corners.ids[i];
      if (step > layout.corners.width) break;
      const bool is_right = step == 1 && corners.ids[j] % layout.corners.width != 0;
      if (!is_right && step != layout.corners.width) continue;
      const auto width =
          WidthBetween(grey, corners.points_px[i], corners.points_px[j], clear_share);
      if (width) widths.push_back(*width);
    }
  }
  if (widths.empty()) return std::nullopt;
  return Median(std::move(widths));
}

}  // namespace deixis::calibrator
