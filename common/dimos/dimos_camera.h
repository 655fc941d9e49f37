#pragma once
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "common/capture/calibration.h"
#include "common/capture/pushed_source.h"
#include "common/config/config.h"
#include "common/geometry/camera_calibration.h"
#include "common/geometry/camera_pose.h"
#include "common/geometry/transform_chain.h"
#include "common/transport/bus.h"

namespace deixis::dimos {

/// Where a dimos robot sends what its camera sees: channels as they are on the wire, no prefix goes
/// in front of them.
struct DimosCameraConfig {
  std::string image_channel = "/color_image#sensor_msgs.Image";      ///< Or CompressedImage.
  std::string info_channel = "/camera_info#sensor_msgs.CameraInfo";  ///< The lens.
  std::string tf_channel = "/tf#tf2_msgs.TFMessage";  ///< Transforms; empty = not followed.
  std::string camera_frame;  ///< Its optical frame there; empty = as pictures or lens name it.

  template <typename Visitor>
  void Visit(Visitor& v) {
    v("image_channel", image_channel);
    v("info_channel", info_channel);
    v("tf_channel", tf_channel);
    v("camera_frame", camera_frame);
  }
  void Validate() const;  ///< Throws FaultsFound; channels are judged with those of the service.
  /// Keys below `dimos` and channels in use, for transport::ChannelFaults.
  std::vector<std::pair<std::string, std::string>> Channels() const;
};

/// Hears a dimos robot's camera: its pictures, its lens, and where it is in the frame that it is
/// mounted in, by the robot's transforms.
class DimosCamera {
 public:
  struct Handlers {
    std::function<void(const geometry::CameraCalibration&)> lens;
    std::function<void(const geometry::CameraPose&)> pose;  ///< By transforms, as they come.
    std::function<void()> picture;  ///< One waits in the source. Called from within the bus.
  };

  /// `calibration` is the camera's; transforms are followed when its mount has a parent_frame.
  DimosCamera(DimosCameraConfig config, const capture::CalibrationConfig& calibration,
              Handlers handlers);

  /// Subscribes. The source gives the pictures, and must live as long as `input` is handled, as
  /// must this.
  std::unique_ptr<capture::PushedSource> Listen(transport::Bus& input);

  /// Why there are no poses; empty when there are, or none are asked for.
  std::string trouble() const;
  /// Whether poses are asked for, and somebody listens.
  bool follows_transforms() const { return chain_.has_value(); }

 private:
  void HearFrameOf(const images::Image& picture);
  void HearFrameOf(const geometry::CameraCalibration& lens);
  void Follow(transport::Bus& input);

  DimosCameraConfig config_;
  std::string parent_frame_;
  std::string calibration_key_;
  Handlers handlers_;
  std::optional<geometry::TransformChain> chain_;  ///< While transforms are followed.
  bool has_picture_named_frame_ = false;
};

}  // namespace deixis::dimos
