#include <algorithm>
#include <array>
#include <string_view>
#include <utility>

#include "common/geometry/lens_limits.h"
#include "common/messages/dimos_parts.h"
#include "common/messages/geometry_parts.h"

namespace deixis::messages {
namespace {

using geometry::CameraCalibration;
using geometry::DistortionModel;
using sensor_msgs::CameraInfo;
using RowMajor3d = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;

// Names of ROS (sensor_msgs/distortion_models.h).
constexpr std::array<std::pair<std::string_view, DistortionModel>, 4> kModels{{
    {"", DistortionModel::kNone},
    {"plumb_bob", DistortionModel::kPlumbBob},
    {"rational_polynomial", DistortionModel::kRational},
    {"equidistant", DistortionModel::kFisheye},
}};

DistortionModel ToModel(const CameraInfo& message) {
  for (const auto& [name, model] : kModels) {
    if (message.distortion_model != name) continue;
    return message.D.empty() ? DistortionModel::kNone : model;
  }
  throw Rejected("out_of_range");
}

// The lens is that of the full picture: a part of it, or one made smaller, has another.
void RequireWholePicture(const CameraInfo& message) {
  const auto is_one = [](std::int32_t binning) { return binning == 0 || binning == 1; };
  const auto is_whole = [](std::int32_t part, std::int32_t all) {
    return part == 0 || part == all;
  };
  const auto& roi = message.roi;
  const bool is_full = roi.x_offset == 0 && roi.y_offset == 0 &&
                       is_whole(roi.width, message.width) && is_whole(roi.height, message.height);
  if (!is_one(message.binning_x) || !is_one(message.binning_y) || !is_full) {
    throw Rejected("unsupported_binning");
  }
}

void RequirePinhole(const double (&k)[9]) {
  const auto values = ToVector<9>(k, geometry::kFarthestLens_px);
  const bool is_pinhole = values[1] == 0.0 && values[3] == 0.0 && values[6] == 0.0 &&
                          values[7] == 0.0 && values[8] == 1.0;
  if (!is_pinhole) throw Rejected("out_of_range");
}

// All zeros: nobody has filled it in.
Eigen::Matrix3d ToRectification(const double (&r)[9]) {
  const auto values = ToVector<9>(r);
  if (values.isZero(0.0)) return Eigen::Matrix3d::Identity();
  return Eigen::Map<const RowMajor3d>(values.data());
}

}  // namespace

CameraCalibration ToCameraCalibration(const CameraInfo& message) {
  RequireCount(message.D_length, kMostDistortion);
  RequireWholePicture(message);
  RequirePinhole(message.K);
  CameraCalibration calibration;
  calibration.time = ToTimestamp(message.header.stamp);
  calibration.camera = Text(message.header.frame_id);
  calibration.width_px = message.width;
  calibration.height_px = message.height;
  calibration.distortion_model = ToModel(message);
  for (const double value : message.D) {
    calibration.distortion.push_back(Within(value, geometry::kLargestCoefficient));
  }
  calibration.focal_px = {message.K[0], message.K[4]};
  calibration.principal_point_px = {message.K[2], message.K[5]};
  calibration.rectification = ToRectification(message.R);
  calibration.is_calibrated = true;
  RequireSensible(calibration);
  return calibration;
}

}  // namespace deixis::messages
