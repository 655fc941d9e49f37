#include "common/messages/camera_calibration.h"

#include <array>
#include <deixis/stereo_calibration_t.hpp>
#include <utility>

#include "common/geometry/lens_limits.h"
#include "common/images/picture_size.h"
#include "common/messages/dimos_parts.h"
#include "common/messages/geometry_parts.h"

namespace deixis::messages {
namespace {

using geometry::CameraCalibration;
using geometry::DistortionModel;
using RowMajor3d = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;

constexpr std::array<std::pair<const char*, DistortionModel>, 4> kModels{{
    {"none", DistortionModel::kNone},
    {"plumb_bob", DistortionModel::kPlumbBob},
    {"rational", DistortionModel::kRational},
    {"fisheye", DistortionModel::kFisheye},
}};

DistortionModel ToModel(const std::string& word) {
  for (const auto& [name, model] : kModels) {
    if (word == name) return model;
  }
  throw Rejected("out_of_range");
}

std::string FromModel(DistortionModel wanted) {
  for (const auto& [name, model] : kModels) {
    if (model == wanted) return name;
  }
  throw std::logic_error("distortion model without a name");
}

CameraCalibration ToPublishedCamera(const stereo_calibration_t& message) {
  CameraCalibration calibration = ToCameraCalibration(message.rectified);
  calibration.time = ToTimestamp(message.utime);
  calibration.camera = Text(message.camera);
  return calibration;
}

void FromMount(const CameraCalibration& calibration, camera_calibration_t& message) {
  message.has_mount = calibration.parent_from_camera.has_value();
  if (!calibration.parent_from_camera) return;
  message.parent_frame = calibration.parent_frame;
  FromTransform(*calibration.parent_from_camera, message.parent_from_camera.translation_m,
                message.parent_from_camera.rotation_wxyz);
}

}  // namespace

void RequireSensible(const CameraCalibration& calibration) {
  const bool is_sensible = images::IsPictureSize(calibration.width_px, calibration.height_px) &&
                           geometry::IsLens(calibration);
  if (!is_sensible) throw Rejected("out_of_range");
}

CameraCalibration ToCameraCalibration(const camera_calibration_t& message) {
  RequireCount(message.n_distortion, kMostDistortion);
  CameraCalibration calibration;
  calibration.time = ToTimestamp(message.utime);
  calibration.camera = Text(message.camera);
  calibration.width_px = message.width_px;
  calibration.height_px = message.height_px;
  calibration.distortion_model = ToModel(message.distortion_model);
  for (const double value : message.distortion)
    calibration.distortion.push_back(Within(value, geometry::kLargestCoefficient));
  calibration.focal_px = ToVector<2>(message.focal_px, geometry::kFarthestLens_px);
  calibration.principal_point_px =
      ToVector<2>(message.principal_point_px, geometry::kFarthestLens_px);
  const auto rectification = ToVector<9>(message.rectification, 1.0 + geometry::kRotationTolerance);
  calibration.rectification = Eigen::Map<const RowMajor3d>(rectification.data());
  calibration.is_calibrated = message.is_calibrated != 0;
  if (message.has_mount != 0) {
    const transform_t& mount = message.parent_from_camera;
    calibration.parent_frame = Text(message.parent_frame);
    calibration.parent_from_camera = ToTransform(mount.translation_m, mount.rotation_wxyz);
  }
  RequireSensible(calibration);
  return calibration;
}

camera_calibration_t FromCameraCalibration(const CameraCalibration& calibration,
                                           std::int64_t sequence) {
  camera_calibration_t message{};
  message.utime = calibration.time.microseconds;
  message.sequence = sequence;
  message.camera = calibration.camera;
  message.width_px = calibration.width_px;
  message.height_px = calibration.height_px;
  message.distortion_model = FromModel(calibration.distortion_model);
  for (const double value : calibration.distortion) message.distortion.push_back(Outgoing(value));
  message.n_distortion = static_cast<std::int32_t>(message.distortion.size());
  FromVector(calibration.focal_px, message.focal_px);
  FromVector(calibration.principal_point_px, message.principal_point_px);
  const RowMajor3d rectification = calibration.rectification;
  FromVector(Eigen::Map<const Eigen::Matrix<double, 9, 1>>(rectification.data()),
             message.rectification);
  message.is_calibrated = calibration.is_calibrated;
  FromMount(calibration, message);
  return message;
}

Decoded<CameraCalibration> Codec<CameraCalibration>::Decode(Bytes bytes) {
  const std::int64_t fingerprint = Fingerprint(bytes);
  if (fingerprint == stereo_calibration_t::getHash()) {
    const auto message = DecodeWire<stereo_calibration_t>(bytes);
    return {ToPublishedCamera(message), Count(message.sequence)};
  }
  if (fingerprint == sensor_msgs::CameraInfo::getHash()) {
    return {ToCameraCalibration(DecodeWire<sensor_msgs::CameraInfo>(bytes)), -1};
  }
  const auto message = DecodeWire<camera_calibration_t>(bytes);
  return {ToCameraCalibration(message), Count(message.sequence)};
}

std::vector<std::uint8_t> Codec<CameraCalibration>::Encode(const CameraCalibration& calibration,
                                                           std::int64_t sequence) {
  return EncodeWire(FromCameraCalibration(calibration, sequence));
}

}  // namespace deixis::messages
