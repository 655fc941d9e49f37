#pragma once
#include <filesystem>
#include <memory>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <vector>

#include "common/body_model/tracked_body.h"
#include "services/pose_fitter/core/depth/depth_view.h"

namespace deixis::pose_fitter {

/// A depth image and, where known, what it truly shows. All pictures are of the camera's size.
struct PeopleFrame {
  double time_s = 0.0;
  DepthCamera camera;
  cv::Mat depth_mm;  ///< CV_16UC1, what is to be judged by.
  bool has_truth = false;
  cv::Mat true_mm;  ///< CV_16UC1; 0 = not known.
  cv::Mat person;   ///< CV_8UC1: 0 = nobody, 1, 2 = who.
  body_model::Floor floor;
};

/// A rendered sequence as a rectified depth camera sees it: with the true depth, or with the one of
/// STEREO in a log made from the same sequence.
class PeopleSequence {
 public:
  /// `log` empty: true depth, `width_px` wide, of the frames that have a truth. Throws ConfigError
  /// naming what cannot be read.
  PeopleSequence(const std::filesystem::path& folder, const std::filesystem::path& log,
                 int width_px);
  ~PeopleSequence();

  /// Frames in order; nothing at the end. Throws ConfigError.
  std::optional<PeopleFrame> Next();

 private:
  struct Truth;
  class Recording;

  std::optional<PeopleFrame> NextTrue();
  std::optional<PeopleFrame> NextRecorded();

  std::unique_ptr<Truth> truth_;
  std::unique_ptr<Recording> recording_;
  geometry::StereoCalibration calibration_;  ///< Without a recording.
  int width_px_;
  std::size_t next_ = 0;
};

}  // namespace deixis::pose_fitter
