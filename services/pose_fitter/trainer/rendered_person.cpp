#include "services/pose_fitter/trainer/rendered_person.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cstdio>
#include <fstream>
#include <opencv2/calib3d.hpp>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <optional>
#include <sstream>

#include "common/config/config.h"

namespace deixis::pose_fitter {
namespace {

namespace fs = std::filesystem;
using Eigen::Vector3d;

constexpr int kFirstPart = 1, kLastPart = 7;  // 9: loose objects; from 10 on: other people.
constexpr double kLargestStep_m = 0.05;       // Between neighbouring pixels of one surface.

[[noreturn]] void Fail(const fs::path& file, const std::string& fault) {
  throw config::ConfigError(file.string() + ": " + fault);
}

std::ifstream Open(const fs::path& file) {
  std::ifstream in(file);
  if (!in) Fail(file, "cannot be read");
  return in;
}

std::map<std::string, std::string> ReadPairs(const fs::path& file) {
  std::ifstream in = Open(file);
  std::map<std::string, std::string> pairs;
  for (std::string line; std::getline(in, line);) {
    const auto comma = line.find(',');
    if (comma != std::string::npos) pairs[line.substr(0, comma)] = line.substr(comma + 1);
  }
  return pairs;
}

double Number(const fs::path& file, const std::string& key, const std::string& text) {
  std::istringstream in(text);
  double value = 0.0;
  if (!(in >> value)) Fail(file, key + " is no number");
  return value;
}

void ReadWho(RenderedPerson& person) {
  const fs::path file = person.folder / "person.csv";
  for (const auto& [key, text] : ReadPairs(file)) {
    constexpr std::size_t kUnit = 3;  // _mm
    if (key == "id") person.id = text;
    if (key == "sex") {
      person.sex = text == "male" ? anthropometry::Sex::kMale : anthropometry::Sex::kFemale;
    }
    if (key.size() <= kUnit || key.substr(key.size() - kUnit) != "_mm") continue;
    person.lengths_m[key.substr(0, key.size() - kUnit)] = Number(file, key, text) / 1000.0;
  }
  if (person.id.empty()) Fail(file, "has no id");
  if (person.lengths_m.count("stature") == 0) Fail(file, "has no stature_mm");
  person.stature_m = person.lengths_m.at("stature");
}

void ReadJoints(RenderedPerson& person) {
  const fs::path file = person.folder / "joints.csv";
  std::ifstream in = Open(file);
  std::string line;
  std::getline(in, line);
  while (std::getline(in, line)) {
    std::replace(line.begin(), line.end(), ',', ' ');
    std::istringstream words(line);
    std::size_t frame = 0;
    double time_s = 0.0;
    std::string name;
    Vector3d place_m;
    if (!(words >> frame >> time_s >> name >> place_m.x() >> place_m.y() >> place_m.z())) {
      Fail(file, "cannot be understood: " + line);
    }
    if (frame > person.frames.size()) Fail(file, "skips a frame: " + line);
    if (frame == person.frames.size()) person.frames.emplace_back();
    person.frames[frame][name] = place_m;
  }
  if (person.frames.empty()) Fail(file, "has no frame");
}

cv::Mat ReadMatrix(const fs::path& file, const std::string& key) {
  cv::Mat matrix;
  try {
    cv::FileStorage(file.string(), cv::FileStorage::READ)[key] >> matrix;
  } catch (const cv::Exception& error) {
    Fail(file, error.err);
  }
  if (matrix.empty() || matrix.type() != CV_64F) Fail(file, "has no matrix " + key);
  return matrix;
}

void ReadCamera(RenderedPerson& person) {
  const fs::path lens = person.folder / "intrinsics.yml";
  const cv::Mat camera = ReadMatrix(lens, "M1");
  if (camera.size() != cv::Size(3, 3)) Fail(lens, "M1 is not 3 x 3");
  person.camera = cv::Matx33d(camera.ptr<double>());
  const cv::Mat distortion = ReadMatrix(lens, "D1");
  person.distortion.assign(distortion.begin<double>(), distortion.end<double>());
  const fs::path world = person.folder / "camera_world.yml";
  const cv::Mat floor = ReadMatrix(world, "floor_plane_cam");
  if (floor.total() != 4) Fail(world, "floor_plane_cam is not of four numbers");
  person.up = Vector3d(floor.ptr<double>()).normalized();
}

std::string PictureName(int frame) {
  char name[16];
  std::snprintf(name, sizeof(name), "%06d.png", frame);
  return name;
}

void FindDepthFrames(RenderedPerson& person) {
  for (int frame = 0; frame < static_cast<int>(person.frames.size()); ++frame) {
    const std::string name = PictureName(frame);
    if (fs::exists(person.folder / "depth" / name) && fs::exists(person.folder / "mask" / name)) {
      person.depth_frames.push_back(frame);
    }
  }
  if (person.depth_frames.empty()) Fail(person.folder, "no frame has both depth and mask");
}

cv::Mat ReadPicture(const fs::path& file, int type) {
  cv::Mat picture = cv::imread(file.string(), cv::IMREAD_UNCHANGED);
  if (picture.empty() || picture.type() != type) Fail(file, "is no picture of the right kind");
  return picture;
}

/// True depth of one frame where the person is seen.
class DepthPicture {
 public:
  DepthPicture(const RenderedPerson& person, int frame)
      : person_(person),
        depth_mm_(ReadPicture(person.folder / "depth" / PictureName(frame), CV_16UC1)),
        mask_(ReadPicture(person.folder / "mask" / PictureName(frame), CV_8UC1)) {}

