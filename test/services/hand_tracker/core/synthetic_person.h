#pragma once
#include <Eigen/Core>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "common/images/image.h"
#include "common/scene/object.h"

namespace deixis::hand_tracker {

/// A cartoon of somebody in a room with skin-coloured furniture: sways a little, waves the right
/// hand.
class SyntheticPerson {
 public:
  explicit SyntheticPerson(cv::Size size = {640, 480}) : size_(size) {}

  static constexpr double kPeriod_s = 1.0 / 30.0;
  static constexpr double kFace_px = 60.0;

  /// Where the hands are; the right one waves, the left one hangs.
  Eigen::Vector2d RightHand(int frame) const {
    return Sway(frame) + Eigen::Vector2d(215.0 + 45.0 * std::sin(0.12 * frame), 250.0);
  }
  Eigen::Vector2d LeftHand(int frame) const { return Sway(frame) + Eigen::Vector2d(395.0, 300.0); }

  images::Image Picture(int frame) const {
    cv::Mat picture(480, 640, CV_8UC3, cv::Scalar(120, 130, 125));
    cv::rectangle(picture, {500, 250}, {620, 420}, Wood(), cv::FILLED);
    cv::rectangle(picture, {40, 300}, {70, 470}, Wood(), cv::FILLED);
    const Eigen::Vector2d sway = Sway(frame);
    Ellipse(picture, sway + Eigen::Vector2d(320, 280), {70, 130}, {110, 60, 40});
    Ellipse(picture, sway + Eigen::Vector2d(320, 100), {27, 36}, Skin());
    for (const double side : {-1.0, 1.0}) {
      Ellipse(picture, sway + Eigen::Vector2d(320 + 11 * side, 92), {3, 3}, {30, 30, 30});
    }
    Ellipse(picture, RightHand(frame), {13, 22}, Skin());
    Ellipse(picture, LeftHand(frame), {13, 22}, Skin());
    cv::GaussianBlur(picture, picture, {3, 3}, 0.8);
    images::Image image;
    image.time = Time(frame);
    image.camera = "CAMERA";
    cv::resize(picture, image.bgr, size_, 0, 0, cv::INTER_AREA);
    return image;
  }

  scene::Objects Faces(int frame) const {
    const Eigen::Vector2d corner = Sway(frame) + Eigen::Vector2d(290, 70);
    const double scale = size_.width / 640.0;
    scene::Object face;
    face.id = 1;
    face.person_id = 7;
    face.kind = scene::ObjectKind::kFace;
    face.box =
        scene::Box{corner.x() * scale, corner.y() * scale, kFace_px * scale, kFace_px * scale};
    scene::Objects objects;
    objects.time = Time(frame);
    objects.camera = "CAMERA";
    objects.objects = {face};
    return objects;
  }

  static Timestamp Time(int frame) {
    return {static_cast<std::int64_t>(std::llround(1e6 * kPeriod_s * frame))};
  }

 private:
  static cv::Scalar Skin() { return {140, 165, 215}; }
  static cv::Scalar Wood() { return {135, 170, 210}; }
  static Eigen::Vector2d Sway(int frame) {
    return {5.0 * std::sin(0.09 * frame), 2.0 * std::sin(0.07 * frame)};
  }
  static void Ellipse(cv::Mat& picture, const Eigen::Vector2d& centre, cv::Size axes,
                      const cv::Scalar& colour) {
    constexpr int kShift = 4;
    constexpr double kOne = 1 << kShift;
    cv::ellipse(picture,
                {static_cast<int>(std::lround(kOne * centre.x())),
                 static_cast<int>(std::lround(kOne * centre.y()))},
                cv::Size(axes.width << kShift, axes.height << kShift), 0, 0, 360, colour,
                cv::FILLED, cv::LINE_AA, kShift);
  }

  cv::Size size_;
};

}  // namespace deixis::hand_tracker
