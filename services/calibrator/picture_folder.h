#pragma once
#include <filesystem>

#include "services/calibrator/core/calibration.h"
#include "services/calibrator/core/view_selection.h"

namespace deixis::calibrator {

/// The pictures that show how a calibration came about. Each file appears whole, under its name.
class PictureFolder {
 public:
  /// An empty path: none are written. Throws std::runtime_error when the folder cannot be made.
  explicit PictureFolder(const std::filesystem::path& folder);

  /// Of the newest view: view_<n>.png (stereo: both cameras side by side), latest.png the same, and
  /// coverage.png of all so far.
  void WriteView(const ViewSelection& selection, const std::vector<cv::Mat>& bgr,
                 const BoardLayout& layout) const;
  /// residuals<suffix>.png.
  void WriteResiduals(const ViewSelection& selection, std::size_t camera,
                      const CameraCalibration& calibration, const BoardLayout& layout,
                      const std::string& suffix) const;
  /// rectified.png of one pair.
  void WriteRectified(const StereoFit& fit, const std::vector<cv::Mat>& bgr) const;

 private:
  void Write(const std::string& name, const cv::Mat& bgr) const;

  std::filesystem::path folder_;
};

}  // namespace deixis::calibrator
