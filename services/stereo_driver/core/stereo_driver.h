#pragma once
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>

#include "common/capture/calibration.h"
#include "common/capture/calibration_schedule.h"
#include "common/capture/lens_wait.h"
#include "common/capture/pacer.h"
#include "common/images/stereo_image.h"
#include "services/stereo_driver/core/calibration/registration_calibration.h"
#include "services/stereo_driver/core/calibration/rig_calibration.h"
#include "services/stereo_driver/core/depth_camera/depth_camera.h"
#include "services/stereo_driver/core/matching/people/said_people.h"
#include "services/stereo_driver/core/matching/stereo_matcher.h"
#include "services/stereo_driver/core/sources/sources.h"

namespace deixis::stereo_driver {

/// Of a Kinect's colour camera.
inline capture::CalibrationConfig DepthCameraLensDefaults() {
  capture::CalibrationConfig config;
  config.horizontal_fov_deg = 57.0;
  config.key = "depth_camera.calibration";
  return config;
}

struct DepthCameraConfig {
  capture::CalibrationConfig calibration = DepthCameraLensDefaults();  ///< The colour lens.
  RegistrationConfig registration;     ///< Whether depth is seen from where colour is.
  double depth_sigma_m_at_1m = 0.003;  ///< Error of a distance at 1 m; grows with its square.

  template <typename Visitor>
  void Visit(Visitor& v) {
    v("calibration", calibration);
    v("registration", registration);
    v("depth_sigma_m_at_1m", depth_sigma_m_at_1m);
  }
  void Validate() const;  ///< Throws FaultsFound.
};

struct StereoDriverConfig {
  std::string camera = "STEREO";                ///< Name of the published picture in all messages.
  FrameSourceConfig source;                     ///< Where pairs, or colour and depth, come from.
  capture::Pace pace = capture::Pace::kByTime;  ///< How fast recordings are played.
  std::int64_t start_time_utime = -1;           ///< Recordings: see capture::Pacer.
  RigCalibrationConfig calibration;             ///< What is known of two cameras.
  StereoMatcherConfig matcher;                  ///< How pairs become depth.
  DepthCameraConfig depth_camera;  ///< What is known of a camera that measures depth itself.
  int jpeg_quality = 85;           ///< Of the published left picture, 1..100.
  int pair_jpeg_quality = 95;  ///< Of published pairs: matching again wants what was lost least.

  template <typename Visitor>
  void Visit(Visitor& v) {
    v("camera", camera);
    v("source", source);
    v("pace", pace);
    v("start_time_utime", start_time_utime);
    v("calibration", calibration);
    v("matcher", matcher);
    v("depth_camera", depth_camera);
    v("jpeg_quality", jpeg_quality);
    v("pair_jpeg_quality", pair_jpeg_quality);
  }
  void Check(config::Faults& faults) const;
  /// Whether it matters where people are.
  bool LooksForPeople() const;
};

/// A frame that cannot become a picture with depth, where others of its source may.
class UnusableFrame : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// What one frame has become.
struct StereoOutput {
  std::optional<geometry::StereoCalibration> calibration;  ///< To be published before the picture.
  std::optional<images::EncodedStereoPair> pair;           ///< As taken, when it was asked for.
  images::StereoImage stereo;  ///< `depth_mm` is the driver's memory: the next call overwrites it.
};

/// What one step of the driver has brought.
struct StereoStep {
  capture::SourceState state = capture::SourceState::kWaiting;
  std::optional<StereoOutput> output;  ///< Set with kPicture only.
};

/// Whether the pair as taken goes out beside the depth.
enum class KeepPairs { kNo, kYes };

/// Turns frames of a source, or of others, into rectified picture and depth with their calibration:
/// the calibration before the first one, once per second of picture time, and when the size
/// changes. Frames of a dimos robot wait for its lens, see capture::LensWait.
class StereoDriver {
 public:
  /// `source` may be nullptr: frames then come by Convert(). Reads the calibration files that its
  /// kind of frames needs; throws ConfigError.
  StereoDriver(const StereoDriverConfig& config, std::unique_ptr<FrameSource> source,
               KeepPairs keep_pairs);

