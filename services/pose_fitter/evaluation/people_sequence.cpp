#include "services/pose_fitter/evaluation/people_sequence.h"

#include <cmath>
#include <cstdio>
#include <deque>
#include <fstream>
#include <map>
#include <opencv2/calib3d.hpp>
#include <opencv2/core/eigen.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "common/capture/opencv_file.h"
#include "common/config/config.h"
#include "common/images/stereo_image.h"
#include "common/messages/stereo_calibration.h"
#include "common/messages/stereo_image.h"
#include "common/transport/bus.h"

namespace deixis::pose_fitter {
namespace {

namespace fs = std::filesystem;

constexpr int kLooseObject = 9;
constexpr int kPerPerson = 10;          // Parts of the second person are this much higher.
constexpr double kTrueNoise_m = 0.001;  // Depth is rounded to this.
constexpr double kSameTime_s = 0.003;

std::string NameOf(int number) {
  char name[16];
  std::snprintf(name, sizeof(name), "%06d.png", number);
  return name;
}

cv::Mat ReadPicture(const fs::path& path, int type) {
  const cv::Mat picture = cv::imread(path.string(), cv::IMREAD_UNCHANGED);
  if (picture.empty() || picture.type() != type) {
    throw config::ConfigError(path.string() + ": cannot be read as a picture of its kind");
  }
  return picture;
}

/// Times of the frames that have a truth, by their number.
std::map<int, double> TimesOfTruth(const fs::path& folder) {
  std::ifstream file(folder / "frames.csv");
  std::map<int, double> times_s;
  std::string line;
  std::getline(file, line);
  while (std::getline(file, line)) {
    int number = 0;
    double time_s = 0.0;
    if (std::sscanf(line.c_str(), "%d,%lf", &number, &time_s) != 2) continue;
    const std::string name = NameOf(number);
    if (fs::exists(folder / "depth" / name) && fs::exists(folder / "mask" / name)) {
      times_s[number] = time_s;
    }
  }
  if (times_s.empty()) {
    throw config::ConfigError(folder.string() +
                              ": frames.csv names no frame with depth/NNNNNN.png and "
                              "mask/NNNNNN.png");
  }
  return times_s;
}

cv::Mat WhoIs(const cv::Mat& mask) {
  cv::Mat person(mask.size(), CV_8UC1);
  std::transform(mask.begin<std::uint8_t>(), mask.end<std::uint8_t>(), person.begin<std::uint8_t>(),
                 [](int part) {
                   const bool is_person = part != 0 && part % kPerPerson != kLooseObject;
                   return static_cast<std::uint8_t>(is_person ? 1 + part / kPerPerson : 0);
                 });
  return person;
}

geometry::StereoCalibration ReadCalibration(const fs::path& folder) {
  const capture::OpenCvFile intrinsics((folder / "intrinsics.yml").string(), "give a sequence");
  const capture::OpenCvFile extrinsics((folder / "extrinsics.yml").string(), "give a sequence");
  geometry::StereoCalibration calibration;
  calibration.left = ReadLens(intrinsics, {"M1", "", "D1", ""});
  cv::cv2eigen(extrinsics.Matrix("R1"), calibration.left.rectification);
  const cv::Mat projection = extrinsics.Matrix("P1");
  calibration.rectified.focal_px = {projection.at<double>(0, 0), projection.at<double>(1, 1)};
  calibration.rectified.principal_point_px = {projection.at<double>(0, 2),
                                              projection.at<double>(1, 2)};
  const cv::Mat room = ReadPicture(folder / "depth" / "room.png", CV_16UC1);
  for (auto* lens : {&calibration.left, &calibration.rectified}) {
    lens->width_px = room.cols;
    lens->height_px = room.rows;
  }
  return calibration;
}

cv::Mat MatrixOf(const Eigen::Vector2d& focal_px, const Eigen::Vector2d& centre_px) {
  return (cv::Mat_<double>(3, 3) << focal_px.x(), 0, centre_px.x(), 0, focal_px.y(), centre_px.y(),
          0, 0, 1);
}

}  // namespace

/// What the raw left camera truly saw, brought into a rectified one.
struct PeopleSequence::Truth {
  explicit Truth(const fs::path& sequence)
      : folder(sequence),
        times_s(TimesOfTruth(sequence)),
        room_mm(ReadPicture(sequence / "depth" / "room.png", CV_16UC1)) {
    const capture::OpenCvFile world((folder / "camera_world.yml").string(), "give a sequence");
    const cv::Mat plane = world.Matrix("floor_plane_cam");
    floor = {{plane.at<double>(0), plane.at<double>(1), plane.at<double>(2)}, plane.at<double>(3)};
  }

