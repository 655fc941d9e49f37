#include "common/capture/calibration.h"

#include <cerrno>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <opencv2/core.hpp>

namespace deixis::capture {
namespace {

using geometry::CameraCalibration;
using geometry::DistortionModel;

constexpr double kAspectTolerance = 0.01;
constexpr std::size_t kPlumbBobValues = 5;
constexpr std::size_t kRationalValues = 8;

[[noreturn]] void Fail(const std::string& path, const std::string& fault) {
  throw config::ConfigError(path + ": " + fault);
}

void RequireReadableFile(const std::string& path) {
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(path, ignored)) {
    Fail(path, "calibration file does not exist; set calibration.file, or leave it empty to guess");
  }
  errno = 0;
  std::ifstream file(path);
  file.peek();
  if (!file.is_open() || file.bad()) {
    Fail(path, std::string("calibration file cannot be read: ") + std::strerror(errno) +
                   "; check its rights");
  }
}

cv::FileStorage OpenStorage(const std::string& path) {
  RequireReadableFile(path);
  try {
    cv::FileStorage storage(path, cv::FileStorage::READ);
    if (storage.isOpened()) return storage;
  } catch (const cv::Exception&) {
    // The one message below serves both.
  }
  Fail(path, "is not a YAML file of OpenCV (first line %YAML:1.0); write it with its calibration");
}

/// The matrix under the first of two names that is there, as doubles.
cv::Mat ReadMatrix(const cv::FileStorage& storage, const std::string& path, const std::string& name,
                   const std::string& stereo_name) {
  const std::string key = storage[name].empty() ? stereo_name : name;
  if (storage[key].empty()) {
    Fail(path,
         "key '" + name + "' (or '" + stereo_name + "') is missing; calibrate again or add it");
  }
  cv::Mat matrix;
  try {
    storage[key] >> matrix;
  } catch (const cv::Exception&) {
    matrix.release();
  }
  if (matrix.empty() || matrix.channels() != 1) {
    Fail(path, "key '" + key + "' is not an opencv-matrix; calibrate again or correct it");
  }
  matrix.convertTo(matrix, CV_64F);
  if (!cv::checkRange(matrix)) Fail(path, "key '" + key + "' has values that are not finite");
  return matrix;
}

struct Pinhole {
  Eigen::Vector2d focal_px;
  Eigen::Vector2d principal_point_px;
};

Pinhole ToPinhole(const cv::Mat& matrix, const std::string& path) {
  if (matrix.rows != 3 || matrix.cols != 3) {
    Fail(path, "camera_matrix (or M1) must be 3x3 but is " + std::to_string(matrix.rows) + "x" +
                   std::to_string(matrix.cols));
  }
  const Pinhole pinhole{{matrix.at<double>(0, 0), matrix.at<double>(1, 1)},
                        {matrix.at<double>(0, 2), matrix.at<double>(1, 2)}};
  if (pinhole.focal_px.minCoeff() <= 0.0) {
    Fail(path, "camera_matrix (or M1) has a focal length that is not positive; calibrate again");
  }
  return pinhole;
}

/// `values` cut or filled to what the lens model takes; what is cut must be zero.
std::vector<double> FittedTo(std::size_t count, std::vector<double> values,
                             const std::string& path) {
  for (std::size_t i = count; i < values.size(); ++i) {
    if (values[i] != 0.0) {
      Fail(path, "distortion has " + std::to_string(values.size()) +
                     " values; calibrate with 5 or 8 (no thin prism, no tilt)");
    }
  }
  values.resize(count, 0.0);
  return values;
}

struct Distortion {
  DistortionModel model;
  std::vector<double> values;
};

/// OpenCV's two families of lenses.
enum class Lens { kPinhole, kFisheye };

Distortion ToDistortion(const cv::Mat& matrix, Lens lens, const std::string& path) {
  const std::vector<double> values(matrix.begin<double>(), matrix.end<double>());
  const bool is_fisheye = lens == Lens::kFisheye;
  const bool is_vector = matrix.rows == 1 || matrix.cols == 1;
  if (!is_vector || values.size() < 4 || (is_fisheye && values.size() != 4)) {
    Fail(path, "distortion_coefficients (or D1) must be one row of 4, 5 or 8 values (fisheye: 4)");
  }
  if (is_fisheye) return {DistortionModel::kFisheye, values};
  if (values.size() <= kPlumbBobValues) {
    return {DistortionModel::kPlumbBob, FittedTo(kPlumbBobValues, values, path)};
  }
  return {DistortionModel::kRational, FittedTo(kRationalValues, values, path)};
}

int ReadSize(const cv::FileStorage& storage, const std::string& path, const std::string& key) {
  const cv::FileNode node = storage[key];
  if (node.empty()) return 0;
  const int size = node.isInt() ? static_cast<int>(node) : 0;
  if (size <= 0) Fail(path, "key '" + key + "' must be a positive whole number of pixels");
  return size;
}

std::string Text(int width_px, int height_px) {
  return std::to_string(width_px) + "x" + std::to_string(height_px);
}

std::string Text(double value) {
  std::string text = std::to_string(value);
  text.erase(text.find_last_not_of('0') + 1);
  if (text.back() == '.') text.pop_back();
  return text;
}

CalibrationAnswer Guess(cv::Size size, double horizontal_fov_deg) {
  const double fov_rad = horizontal_fov_deg * M_PI / 180.0;
  return {geometry::GuessCalibration(size.width, size.height, fov_rad),
          "not calibrated: guessed from a horizontal field of view of " + Text(horizontal_fov_deg) +
              " deg; set calibration.file"};
}

// The origin is the centre of the top-left pixel, so a scaled picture's centres shift by half a
// pixel.
CameraCalibration Scaled(CameraCalibration calibration, cv::Size size) {
  const Eigen::Array2d scale(static_cast<double>(size.width) / calibration.width_px,
                             static_cast<double>(size.height) / calibration.height_px);
  calibration.focal_px.array() *= scale;
  calibration.principal_point_px =
      ((calibration.principal_point_px.array() + 0.5) * scale - 0.5).matrix();
  calibration.width_px = size.width;
  calibration.height_px = size.height;
  return calibration;
}

bool HasSameAspect(const CameraCalibration& calibration, cv::Size size) {
  const double ratio = static_cast<double>(size.width) * calibration.height_px /
                       (static_cast<double>(size.height) * calibration.width_px);
  return std::abs(ratio - 1.0) <= kAspectTolerance;
}

}  // namespace

