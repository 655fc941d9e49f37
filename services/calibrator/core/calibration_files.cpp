#include "services/calibrator/core/calibration_files.h"

#include <unistd.h>

#include <fstream>
#include <opencv2/core.hpp>
#include <stdexcept>

namespace deixis::calibrator {
namespace {
namespace fs = std::filesystem;

class Yaml {
 public:
  Yaml() : storage_(".yml", cv::FileStorage::WRITE | cv::FileStorage::MEMORY) {}

  template <typename T>
  void Add(const std::string& key, const T& value) {
    storage_ << key << value;
  }
  std::string Text() { return storage_.releaseAndGetString(); }

 private:
  cv::FileStorage storage_;
};

cv::Mat RowOf(const std::vector<double>& values) { return cv::Mat(values, true).reshape(1, 1); }

void AddSize(Yaml& yaml, const Lens& lens) {
  yaml.Add("image_width", lens.size.width);
  yaml.Add("image_height", lens.size.height);
}

void AddNotes(Yaml& yaml, const Notes& notes) {
  if (!notes.time.empty()) yaml.Add("calibration_time", notes.time);
  if (!notes.remark.empty()) yaml.Add("deixis_remark", "written all the same: " + notes.remark);
}

void AddModel(Yaml& yaml, const Lens& lens) {
  yaml.Add("fisheye_model", lens.model == LensModel::kFisheye ? 1 : 0);
}

fs::path UnfinishedName(const fs::path& path) {
  return path.string() + "." + std::to_string(getpid()) + ".part";
}

[[noreturn]] void Refuse(const fs::path& path, const std::string& why) {
  throw std::runtime_error(path.string() + " " + why);
}

void WriteUnfinished(const FileText& file) {
  std::ofstream out(UnfinishedName(file.path), std::ios::binary);
  out << file.text;
  out.close();
  if (!out) Refuse(file.path, "cannot be written: free some space, or name another file");
}

void RemoveUnfinished(const std::vector<FileText>& files) {
  std::error_code ignored;
  for (const FileText& file : files) fs::remove(UnfinishedName(file.path), ignored);
}

void RequireFolder(const fs::path& path) {
  std::error_code error;
  const fs::path folder = path.has_parent_path() ? path.parent_path() : fs::path(".");
  fs::create_directories(folder, error);
  if (!fs::is_directory(folder)) {
    Refuse(folder, "cannot be made: " + error.message() + "; name another folder");
  }
}

}  // namespace

std::string CameraYaml(const CameraCalibration& calibration, const Notes& notes) {
  const LensFit& fit = calibration.robust.fit;
  Yaml yaml;
  if (!notes.time.empty()) yaml.Add("calibration_time", notes.time);
  yaml.Add("nframes", static_cast<int>(calibration.robust.used.size()));
  AddSize(yaml, fit.lens);
  AddModel(yaml, fit.lens);
  yaml.Add("camera_matrix", cv::Mat(fit.lens.matrix));
  yaml.Add("distortion_coefficients", RowOf(fit.lens.distortion));
  yaml.Add("avg_reprojection_error", fit.error_px);
  if (!fit.deviations.empty()) yaml.Add("standard_deviations", RowOf(fit.deviations));
  if (!notes.remark.empty()) yaml.Add("deixis_remark", "written all the same: " + notes.remark);
  return yaml.Text();
}

std::string IntrinsicsYaml(const StereoCalibration& calibration, const Notes& notes) {
  const StereoFit& fit = calibration.fit;
  Yaml yaml;
  yaml.Add("M1", cv::Mat(fit.left.matrix));
  yaml.Add("D1", RowOf(fit.left.distortion));
  yaml.Add("M2", cv::Mat(fit.right.matrix));
  yaml.Add("D2", RowOf(fit.right.distortion));
  AddSize(yaml, fit.left);
  AddModel(yaml, fit.left);
  AddNotes(yaml, notes);
  return yaml.Text();
}

std::string ExtrinsicsYaml(const StereoCalibration& calibration, const Notes& notes) {
  const StereoFit& fit = calibration.fit;
  const Rectification& rectification = fit.rectification;
  Yaml yaml;
  yaml.Add("R", cv::Mat(fit.rotation));
  yaml.Add("T", cv::Mat(fit.translation_m));
  yaml.Add("R1", cv::Mat(rectification.left_rotation));
  yaml.Add("R2", cv::Mat(rectification.right_rotation));
  yaml.Add("P1", cv::Mat(rectification.left_projection));
  yaml.Add("P2", cv::Mat(rectification.right_projection));
  yaml.Add("Q", cv::Mat(rectification.disparity_to_depth));
  AddSize(yaml, fit.left);
  yaml.Add("avg_reprojection_error", fit.error_px);
  yaml.Add("avg_epipolar_error", calibration.rows_px.mean);
  AddNotes(yaml, notes);
  return yaml.Text();
}

void RequireWritable(const std::vector<fs::path>& paths, Existing existing) {
  for (const fs::path& path : paths) {
    std::error_code ignored;
    const bool is_there = fs::exists(path, ignored);
    if (is_there && !fs::is_regular_file(path)) Refuse(path, "is no file: name another --output");
    if (is_there && existing == Existing::kKeep) {
      Refuse(path, "is there already: name another --output, or give --force");
    }
    RequireFolder(path);
    // By trying: what the mode bits say holds neither for root nor for /proc.
    WriteUnfinished({path, ""});
    RemoveUnfinished({{path, ""}});
  }
}

void WriteTogether(const std::vector<FileText>& files) {
  try {
    for (const FileText& file : files) WriteUnfinished(file);
    for (const FileText& file : files) fs::rename(UnfinishedName(file.path), file.path);
  } catch (const std::exception&) {
    RemoveUnfinished(files);
    throw;
  }
}

}  // namespace deixis::calibrator
