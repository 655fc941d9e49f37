#include "services/hand_tracker/core/skin_evidence.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

namespace deixis::hand_tracker {
namespace {

constexpr int kContrast = 90;

/// What of `skin` stands out by `kContrast` from whatever around it is at least `width_px` wide and
/// high; 0 elsewhere.
cv::Mat NarrowOnly(const cv::Mat& skin, int width_px) {
  const int size = std::max(3, width_px);
  cv::Mat wide;
  cv::morphologyEx(skin, wide, cv::MORPH_OPEN,
                   cv::getStructuringElement(cv::MORPH_RECT, {size, size}));
  cv::Mat narrow = skin.clone();
  narrow.setTo(0, skin - wide < kContrast);
  return narrow;
}

void WeighRow(const std::uint8_t* knowledge, const std::uint8_t* awake, const std::uint8_t* narrow,
              int width, std::uint8_t* evidence) {
  for (int x = 0; x < width; ++x) {
    const std::uint8_t unknown = awake[x] != 0 ? narrow[x] : std::uint8_t{0};
    const std::uint8_t known =
        knowledge[x] == BackgroundModel::kForeground ? evidence[x] : std::uint8_t{0};
    evidence[x] = knowledge[x] == BackgroundModel::kUnknown ? unknown : known;
  }
}

}  // namespace

cv::Mat SkinEvidence(const BackgroundModel& background, const skin::SkinTable& table,
                     int widest_px) {
  cv::Mat evidence = skin::Classify(background.normalised(), table);
  const cv::Mat narrow = NarrowOnly(evidence, widest_px);
  for (int y = 0; y < evidence.rows; ++y) {
    WeighRow(background.knowledge().ptr<std::uint8_t>(y), background.awake().ptr<std::uint8_t>(y),
             narrow.ptr<std::uint8_t>(y), evidence.cols, evidence.ptr<std::uint8_t>(y));
  }
  return evidence;
}

cv::Mat Smooth(const cv::Mat& evidence, int size_px) {
  cv::Mat smooth;
  cv::medianBlur(evidence, smooth, size_px);
  return smooth;
}

void ClearFaces(const std::vector<scene::Box>& faces, cv::Mat& evidence) {
  for (const scene::Box& face : faces) {
    const Eigen::Vector2d centre = scene::Centre(face);
    const cv::Point head(static_cast<int>(std::lround(centre.x())),
                         static_cast<int>(std::lround(centre.y())));
    const cv::Size head_axes(static_cast<int>(0.55 * face.width_px),
                             static_cast<int>(0.75 * face.height_px));
    cv::ellipse(evidence, head, head_axes, 0.0, 0.0, 360.0, cv::Scalar(0), cv::FILLED);
    const cv::Rect neck(static_cast<int>(centre.x() - 0.35 * face.width_px),
                        static_cast<int>(centre.y()), static_cast<int>(0.7 * face.width_px),
                        static_cast<int>(1.0 * face.height_px));
    cv::rectangle(evidence, neck, cv::Scalar(0), cv::FILLED);
  }
}

}  // namespace deixis::hand_tracker
