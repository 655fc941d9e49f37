#include "common/messages/stereo_calibration.h"

#include <deixis/stereo_calibration_t.hpp>
#include <utility>

#include "common/messages/geometry_parts.h"

namespace deixis::messages {
namespace {

using geometry::StereoCalibration;

// Beyond these no sensor is worth listening to.
constexpr double kLargestSigma_px = 100.0;
constexpr double kLargestSigma_m = 10.0;

double Sigma(double value, double largest) {
  if (!(Finite(value) >= 0.0 && value <= largest)) throw Rejected("out_of_range");
  return value;
}

}  // namespace

Decoded<StereoCalibration> Codec<StereoCalibration>::Decode(Bytes bytes) {
  const auto message = DecodeWire<stereo_calibration_t>(bytes);
  StereoCalibration calibration;
  calibration.time = ToTimestamp(message.utime);
  calibration.camera = Text(message.camera);
  calibration.left = ToCameraCalibration(message.left);
  calibration.right = ToCameraCalibration(message.right);
  calibration.rectified = ToCameraCalibration(message.rectified);
  calibration.right_from_left =
      ToTransform(message.right_from_left.translation_m, message.right_from_left.rotation_wxyz);
  calibration.disparity_sigma_px = Sigma(message.disparity_sigma_px, kLargestSigma_px);
  calibration.depth_sigma_m_at_1m = Sigma(message.depth_sigma_m_at_1m, kLargestSigma_m);
  return {std::move(calibration), Count(message.sequence)};
}

std::vector<std::uint8_t> Codec<StereoCalibration>::Encode(const StereoCalibration& calibration,
                                                           std::int64_t sequence) {
  stereo_calibration_t message{};
  message.utime = calibration.time.microseconds;
  message.sequence = sequence;
  message.camera = calibration.camera;
  message.left = FromCameraCalibration(calibration.left, sequence);
  message.right = FromCameraCalibration(calibration.right, sequence);
  message.rectified = FromCameraCalibration(calibration.rectified, sequence);
  FromTransform(calibration.right_from_left, message.right_from_left.translation_m,
                message.right_from_left.rotation_wxyz);
  message.disparity_sigma_px = Outgoing(calibration.disparity_sigma_px);
  message.depth_sigma_m_at_1m = Outgoing(calibration.depth_sigma_m_at_1m);
  return EncodeWire(message);
}

}  // namespace deixis::messages