  /// The next frame that is due at `now` (wall clock); never waits for a camera. What cannot be
  /// converted is counted.
  StereoStep Next(Timestamp now);

  /// Throws UnusableFrame when the pictures are too small or too large to be matched, or the
  /// calibration does not suit them.
  StereoOutput Convert(const images::StereoPair& pair);
  /// Throws UnusableFrame when the depth cannot cover the colour picture's view, or the calibration
  /// does not suit them.
  StereoOutput Convert(const images::RgbdImage& image);
  /// The same, but of an unusable frame nothing; it is counted.
  template <typename Images>
  std::optional<StereoOutput> TryConvert(const Images& images) {
    try {
      is_refusing_ = false;
      return Convert(images);
    } catch (const UnusableFrame& reason) {
      is_refusing_ = true;
      ++unusable_;
      last_unusable_ = reason.what();
      return std::nullopt;
    }
  }

  /// The colour camera's lens as somebody else says it; a calibration file goes before it.
  void UseLens(const geometry::CameraCalibration& lens);

  /// From now on the raw left camera, or the colour camera, is mounted like this; nothing = it is
  /// not known. Before the first call it is as in the configuration.
  void UseMount(const std::optional<geometry::CameraMount>& mount);

  /// Where people are, as a tracker says; counts with MatchSize::kPeople only.
  void Hear(const body_model::BodyPoses& poses) { people_.Hear(poses); }
  /// Poses in another picture or frame than what this driver publishes; they change nothing.
  std::int64_t poses_elsewhere() const { return people_.elsewhere(); }

  FrameSourceStatus status() const;
  /// What is wrong with the playing of a recording; empty when nothing is.
  std::string pace_trouble() const { return pacer_.trouble(); }
  /// What has to be known about the calibration; empty before the first frame and when it is as in
  /// its files.
  const std::string& calibration_remark() const { return remark_; }
  /// What is wrong between what the sensor says of its last frame and what is configured, with the
  /// cure; empty when nothing is.
  const std::string& registration_fault() const { return registration_fault_; }

 private:
  capture::SourceState Fetch();
  bool IsDue(Timestamp now);
  std::optional<StereoOutput> ConvertAt(Timestamp time, Frame frame);
  void PrepareRig(cv::Size size);
  /// What is known of a camera at a size; throws UnusableFrame when that is nothing.
  template <typename Calibration>
  auto KnownFor(const Calibration& calibration, cv::Size size) -> decltype(calibration.For(size));
  void PrepareDepthCamera(cv::Size size, cv::Size depth_size);
  std::optional<DepthView> ViewOfDepth(cv::Size depth_size);
  StereoOutput Packed(const RectifiedDepth& depth, Timestamp time);
  std::optional<geometry::StereoCalibration> CalibrationIfDue(Timestamp time);

  StereoDriverConfig config_;
  std::unique_ptr<FrameSource> source_;
  KeepPairs keep_pairs_;
  capture::Pacer pacer_;
  bool is_live_ = true;
  std::optional<Frame> waiting_;  ///< Recorded frame whose time has not come.
  std::int64_t unusable_ = 0;     ///< Frames that could not be converted.
  std::string last_unusable_;     ///< Why the last of them could not.
  bool is_refusing_ = false;      ///< The last frame could not.

  std::optional<RigCalibration> rig_;                    ///< For pairs.
  cv::Size refused_size_;                                ///< Of pairs that cannot be matched.
  std::string refusal_;                                  ///< Why they cannot.
  std::optional<capture::Calibration> lens_;             ///< For colour and depth.
  std::optional<capture::LensWait> lens_wait_;           ///< Of cameras that say it themselves.
  std::optional<RegistrationCalibration> registration_;  ///< For depth of another view.
  geometry::StereoCalibration calibration_;              ///< Of the frames that come now.
  std::string remark_;
  std::string registration_fault_;
  std::optional<StereoMatcher> matcher_;
  SaidPeople people_;
  std::optional<DepthCamera> depth_camera_;
  cv::Size depth_camera_size_;  ///< Of its depth.
  std::optional<geometry::CameraMount> mount_;
  capture::CalibrationSchedule schedule_;
};

}  // namespace deixis::stereo_driver
