#pragma once
#include <map>
#include <string>

#include "services/pose_fitter/trainer/body_training.h"

namespace deixis::pose_fitter {

/// What calibration makes of somebody whom the plan was not learned from.
struct CalibrationScore {
  bool is_refused = false;
  int frames = 0;
  /// Estimated minus true length of the limbs that person.csv knows, metres: as expected by the
  /// stature, sex not known, and calibrated.
  std::map<std::string, double> expected_error_m, calibrated_error_m;
  double expected_rms_m = 0.0;    ///< Of the surface, poses as they are.
  double calibrated_rms_m = 0.0;  ///< Of the surface, poses refined.
};

/// Calibrates with true depth in at most 60 frames, beginning with the true angles of joints.
CalibrationScore ScoreCalibration(const body_model::BodyPlan& plan_of_others,
                                  const TrainedPerson& person,
                                  const anthropometry::Populations& populations);

}  // namespace deixis::pose_fitter
