#include "services/anthropometer/core/drawing.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <opencv2/imgproc.hpp>
#include <string>
#include <vector>

#include "common/body_model/kinematics.h"

namespace deixis::anthropometer {
namespace {

using body_model::BodyModel;
using body_model::BodyPose;
using body_model::Kinematics;
using Eigen::Vector3d;

constexpr int kAround = 36;
constexpr int kAlong = 8;
constexpr double kMargin = 1.1;

const cv::Scalar kPaper(250, 250, 250), kOutline(90, 90, 90), kJoint(40, 40, 40);
const cv::Scalar kRightSide(150, 180, 225), kLeftSide(225, 190, 160), kMiddle(205, 205, 195);

cv::Scalar ColourOf(const std::string& name) {
  if (name.rfind("right_", 0) == 0) return kRightSide;
  if (name.rfind("left_", 0) == 0) return kLeftSide;
  return kMiddle;
}

/// Metres in the root's frame to pixels, and how near the viewer is.
class Projection {
 public:
  Projection(View view, const Vector3d& middle_m, int height_px, double span_m)
      : view_(view), middle_m_(middle_m), half_px_(0.5 * height_px), per_m_(height_px / span_m) {}

  cv::Point operator()(const Vector3d& point_m) const {
    const Vector3d offset = per_m_ * (point_m - middle_m_);
    // From the front the person's left is on the right; from its left side the front is on the
    // left.
    const double right = view_ == View::kFront ? offset.y() : -offset.x();
    return {static_cast<int>(std::lround(half_px_ + right)),
            static_cast<int>(std::lround(half_px_ - offset.z()))};
  }
  double Nearness(const Vector3d& point_m) const {
    return view_ == View::kFront ? point_m.x() : point_m.y();
  }

 private:
  View view_;
  Vector3d middle_m_;
  double half_px_;
  double per_m_;
};

std::vector<Vector3d> SurfaceOf(const Kinematics& kinematics, int limb) {
  const auto& shape = kinematics.model().limbs()[static_cast<std::size_t>(limb)].shape;
  std::vector<Vector3d> points;
  for (int i = 0; i < kAround; ++i) {
    for (int k = 0; k <= kAlong; ++k) {
      points.emplace_back(kinematics.limb(limb) *
                          geometry::SidePoint(shape, 2.0 * M_PI * i / kAround, 1.0 * k / kAlong));
    }
  }
  return points;
}

Vector3d MiddleOf(const std::vector<std::vector<Vector3d>>& surfaces) {
  Vector3d low = surfaces[0][0], high = low;
  for (const auto& surface : surfaces) {
    for (const Vector3d& point : surface) {
      low = low.cwiseMin(point);
      high = high.cwiseMax(point);
    }
  }
  return 0.5 * (low + high);
}

}  // namespace

cv::Mat Draw(const BodyModel& model, const BodyPose& pose, View view, int height_px,
             double span_m) {
  Kinematics kinematics(model);
  BodyPose in_root = pose;
  in_root.frame_from_root = {};
  kinematics.Update(in_root);
  std::vector<std::vector<Vector3d>> surfaces;
  for (int i = 0; i < model.limb_count(); ++i) surfaces.push_back(SurfaceOf(kinematics, i));
  const Projection projection(view, MiddleOf(surfaces), height_px, span_m);
  std::vector<int> order(surfaces.size());
  std::iota(order.begin(), order.end(), 0);
  const auto nearness = [&](int limb) {
    return projection.Nearness(0.5 * (kinematics.proximal_m(limb) + kinematics.distal_m(limb)));
  };
  std::stable_sort(order.begin(), order.end(),
                   [&](int a, int b) { return nearness(a) < nearness(b); });
  cv::Mat picture(height_px, height_px, CV_8UC3, kPaper);
  for (const int limb : order) {
    std::vector<cv::Point> points, outline;
    for (const Vector3d& point : surfaces[static_cast<std::size_t>(limb)]) {
      points.push_back(projection(point));
    }
    cv::convexHull(points, outline);
    const std::string& name = model.limbs()[static_cast<std::size_t>(limb)].name;
    cv::fillConvexPoly(picture, outline, ColourOf(name), cv::LINE_AA);
    cv::polylines(picture, outline, true, kOutline, 1, cv::LINE_AA);
  }
  for (int limb = 0; limb < model.limb_count(); ++limb) {
    cv::circle(picture, projection(kinematics.proximal_m(limb)), std::max(2, height_px / 250),
               kJoint, cv::FILLED, cv::LINE_AA);
  }
  return picture;
}

cv::Mat DrawFrontAndSide(const BodyModel& model, const BodyPose& pose, int height_px) {
  Kinematics kinematics(model);
  BodyPose in_root = pose;
  in_root.frame_from_root = {};
  kinematics.Update(in_root);
  Vector3d low = Vector3d::Constant(1e9), high = -low;
  for (int i = 0; i < model.limb_count(); ++i) {
    for (const Vector3d& point : SurfaceOf(kinematics, i)) {
      low = low.cwiseMin(point);
      high = high.cwiseMax(point);
    }
  }
  const double span_m = kMargin * (high - low).maxCoeff();
  cv::Mat both;
  cv::hconcat(Draw(model, pose, View::kFront, height_px, span_m),
              Draw(model, pose, View::kSide, height_px, span_m), both);
  return both;
}

}  // namespace deixis::anthropometer