  cv::Size size() const { return mask_.size(); }

  std::optional<SurfacePoint> At(int u, int v) const {
    const auto centre = Place(u, v);
    const auto left = Place(u - 1, v), right = Place(u + 1, v);
    const auto above = Place(u, v - 1), below = Place(u, v + 1);
    if (!centre || !left || !right || !above || !below) return std::nullopt;
    const Vector3d across = *right - *left, down = *below - *above;
    if (across.norm() > kLargestStep_m || down.norm() > kLargestStep_m) return std::nullopt;
    Vector3d normal = across.cross(down).normalized();
    if (normal.dot(*centre) > 0.0) normal = -normal;
    return SurfacePoint{*centre, normal, mask_.at<std::uint8_t>(v, u)};
  }

 private:
  std::optional<Vector3d> Place(int u, int v) const {
    const int part = mask_.at<std::uint8_t>(v, u);
    const double z_m = depth_mm_.at<std::uint16_t>(v, u) / 1000.0;
    if (part < kFirstPart || part > kLastPart || z_m == 0.0) return std::nullopt;
    std::vector<cv::Point2d> pixel{cv::Point2d(u, v)}, ray;
    cv::undistortPoints(pixel, ray, person_.camera, person_.distortion);
    return z_m * Vector3d(ray[0].x, ray[0].y, 1.0);
  }

  const RenderedPerson& person_;
  cv::Mat depth_mm_;
  cv::Mat mask_;
};

}  // namespace

RenderedPerson ReadRenderedPerson(const fs::path& folder) {
  RenderedPerson person;
  person.folder = folder;
  ReadWho(person);
  ReadJoints(person);
  ReadCamera(person);
  FindDepthFrames(person);
  return person;
}

std::vector<SurfacePoint> ReadSurface(const RenderedPerson& person, int frame, int step) {
  const DepthPicture picture(person, frame);
  std::vector<SurfacePoint> points;
  for (int v = step; v + 1 < picture.size().height; v += step) {
    for (int u = step; u + 1 < picture.size().width; u += step) {
      if (const auto point = picture.At(u, v)) points.push_back(*point);
    }
  }
  return points;
}

}  // namespace deixis::pose_fitter
