#include "services/calibrator/picture_folder.h"

#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <stdexcept>

#include "services/calibrator/core/calibration_files.h"
#include "services/calibrator/core/figures.h"
#include "services/calibrator/core/pictures.h"

namespace deixis::calibrator {
namespace {
namespace fs = std::filesystem;

std::vector<Corners> CornersOf(const ViewSelection& selection, std::size_t camera) {
  std::vector<Corners> views;
  for (const Shot& shot : selection.shots()) views.push_back(shot.views.at(camera).corners);
  return views;
}

// Pictures of two cameras may differ in height.
cv::Mat SideBySide(const std::vector<cv::Mat>& pictures) {
  if (pictures.size() == 1) return pictures.front();
  const int height = std::max(pictures[0].rows, pictures[1].rows);
  std::vector<cv::Mat> padded(2);
  for (std::size_t i = 0; i < 2; ++i) {
    cv::copyMakeBorder(pictures[i], padded[i], 0, height - pictures[i].rows, 0, 0,
                       cv::BORDER_CONSTANT);
  }
  cv::Mat both;
  cv::hconcat(padded, both);
  return both;
}

}  // namespace

PictureFolder::PictureFolder(const fs::path& folder) : folder_(folder) {
  if (folder_.empty()) return;
  std::error_code error;
  fs::create_directories(folder_, error);
  if (!fs::is_directory(folder_)) {
    throw std::runtime_error("--save '" + folder_.string() +
                             "' cannot be made: " + error.message() + "; name another folder");
  }
}

void PictureFolder::WriteView(const ViewSelection& selection, const std::vector<cv::Mat>& bgr,
                              const BoardLayout& layout) const {
  if (folder_.empty()) return;
  std::vector<cv::Mat> drawn;
  std::vector<cv::Mat> coverage;
  const Shot& shot = selection.shots().back();
  for (std::size_t camera = 0; camera < shot.views.size(); ++camera) {
    drawn.push_back(DrawCorners(bgr[camera], shot.views[camera].corners, layout));
    coverage.push_back(DrawCoverage(selection.coverage(camera), CornersOf(selection, camera),
                                    shot.views[camera].size));
  }
  Write(Figures("view_%02zu.png", selection.shots().size()), SideBySide(drawn));
  Write("latest.png", SideBySide(drawn));
  Write("coverage.png", SideBySide(coverage));
}

void PictureFolder::WriteResiduals(const ViewSelection& selection, std::size_t camera,
                                   const CameraCalibration& calibration, const BoardLayout& layout,
                                   const std::string& suffix) const {
  if (folder_.empty()) return;
  const auto views = At(CornersOf(selection, camera), calibration.robust.used);
  Write("residuals" + suffix + ".png", DrawResiduals(calibration.robust.fit, views, layout));
}

void PictureFolder::WriteRectified(const StereoFit& fit, const std::vector<cv::Mat>& bgr) const {
  if (!folder_.empty()) Write("rectified.png", DrawRectified(fit, bgr.at(0), bgr.at(1)));
}

void PictureFolder::Write(const std::string& name, const cv::Mat& bgr) const {
  std::vector<std::uint8_t> png;
  if (!cv::imencode(".png", bgr, png)) throw std::runtime_error(name + " cannot be encoded");
  WriteTogether({{folder_ / name, std::string(png.begin(), png.end())}});
}

}  // namespace deixis::calibrator