  void Fill(int number, const geometry::StereoCalibration& calibration, PeopleFrame& frame) const {
    cv::Mat raw_mm = ReadPicture(folder / "depth" / NameOf(number), CV_16UC1);
    room_mm.copyTo(raw_mm, raw_mm == 0);
    const cv::Mat who = WhoIs(ReadPicture(folder / "mask" / NameOf(number), CV_8UC1));
    const DepthCamera& camera = frame.camera;
    cv::Mat rectification, columns, rows;
    cv::eigen2cv(calibration.left.rectification, rectification);
    cv::initUndistortRectifyMap(
        MatrixOf(calibration.left.focal_px, calibration.left.principal_point_px),
        calibration.left.distortion, rectification, MatrixOf(camera.focal_px, camera.centre_px),
        {camera.width_px, camera.height_px}, CV_32FC1, columns, rows);
    cv::remap(raw_mm, frame.true_mm, columns, rows, cv::INTER_NEAREST);
    cv::remap(who, frame.person, columns, rows, cv::INTER_NEAREST);
    const Eigen::Vector3d raw_axis = calibration.left.rectification.col(2);
    for (int v = 0; v < camera.height_px; ++v) {
      for (int u = 0; u < camera.width_px; ++u) {
        auto& z_mm = frame.true_mm.at<std::uint16_t>(v, u);
        z_mm = cv::saturate_cast<std::uint16_t>(z_mm / raw_axis.dot(camera.Ray(u, v)));
      }
    }
    frame.floor = {calibration.left.rectification * floor.normal, floor.offset_m};
    frame.has_truth = true;
  }

  fs::path folder;
  std::map<int, double> times_s;
  cv::Mat room_mm;
  body_model::Floor floor;  ///< In the raw left camera.
};

/// STEREO of a log.
class PeopleSequence::Recording {
 public:
  explicit Recording(const fs::path& log) : bus_(Options(log)) {
    bus_.Subscribe<images::StereoImage>(
        "STEREO", transport::Delivery::kEvery,
        [this](const images::StereoImage& image) { images_.push_back(image); });
    bus_.Subscribe<geometry::StereoCalibration>(
        "STEREO_CALIBRATION", transport::Delivery::kEvery,
        [this](const geometry::StereoCalibration& calibration) { calibration_ = calibration; });
  }

  std::optional<images::StereoImage> Next() {
    while (images_.empty() && !bus_.is_exhausted()) bus_.Handle(std::chrono::milliseconds(100));
    if (images_.empty()) return std::nullopt;
    auto image = images_.front();
    images_.pop_front();
    return image;
  }
  const std::optional<geometry::StereoCalibration>& calibration() const { return calibration_; }

 private:
  static transport::BusOptions Options(const fs::path& log) {
    if (!fs::is_regular_file(log)) throw config::ConfigError(log.string() + ": no such log");
    transport::BusOptions options;
    options.url = "file://" + log.string() + "?speed=0";
    options.deliver_every_message = true;
    return options;
  }

  transport::Bus bus_;
  std::deque<images::StereoImage> images_;
  std::optional<geometry::StereoCalibration> calibration_;
};

PeopleSequence::PeopleSequence(const fs::path& folder, const fs::path& log, int width_px)
    : truth_(std::make_unique<Truth>(folder)), width_px_(width_px) {
  if (!log.empty()) {
    recording_ = std::make_unique<Recording>(log);
  } else {
    calibration_ = ReadCalibration(folder);
  }
}

PeopleSequence::~PeopleSequence() = default;

std::optional<PeopleFrame> PeopleSequence::Next() {
  return recording_ ? NextRecorded() : NextTrue();
}

std::optional<PeopleFrame> PeopleSequence::NextTrue() {
  if (next_ >= truth_->times_s.size()) return std::nullopt;
  const auto at = std::next(truth_->times_s.begin(), static_cast<std::ptrdiff_t>(next_++));
  PeopleFrame frame;
  frame.time_s = at->second;
  frame.camera = DepthCameraOf(calibration_, {width_px_, width_px_ * calibration_.left.height_px /
                                                             calibration_.left.width_px});
  frame.camera.noise = {kTrueNoise_m, 0.0};
  truth_->Fill(at->first, calibration_, frame);
  frame.depth_mm = frame.true_mm.clone();
  return frame;
}

std::optional<PeopleFrame> PeopleSequence::NextRecorded() {
  const auto image = recording_->Next();
  if (!image) return std::nullopt;
  if (!recording_->calibration()) {
    throw config::ConfigError("the log has no STEREO_CALIBRATION before its first picture");
  }
  PeopleFrame frame;
  frame.time_s = 1e-6 * static_cast<double>(image->left.time.microseconds);
  frame.camera = DepthCameraOf(*recording_->calibration(), image->depth_mm.size());
  frame.depth_mm = image->depth_mm;
  for (const auto& [number, time_s] : truth_->times_s) {
    if (std::abs(time_s - frame.time_s) < kSameTime_s) {
      truth_->Fill(number, *recording_->calibration(), frame);
    }
  }
  return frame;
}

}  // namespace deixis::pose_fitter
