#include "services/calibrator/core/pictures.h"

#include <algorithm>
#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>
#include <string>

#include "services/calibrator/core/figures.h"

namespace deixis::calibrator {
namespace {

const cv::Scalar kWhite(255, 255, 255);
const cv::Scalar kGrey(160, 160, 160);
constexpr int kManyCorners = 20;  // A cell with as many is as green as it gets.
constexpr int kRowLines = 16;
constexpr int kShift = 4;  // Of fixed-point drawing coordinates: sixteenths of a pixel.

cv::Point Fixed(cv::Point2d point) {
  return {cvRound(point.x * (1 << kShift)), cvRound(point.y * (1 << kShift))};
}

cv::Scalar ColourOf(int row, int rows) {
  const cv::Mat hsv(1, 1, CV_8UC3, cv::Scalar(150.0 * row / std::max(1, rows - 1), 255, 255));
  cv::Mat bgr;
  cv::cvtColor(hsv, bgr, cv::COLOR_HSV2BGR);
  return bgr.at<cv::Vec3b>(0, 0);
}

void Write(cv::Mat& bgr, const std::string& text) {
  const double scale = std::max(0.4, bgr.cols / 1300.0);
  const cv::Point place(8, bgr.rows - 8);
  cv::putText(bgr, text, place, cv::FONT_HERSHEY_SIMPLEX, scale, {0, 0, 0}, 3, cv::LINE_AA);
  cv::putText(bgr, text, place, cv::FONT_HERSHEY_SIMPLEX, scale, kWhite, 1, cv::LINE_AA);
}

cv::Mat RectifiedPicture(const Lens& lens, const cv::Matx33d& rotation,
                         const cv::Matx34d& projection, const cv::Mat& bgr) {
  cv::Mat map_x;
  cv::Mat map_y;
  const cv::Mat left_part = cv::Mat(projection).colRange(0, 3);
  cv::initUndistortRectifyMap(lens.matrix, lens.distortion, rotation, left_part, lens.size,
                              CV_32FC1, map_x, map_y);
  cv::Mat rectified;
  cv::remap(bgr, rectified, map_x, map_y, cv::INTER_LINEAR);
  return rectified;
}

}  // namespace

cv::Mat DrawCorners(const cv::Mat& bgr, const Corners& corners, const BoardLayout& layout) {
  cv::Mat drawn = bgr.clone();
  for (std::size_t i = 0; i < corners.ids.size(); ++i) {
    const int row = corners.ids[i] / layout.corners.width;
    const cv::Scalar colour = ColourOf(row, layout.corners.height);
    const cv::Point place = Fixed(corners.points_px[i]);
    cv::circle(drawn, place, 5 << kShift, colour, 1, cv::LINE_AA, kShift);
    const bool has_next = i + 1 < corners.ids.size() && corners.ids[i + 1] == corners.ids[i] + 1 &&
                          corners.ids[i + 1] / layout.corners.width == row;
    if (has_next) {
      cv::line(drawn, place, Fixed(corners.points_px[i + 1]), colour, 1, cv::LINE_AA, kShift);
    }
  }
  Write(drawn, Figures("%zu corners", corners.ids.size()));
  return drawn;
}

cv::Mat DrawCoverage(const Coverage& coverage, const std::vector<Corners>& views, cv::Size size) {
  cv::Mat drawn(size, CV_8UC3, cv::Scalar(40, 40, 40));
  for (int row = 0; row < kCoverageRows; ++row) {
    for (int column = 0; column < kCoverageColumns; ++column) {
      const cv::Point from(column * size.width / kCoverageColumns,
                           row * size.height / kCoverageRows);
      const cv::Point to((column + 1) * size.width / kCoverageColumns,
                         (row + 1) * size.height / kCoverageRows);
      const int seen = std::min(kManyCorners, coverage.corners_in(column, row));
      const cv::Scalar colour = seen == 0 ? cv::Scalar(40, 40, 110)
                                          : cv::Scalar(40, 60 + 100.0 * seen / kManyCorners, 40);
      cv::rectangle(drawn, cv::Rect(from, to), colour, cv::FILLED);
      cv::rectangle(drawn, cv::Rect(from, to), kGrey, 1);
    }
  }
  for (const Corners& corners : views) {
    for (const cv::Point2f& point : corners.points_px) {
      cv::circle(drawn, Fixed(point), 2 << kShift, kWhite, cv::FILLED, cv::LINE_AA, kShift);
    }
  }
  Write(drawn, Figures("%zu views, %.0f %% of the picture covered; red: no corner yet",
                       views.size(), 100.0 * coverage.share()));
  return drawn;
}

cv::Mat DrawResiduals(const LensFit& fit, const std::vector<Corners>& views,
                      const BoardLayout& layout) {
  cv::Mat drawn(fit.lens.size, CV_8UC3, cv::Scalar(40, 40, 40));
  for (std::size_t i = 0; i < views.size(); ++i) {
    const auto projected = Project(fit.lens, PointsOnBoard(layout, views[i]), fit.poses[i]);
    const cv::Scalar colour = ColourOf(static_cast<int>(i), static_cast<int>(views.size()));
    for (std::size_t j = 0; j < projected.size(); ++j) {
      const cv::Point2d from = views[i].points_px[j];
      const cv::Point2d way = cv::Point2d(projected[j]) - from;
      cv::arrowedLine(drawn, from, from + kResidualScale * way, colour, 1, cv::LINE_AA, 0, 0.25);
    }
  }
  const cv::Point2d centre(fit.lens.matrix(0, 2), fit.lens.matrix(1, 2));
  cv::drawMarker(drawn, centre, kWhite, cv::MARKER_CROSS, 20, 1, cv::LINE_AA);
  Write(drawn, Figures("residuals x %.0f, rms %.3f px; cross: principal point; a colour per view",
                       kResidualScale, fit.error_px));
  return drawn;
}

cv::Mat DrawRectified(const StereoFit& fit, const cv::Mat& left_bgr, const cv::Mat& right_bgr) {
  const Rectification& r = fit.rectification;
  cv::Mat drawn;
  cv::hconcat(RectifiedPicture(fit.left, r.left_rotation, r.left_projection, left_bgr),
              RectifiedPicture(fit.right, r.right_rotation, r.right_projection, right_bgr), drawn);
  for (int i = 1; i < kRowLines; ++i) {
    const int row = i * drawn.rows / kRowLines;
    cv::line(drawn, {0, row}, {drawn.cols - 1, row}, {0, 255, 0}, 1);
  }
  Write(drawn, "rectified: a point lies on the same row in both");
  return drawn;
}

}  // namespace deixis::calibrator
