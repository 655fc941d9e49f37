#pragma once
#include <ostream>

#include "services/calibrator/core/calibration.h"
#include "services/calibrator/core/view_selection.h"

namespace deixis::calibrator {

/// How many pictures met which fate, and what the feed had to complain about.
void ReportFates(const ViewSelection& selection, const std::string& trouble, std::ostream& out);

/// `whose`: "", "left " or "right ".
void ReportCamera(const CameraCalibration& calibration, const std::vector<Shot>& shots,
                  const std::string& whose, std::ostream& out);

void ReportStereo(const StereoCalibration& calibration, const std::vector<Shot>& shots,
                  std::ostream& out);

}  // namespace deixis::calibrator