void CalibrationConfig::Check(config::Faults& faults) const {
  faults.Require(horizontal_fov_deg > 0.0 && horizontal_fov_deg < 180.0,
                 "calibration.horizontal_fov_deg", "must lie between 0 and 180");
}

LensFile ReadLensFile(const std::string& path) {
  const cv::FileStorage storage = OpenStorage(path);
  LensFile lens;
  lens.path = path;
  CameraCalibration& calibration = lens.calibration;
  const Pinhole pinhole = ToPinhole(ReadMatrix(storage, path, "camera_matrix", "M1"), path);
  calibration.focal_px = pinhole.focal_px;
  calibration.principal_point_px = pinhole.principal_point_px;
  const bool is_fisheye = static_cast<int>(storage["fisheye_model"]) == 1;
  const Distortion distortion =
      ToDistortion(ReadMatrix(storage, path, "distortion_coefficients", "D1"),
                   is_fisheye ? Lens::kFisheye : Lens::kPinhole, path);
  calibration.distortion_model = distortion.model;
  calibration.distortion = distortion.values;
  calibration.width_px = ReadSize(storage, path, "image_width");
  calibration.height_px = ReadSize(storage, path, "image_height");
  calibration.is_calibrated = true;
  return lens;
}

Calibration::Calibration(const CalibrationConfig& config) : config_(config) {
  if (!config.file.empty()) lens_ = ReadLensFile(config::FindConfig(config.file).string());
}

CalibrationAnswer Calibration::For(cv::Size size) const {
  if (!lens_) return Guess(size, config_.horizontal_fov_deg);
  CameraCalibration calibration = lens_->calibration;
  if (calibration.width_px == 0 || calibration.height_px == 0) {
    calibration.width_px = size.width;
    calibration.height_px = size.height;
    return {calibration,
            "the calibration file states no image size: taken as that of the pictures"};
  }
  const std::string stated = Text(calibration.width_px, calibration.height_px);
  if (size == cv::Size(calibration.width_px, calibration.height_px)) return {calibration, ""};
  if (!HasSameAspect(calibration, size)) {
    Fail(lens_->path, "is for pictures of " + stated + " but they have " +
                          Text(size.width, size.height) +
                          ", another aspect; calibrate at this size or change the camera's");
  }
  return {Scaled(calibration, size), "calibration scaled from " + stated};
}

}  // namespace deixis::capture
