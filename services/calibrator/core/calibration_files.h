#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "services/calibrator/core/calibration.h"

namespace deixis::calibrator {

/// A file to be written.
struct FileText {
  std::filesystem::path path;
  std::string text;
};

/// What stands in the files besides the calibration.
struct Notes {
  std::string
      time;  ///< calibration_time; empty = left out, so that the same input gives the same bytes.
  std::string remark;  ///< What is wrong with a calibration that was written all the same.
};

/// OpenCV's YAML as its calibration sample writes it: camera_matrix, distortion_coefficients,
/// image_width, image_height, avg_reprojection_error, fisheye_model.
std::string CameraYaml(const CameraCalibration& calibration, const Notes& notes);

/// M1 D1 M2 D2, as OpenCV's stereo_calib writes them, and the size.
std::string IntrinsicsYaml(const StereoCalibration& calibration, const Notes& notes);

/// R T (metres, right_from_left) R1 R2 P1 P2 Q, as OpenCV's stereo_calib writes them, and the size.
std::string ExtrinsicsYaml(const StereoCalibration& calibration, const Notes& notes);

/// What becomes of a file that is there already.
enum class Existing { kKeep, kReplace };

/// Throws std::runtime_error with the cure unless all of `paths` can be written: files that are
/// there only with Existing::kReplace. Makes missing folders.
void RequireWritable(const std::vector<std::filesystem::path>& paths, Existing existing);

/// Writes all files under names of their own first, then gives them their names: a disk that is
/// full leaves the old ones. Throws std::runtime_error.
void WriteTogether(const std::vector<FileText>& files);

}  // namespace deixis::calibrator
