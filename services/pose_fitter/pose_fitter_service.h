#pragma once
#include <optional>
#include <set>
#include <string>
#include <utility>

#include "common/images/stereo_image.h"
#include "common/transport/bus.h"
#include "common/transport/status_reporter.h"
#include "services/pose_fitter/core/pose_fitter.h"

namespace deixis::pose_fitter {

struct PoseFitterServiceConfig {
  std::string stereo_channel = "STEREO";                   ///< Depth comes from here.
  std::string calibration_channel = "STEREO_CALIBRATION";  ///< Its camera.
  std::string hands_channel = "HAND_TRACKS";               ///< Hands in its picture, if known.
  std::string objects_channel = "OBJECTS";                 ///< Faces likewise.
  std::string model_channel = "BODY_MODEL";                ///< Models of the people go here.
  std::string poses_channel = "BODY_POSES";                ///< One message per depth image.
  PoseFitterConfig fitter;

  template <typename Visitor>
  void Visit(Visitor& v) {
    v("stereo_channel", stereo_channel);
    v("calibration_channel", calibration_channel);
    v("hands_channel", hands_channel);
    v("objects_channel", objects_channel);
    v("model_channel", model_channel);
    v("poses_channel", poses_channel);
    v("fitter", fitter);
  }
  void Validate() const;
};

/// Answers every depth image with the poses of the people in it. What cannot be used is dropped and
/// counted: images before the calibration ("no_calibration"), of another view than it is for
/// ("depth_of_other_view"), and late or repeated ones ("late_image"), which leave those who are
/// followed as they are.
class PoseFitterService {
 public:
  /// Throws ConfigError when the body model cannot be had.
  PoseFitterService(const PoseFitterServiceConfig& config, transport::Bus& input,
                    transport::Bus& output);
  /// Says what is waited for.
  transport::Health health() const;

 private:
  void OnStereo(const images::StereoImage& stereo);
  void RequireUsable(const images::StereoImage& stereo) const;
  void PublishModels(Timestamp time);

  PoseFitterServiceConfig config_;
  transport::Bus& output_;
  PoseFitter fitter_;
  std::optional<geometry::StereoCalibration> calibration_;
  std::optional<Timestamp> last_time_;  ///< Of the last image that was used.
  std::optional<Timestamp> models_time_;
  std::set<std::pair<int, std::int64_t>> known_models_;  ///< Person and model, since then.
};

}  // namespace deixis::pose_fitter
