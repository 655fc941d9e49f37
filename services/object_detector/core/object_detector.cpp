#include "services/object_detector/core/object_detector.h"

#include <algorithm>
#include <opencv2/imgproc.hpp>

namespace deixis::object_detector {
namespace {

cv::Mat GreyOf(const cv::Mat& bgr) {
  cv::Mat grey;
  cv::cvtColor(bgr, grey, cv::COLOR_BGR2GRAY);
  return grey;
}

}  // namespace

ObjectDetector::ObjectDetector(const DetectorsConfig& config)
    : detectors_(MakeDetectors(config, [this] { return next_id_++; })) {}

scene::Objects ObjectDetector::Detect(const images::Image& image) {
  ResetIfTimeWentBack(image.time);
  const GreyPicture picture{image.time, GreyOf(image.bgr)};
  scene::Objects objects;
  objects.time = image.time;
  objects.camera = image.camera;
  objects.frame = detectors_.frame;
  objects.source = "object_detector";
  for (const auto& detector : detectors_.all) {
    const std::vector<scene::Object> found = detector->Detect(picture);
    objects.objects.insert(objects.objects.end(), found.begin(), found.end());
  }
  std::sort(objects.objects.begin(), objects.objects.end(),
            [](const scene::Object& a, const scene::Object& b) { return a.id < b.id; });
  return objects;
}

void ObjectDetector::ResetIfTimeWentBack(Timestamp time) {
  if (last_time_ && time < *last_time_) {
    for (const auto& detector : detectors_.all) detector->Reset();
  }
  last_time_ = time;
}

}  // namespace deixis::object_detector
