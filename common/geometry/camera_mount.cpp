#include "common/geometry/camera_mount.h"

#include <utility>

namespace deixis::geometry {

CameraCalibration Mounted(CameraCalibration calibration, const CameraMount& mount) {
  calibration.parent_frame = mount.parent_frame;
  calibration.parent_from_camera = mount.parent_from_camera;
  return calibration;
}

StereoCalibration Mounted(StereoCalibration calibration, const CameraMount& mount) {
  const RigidTransform& parent_from_left = mount.parent_from_camera;
  const RigidTransform left_from_right = Inverse(calibration.right_from_left);
  // A rectified camera stands where the raw one does and is turned only.
  const RigidTransform rectified_from_left{
      Eigen::Quaterniond(calibration.left.rectification).normalized(), Eigen::Vector3d::Zero()};
  const auto at = [&mount](const RigidTransform& parent_from_camera) {
    return CameraMount{mount.parent_frame, parent_from_camera};
  };
  calibration.left = Mounted(std::move(calibration.left), mount);
  calibration.right = Mounted(std::move(calibration.right), at(parent_from_left * left_from_right));
  calibration.rectified = Mounted(std::move(calibration.rectified),
                                  at(parent_from_left * Inverse(rectified_from_left)));
  return calibration;
}

}  // namespace deixis::geometry
