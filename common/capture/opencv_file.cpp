#include "common/capture/opencv_file.h"

#include <algorithm>
#include <array>
#include <exception>
#include <utility>
#include <vector>

#include "common/capture/opencv_text.h"
#include "common/capture/regular_file.h"
#include "common/config/config.h"
#include "common/geometry/lens_limits.h"
#include "common/images/picture_size.h"
#include "common/text/number_text.h"
#include "common/text/size_text.h"

namespace deixis::capture {
namespace {

using geometry::CameraCalibration;
using geometry::DistortionModel;

constexpr std::size_t kPlumbBobValues = 5;
constexpr std::size_t kRationalValues = 8;

[[noreturn]] void FailIn(const std::string& path, const std::string& fault) {
  throw config::ConfigError(path + ": " + fault);
}

[[noreturn]] void FailToRead(const std::string& path, const FileContent& content,
                             const std::string& cure) {
  switch (content.fault) {
    case FileFault::kNoRegularFile:
      FailIn(path, "calibration file does not exist; " + cure);
    case FileFault::kTooLarge:
      FailIn(path, "has more than " + std::to_string(kLargestOpenCvFile >> 20U) +
                       " MB, as no calibration has; write it with OpenCV's calibration");
    case FileFault::kUnreadable:
    case FileFault::kNone:
      break;
  }
  FailIn(path, "calibration file cannot be read: " + content.reason + "; check its rights");
}

std::string ReadText(const std::string& path, const std::string& cure) {
  const FileContent content = ReadRegularFile(path, kLargestOpenCvFile);
  if (content.fault != FileFault::kNone) FailToRead(path, content, cure);
  std::string text(content.bytes.begin(), content.bytes.end());
  const std::string fault = OpenCvTextFault(text);
  if (!fault.empty()) FailIn(path, fault);
  return text;
}

cv::FileStorage OpenStorage(const std::string& path, const std::string& text) {
  try {
    // From memory: the text that was looked at, whatever becomes of the file.
    cv::FileStorage storage(text, cv::FileStorage::READ | cv::FileStorage::MEMORY);
    if (storage.isOpened()) return storage;
  } catch (const std::exception&) {
    // The one message below serves all; on some damage OpenCV throws what the library has thrown.
  }
  FailIn(
      path,
      "is cut, or not a YAML file of OpenCV (first line %YAML:1.0); write it with its calibration");
}

std::string Either(const std::string& key, const std::string& other_key) {
  return other_key.empty() ? key : key + " (or " + other_key + ")";
}

/// Of two dimensions; calibrations have no large ones.
bool IsSmallMatrix(const cv::FileNode& node) {
  constexpr int kLongestSide = 64;
  const auto is_side = [](const cv::FileNode& side) {
    return side.isInt() && static_cast<int>(side) > 0 && static_cast<int>(side) <= kLongestSide;
  };
  return node.isMap() && node["sizes"].empty() && is_side(node["rows"]) && is_side(node["cols"]);
}

/// Whether a number of more than nine digits is under `key`: OpenCV makes some int of it.
bool HasLongNumber(const std::string& text, const std::string& key) {
  constexpr std::size_t kMostDigits = 9;
  for (std::size_t at = text.find(key); at != std::string::npos; at = text.find(key, at + 1)) {
    const std::size_t begin = text.find_first_not_of("\": \t\r\n>+-0", at + key.size());
    const std::size_t end = std::min(text.find_first_not_of("0123456789", begin), text.size());
    if (begin != std::string::npos && end - begin > kMostDigits) return true;
  }
  return false;
}

void ReadPinhole(const OpenCvFile& file, const LensKeys& keys, CameraCalibration& calibration) {
  const cv::Mat matrix = file.Matrix(keys.matrix, keys.other_matrix);
  const std::string name = Either(keys.matrix, keys.other_matrix);
  if (matrix.rows != 3 || matrix.cols != 3) {
    file.Fail(name + " must be 3x3 but is " + text::SizeText(matrix.rows, matrix.cols));
  }
  calibration.focal_px = {matrix.at<double>(0, 0), matrix.at<double>(1, 1)};
  calibration.principal_point_px = {matrix.at<double>(0, 2), matrix.at<double>(1, 2)};
  RequirePinhole(file, name, calibration);
}

/// Those that OpenCV's models have: with thin prism 12, with tilt 14.
bool IsDistortionCount(std::size_t count) {
  static constexpr std::array<std::size_t, 5> kCounts{4, 5, 8, 12, 14};
  return std::find(kCounts.begin(), kCounts.end(), count) != kCounts.end();
}

/// `values` cut or filled to what the lens model takes; what is cut must be zero.
std::vector<double> FittedTo(std::size_t count, std::vector<double> values,
                             const OpenCvFile& file) {
  for (std::size_t i = count; i < values.size(); ++i) {
    if (values[i] != 0.0) {
      file.Fail("distortion has " + std::to_string(values.size()) +
                " values; calibrate with 5 or 8 (no thin prism, no tilt)");
    }
  }
  values.resize(count, 0.0);
  return values;
}

void ReadDistortion(const OpenCvFile& file, const LensKeys& keys, CameraCalibration& calibration) {
  const cv::Mat matrix = file.Matrix(keys.distortion, keys.other_distortion);
  std::vector<double> values(matrix.begin<double>(), matrix.end<double>());
  const std::string name = Either(keys.distortion, keys.other_distortion);
  const bool is_fisheye = file.IsFisheye();
  const bool is_vector = matrix.rows == 1 || matrix.cols == 1;
  if (!is_vector || !IsDistortionCount(values.size()) || (is_fisheye && values.size() != 4)) {
    file.Fail(name +
              " must be one row of 4, 5 or 8 values, or 12 or 14 that end in zeros (fisheye: 4)");
  }
  const bool is_plumb_bob = values.size() <= kPlumbBobValues;
  calibration.distortion_model = is_fisheye     ? DistortionModel::kFisheye
                                 : is_plumb_bob ? DistortionModel::kPlumbBob
                                                : DistortionModel::kRational;
  if (!is_fisheye) {
    values = FittedTo(is_plumb_bob ? kPlumbBobValues : kRationalValues, std::move(values), file);
  }
  calibration.distortion = std::move(values);
  if (!geometry::IsDistortion(calibration.distortion_model, calibration.distortion)) {
    file.Fail(name + " has a coefficient beyond " +
              text::NumberText(geometry::kLargestCoefficient) +
              ", which no lens has; calibrate again");
  }
}

}  // namespace

OpenCvFile::OpenCvFile(const std::string& path, const std::string& cure)
    : path_(path), text_(ReadText(path, cure)), storage_(OpenStorage(path, text_)) {}

void OpenCvFile::Fail(const std::string& fault) const { FailIn(path_, fault); }

cv::Mat OpenCvFile::Matrix(const std::string& key, const std::string& other_key) const {
  const std::string& found = Has(key) || other_key.empty() ? key : other_key;
  if (!Has(found)) {
    const std::string other = other_key.empty() ? "" : " (or '" + other_key + "')";
    Fail("key '" + key + "'" + other + " is missing; calibrate again or add it");
  }
  cv::Mat matrix;
  try {
    // Others do not come this far: OpenCV crashes on some with many dimensions.
    if (IsSmallMatrix(storage_[found])) storage_[found] >> matrix;
  } catch (const std::exception&) {
    matrix.release();
  }
  if (matrix.empty() || matrix.channels() != 1) {
    Fail("key '" + found + "' is not an opencv-matrix; calibrate again or correct it");
  }
  matrix.convertTo(matrix, CV_64F);
  if (!cv::checkRange(matrix)) Fail("key '" + found + "' has values that are not finite");
  return matrix;
}

int OpenCvFile::PixelCount(const std::string& key) const {
  const cv::FileNode node = storage_[key];
  const int count = node.isInt() && !HasLongNumber(text_, key) ? static_cast<int>(node) : 0;
  if (count < 1 || count > images::kLongestSide_px) {
    Fail("key '" + key + "' must be a whole number of pixels from 1 to " +
         std::to_string(images::kLongestSide_px) + "; correct it or calibrate again");
  }
  return count;
}

cv::Size OpenCvFile::ImageSize() const {
  if (!HasImageSize()) return {};
  for (const std::string key : {"image_width", "image_height"}) {
    if (!Has(key))
      Fail("key '" + key + "' is missing beside the other one; add it or take both away");
  }
  const cv::Size size(PixelCount("image_width"), PixelCount("image_height"));
  if (!images::IsPictureSize(size.width, size.height)) {
    Fail("image_width and image_height make more pixels than any camera has; correct them");
  }
  return size;
}

void RequirePinhole(const OpenCvFile& file, const std::string& name,
                    const CameraCalibration& lens) {
  const Eigen::Vector2d& focal_px = lens.focal_px;
  const Eigen::Vector2d& centre_px = lens.principal_point_px;
  if (!geometry::IsFocalLength(focal_px)) {
    file.Fail(name + " has the focal lengths " + text::NumberText(focal_px.x()) + " and " +
              text::NumberText(focal_px.y()) + " px, which are not between " +
              text::NumberText(geometry::kLeastFocal_px) + " and " +
              text::NumberText(geometry::kFarthestLens_px) + "; calibrate again");
  }
  if (!geometry::IsPrincipalPoint(centre_px)) {
    file.Fail(name + " has the principal point " + text::NumberText(centre_px.x()) + ", " +
              text::NumberText(centre_px.y()) + " px, which is further from the picture than " +
              text::NumberText(geometry::kFarthestLens_px) + "; calibrate again");
  }
}

CameraCalibration ReadLens(const OpenCvFile& file, const LensKeys& keys) {
  CameraCalibration calibration;
  ReadPinhole(file, keys, calibration);
  ReadDistortion(file, keys, calibration);
  calibration.is_calibrated = true;
  return calibration;
}

}  // namespace deixis::capture
