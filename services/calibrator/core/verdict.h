#pragma once
#include <string>
#include <vector>

#include "services/calibrator/core/calibration.h"
#include "services/calibrator/core/view_selection.h"

namespace deixis::calibrator {

/// What a calibration must keep to be written.
struct Demands {
  int views = 8;                  ///< At least.
  double coverage = 0.4;          ///< Share of the picture's 8 x 6 cells with corners, at least.
  double tilt_deg = 10.0;         ///< Of the board against the picture, once at least.
  double error_px = 1.0;          ///< Reprojection error, at most.
  double rows_px = 1.0;           ///< Stereo: median row difference, at most.
  double focal_deviation = 0.02;  ///< Standard deviation of the focal length over itself, at most.
};

/// What speaks against a camera's calibration, each with its cure; empty when nothing does.
/// `whose`: "", "left: " or "right: ".
std::vector<std::string> FaultsOf(const CameraCalibration& calibration, const Coverage& coverage,
                                  const std::string& whose, const Demands& demands);

std::vector<std::string> FaultsOf(const StereoCalibration& calibration,
                                  const ViewSelection& selection, const Demands& demands);

}  // namespace deixis::calibrator
