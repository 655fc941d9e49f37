#include "common/capture/mount.h"

#include <algorithm>
#include <cmath>

#include "common/config/plain_text.h"

namespace deixis::capture {
namespace {

constexpr double kUnitTolerance = 1e-3;
constexpr double kFarthest_m = 1e6;  // Receivers take nothing beyond.

bool IsPlace(const std::vector<double>& values_m) {
  return values_m.size() == 3 && std::all_of(values_m.begin(), values_m.end(), [](double value) {
           return std::abs(value) <= kFarthest_m;  // Not of NaN.
         });
}

Eigen::Quaterniond Quaternion(const std::vector<double>& wxyz) {
  return {wxyz.at(0), wxyz.at(1), wxyz.at(2), wxyz.at(3)};
}

bool IsUnit(const std::vector<double>& wxyz) {
  return wxyz.size() == 4 && std::abs(Quaternion(wxyz).norm() - 1.0) <= kUnitTolerance;
}

}  // namespace

void MountConfig::Validate() const {
  config::Faults faults;
  faults.Require(parent_frame.empty() || config::IsPlainText(parent_frame), "parent_frame",
                 std::string(config::kPlainTextRule) + ", or empty when the mount is not known");
  faults.Require(!parent_frame.empty() || IsIdentity(), "parent_frame",
                 "must name the robot's frame when translation_m or rotation_wxyz are given");
  faults.Require(IsPlace(translation_m), "translation_m",
                 "must be x y z, three finite numbers of metres, 1e6 at most");
  faults.Require(IsUnit(rotation_wxyz), "rotation_wxyz",
                 "must be a quaternion w x y z of length 1, to 0.001: [0.5, -0.5, 0.5, -0.5] for a "
                 "camera that looks ahead in a frame with x forward, y left, z up");
  faults.ThrowIfAny();
}

bool MountConfig::IsIdentity() const {
  const MountConfig none;
  return translation_m == none.translation_m && rotation_wxyz == none.rotation_wxyz;
}

std::optional<geometry::CameraMount> MountOf(const MountConfig& config) {
  if (config.parent_frame.empty()) return std::nullopt;
  const std::vector<double>& t = config.translation_m;
  return geometry::CameraMount{
      config.parent_frame,
      {Quaternion(config.rotation_wxyz).normalized(), {t.at(0), t.at(1), t.at(2)}}};
}

}  // namespace deixis::capture
