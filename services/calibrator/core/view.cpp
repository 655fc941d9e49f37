#include "services/calibrator/core/view.h"

#include <cmath>
#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>

#include "services/calibrator/core/lens.h"
#include "services/calibrator/core/sharpness.h"

namespace deixis::calibrator {
namespace {

constexpr double kDegrees = 180.0 / CV_PI;
constexpr std::size_t kFewestShared = 4;

void JudgePlace(View& view) {
  std::vector<cv::Point2f> hull;
  cv::convexHull(view.corners.points_px, hull);
  const cv::Scalar mean = cv::mean(view.corners.points_px);
  view.centre = {mean[0] / view.size.width, mean[1] / view.size.height};
  view.extent = std::sqrt(cv::contourArea(hull) / view.size.area());
}

void JudgeTilt(View& view, const BoardLayout& layout) {
  const auto pose = FindPose(RoughLens(view.size), layout, view.corners);
  if (!pose) return;
  cv::Matx33d rotation;
  cv::Rodrigues(pose->rotation, rotation);
  // The board's normal, away from the camera. Against the picture, not the way to the board: a
  // board that is parallel to the picture tells nothing of the focal length wherever it is.
  cv::Vec3d normal(rotation(0, 2), rotation(1, 2), rotation(2, 2));
  if (normal[2] < 0.0) normal = -normal;
  view.tilt_right_deg = -std::atan2(normal[0], normal[2]) * kDegrees;
  view.tilt_down_deg = -std::atan2(normal[1], normal[2]) * kDegrees;
}

}  // namespace

std::optional<View> Look(const cv::Mat& grey, const Board& board) {
  auto corners = board.detector->Detect(grey);
  if (!corners) return std::nullopt;
  View view;
  view.size = grey.size();
  view.corners = std::move(*corners);
  view.edge_width_px = EdgeWidth_px(grey, view.corners, board.layout);
  JudgePlace(view);
  JudgeTilt(view, board.layout);
  return view;
}

std::optional<double> CornerMotion_px(const Corners& a, const Corners& b) {
  const SharedCorners shared = Shared(a, b);
  if (shared.first.ids.size() < kFewestShared) return std::nullopt;
  double sum = 0.0;
  for (std::size_t i = 0; i < shared.first.ids.size(); ++i) {
    sum += cv::norm(shared.first.points_px[i] - shared.second.points_px[i]);
  }
  return sum / static_cast<double>(shared.first.ids.size());
}

}  // namespace deixis::calibrator
