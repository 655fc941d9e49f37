#include "services/object_detector/core/cascade.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <tuple>

#include "common/config/config.h"

namespace deixis::object_detector {
namespace {
namespace fs = std::filesystem;

std::string Locate(const std::string& file, const std::vector<std::string>& folders) {
  std::error_code ignored;
  if (fs::is_regular_file(file, ignored)) return file;
  for (const std::string& folder : folders) {
    const fs::path path = fs::path(folder) / file;
    if (fs::is_regular_file(path, ignored)) return path.string();
  }
  try {
    return config::FindConfig(file).string();
  } catch (const config::ConfigError&) {
    throw config::ConfigError("cascade '" + file +
                              "' not found; install the package opencv-data, or set its file or "
                              "the cascade folders to where it lies");
  }
}

scene::Box ToBox(const cv::Rect& rect) {
  return {static_cast<double>(rect.x), static_cast<double>(rect.y), static_cast<double>(rect.width),
          static_cast<double>(rect.height)};
}

auto Place(const scene::Box& box) { return std::tie(box.y_px, box.x_px, box.height_px); }

cv::Size SizeOf(cv::Size window, double height_px) {
  const double width_px = height_px * window.width / window.height;
  return {static_cast<int>(std::lround(width_px)), static_cast<int>(std::lround(height_px))};
}

}  // namespace

Cascade::Cascade(const std::string& file, const std::vector<std::string>& folders) {
  const std::string path = Locate(file, folders);
  bool is_loaded = false;
  try {
    is_loaded = classifier_.load(path);
  } catch (const cv::Exception&) {
    is_loaded = false;
  }
  if (!is_loaded) {
    throw config::ConfigError(path + ": is not a cascade that OpenCV can read; name another file");
  }
  window_ = classifier_.getOriginalWindowSize();
}

std::vector<scene::Box> Cascade::AnswersAtWindowSize(const cv::Mat& grey) {
  std::vector<scene::Box> boxes;
  if (grey.cols < window_.width || grey.rows < window_.height) return boxes;
  std::vector<cv::Rect> rects;
  classifier_.detectMultiScale(grey, rects, 1.1, 0, 0, window_, window_);
  for (const cv::Rect& rect : rects) boxes.push_back(ToBox(rect));
  std::sort(boxes.begin(), boxes.end(),
            [](const scene::Box& a, const scene::Box& b) { return Place(a) < Place(b); });
  return boxes;
}

std::vector<CascadeHit> Cascade::Find(const cv::Mat& grey, double min_height_px,
                                      double max_height_px, double scale_step, int min_neighbours) {
  std::vector<CascadeHit> hits;
  if (grey.cols < window_.width || grey.rows < window_.height) return hits;
  std::vector<cv::Rect> rects;
  std::vector<int> neighbours;
  classifier_.detectMultiScale(grey, rects, neighbours, scale_step, min_neighbours, 0,
                               SizeOf(window_, min_height_px), SizeOf(window_, max_height_px));
  for (std::size_t i = 0; i < rects.size(); ++i) hits.push_back({ToBox(rects[i]), neighbours[i]});
  std::sort(hits.begin(), hits.end(), [](const CascadeHit& a, const CascadeHit& b) {
    if (a.neighbours != b.neighbours) return a.neighbours > b.neighbours;
    return Place(a.box) < Place(b.box);
  });
  return hits;
}

}  // namespace deixis::object_detector
