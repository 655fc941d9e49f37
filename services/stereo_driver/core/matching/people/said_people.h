#pragma once
#include <optional>
#include <string>

#include "common/body_model/tracked_body.h"
#include "common/geometry/camera_calibration.h"
#include "services/stereo_driver/core/matching/people/people_config.h"
#include "services/stereo_driver/core/matching/people/windows.h"

namespace deixis::stereo_driver {

/// Where people are in the picture by the poses that a tracker has said last.
class SaidPeople {
 public:
  /// `camera` is the name of the pictures that depth is published with, which is its frame, too.
  SaidPeople(const PeopleConfig& config, std::string camera);

  /// Takes the place of what was said before. Poses in another picture or frame are counted and
  /// change nothing.
  void Hear(const body_model::BodyPoses& poses);

  /// Where they are by the time of a pair, in pixels of `rectified`; may reach beyond the picture.
  /// Empty when nobody was said to be there, not long enough ago, or all are out of sight.
  Windows At(Timestamp time, const geometry::CameraCalibration& rectified) const;

  std::int64_t elsewhere() const { return elsewhere_; }  ///< Poses of another picture or frame.

 private:
  PeopleConfig config_;
  std::string camera_;
  std::optional<body_model::BodyPoses> poses_;
  std::int64_t elsewhere_ = 0;
};

}  // namespace deixis::stereo_driver
