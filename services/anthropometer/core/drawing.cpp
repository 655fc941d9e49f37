#include "services/anthropometer/core/drawing.h"

#include <Eigen/Geometry>
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

/// The box around all limbs.
Eigen::AlignedBox3d BoxOf(const Kinematics& kinematics) {
  Eigen::AlignedBox3d box;
  for (int i = 0; i < kinematics.model().limb_count(); ++i) {
    for (const Vector3d& point : SurfaceOf(kinematics, i)) box.extend(point);
  }
  return box;
}

/// The limbs, farthest first.
std::vector<int> FromBehind(const Kinematics& kinematics, const Projection& projection) {
  std::vector<int> order(kinematics.model().limbs().size());
  std::iota(order.begin(), order.end(), 0);
  const auto nearness = [&](int limb) {
    return projection.Nearness(0.5 * (kinematics.proximal_m(limb) + kinematics.distal_m(limb)));
  };
  std::stable_sort(order.begin(), order.end(),
                   [&](int a, int b) { return nearness(a) < nearness(b); });
  return order;
}

void DrawLimb(const Kinematics& kinematics, int limb, const Projection& projection,
              cv::Mat& picture) {
  std::vector<cv::Point> points, outline;
  for (const Vector3d& point : SurfaceOf(kinematics, limb)) points.push_back(projection(point));
  cv::convexHull(points, outline);
  const std::string& name = kinematics.model().limbs()[static_cast<std::size_t>(limb)].name;
  cv::fillConvexPoly(picture, outline, ColourOf(name), cv::LINE_AA);
  cv::polylines(picture, outline, true, kOutline, 1, cv::LINE_AA);
}

Kinematics Upright(const BodyModel& model, const BodyPose& pose) {
  Kinematics kinematics(model);
  BodyPose in_root = pose;
  in_root.frame_from_root = {};
  kinematics.Update(in_root);
  return kinematics;
}

}  // namespace

Projection ProjectionOf(const Kinematics& kinematics, View view, int height_px, double span_m) {
  return {view, BoxOf(kinematics).center(), height_px, span_m};
}

double SpanOf(const Kinematics& kinematics) {
  return kMargin * BoxOf(kinematics).sizes().maxCoeff();
}

cv::Mat Draw(const BodyModel& model, const BodyPose& pose, View view, int height_px,
             double span_m) {
  const Kinematics kinematics = Upright(model, pose);
  const Projection projection = ProjectionOf(kinematics, view, height_px, span_m);
  cv::Mat picture(height_px, height_px, CV_8UC3, kPaper);
  for (const int limb : FromBehind(kinematics, projection)) {
    DrawLimb(kinematics, limb, projection, picture);
  }
  for (int limb = 0; limb < model.limb_count(); ++limb) {
    cv::circle(picture, projection(kinematics.proximal_m(limb)), std::max(2, height_px / 250),
               kJoint, cv::FILLED, cv::LINE_AA);
  }
  return picture;
}

cv::Mat DrawFrontAndSide(const BodyModel& model, const BodyPose& pose, int height_px) {
  const double span_m = SpanOf(Upright(model, pose));
  cv::Mat both;
  cv::hconcat(Draw(model, pose, View::kFront, height_px, span_m),
              Draw(model, pose, View::kSide, height_px, span_m), both);
  return both;
}

}  // namespace deixis::anthropometer
