#include "common/dimos/dimos_camera.h"

#include "common/capture/system_clocks.h"
#include "common/config/plain_text.h"
#include "common/messages/camera_calibration.h"
#include "common/messages/frame_transforms.h"
#include "common/messages/image.h"

namespace deixis::dimos {

using geometry::CameraCalibration;
using geometry::FrameTransforms;
using transport::Delivery;

void DimosCameraConfig::Validate() const {
  config::Faults faults;
  faults.Require(camera_frame.empty() || config::IsPlainText(camera_frame), "camera_frame",
                 std::string(config::kPlainTextRule) + ", or empty");
  faults.ThrowIfAny();
}

std::vector<std::pair<std::string, std::string>> DimosCameraConfig::Channels() const {
  std::vector<std::pair<std::string, std::string>> channels{{"dimos.image_channel", image_channel},
                                                            {"dimos.info_channel", info_channel}};
  if (!tf_channel.empty()) channels.emplace_back("dimos.tf_channel", tf_channel);
  return channels;
}

DimosCamera::DimosCamera(DimosCameraConfig config, const capture::CalibrationConfig& calibration,
                         Handlers handlers)
    : config_(std::move(config)),
      parent_frame_(calibration.mount.parent_frame),
      calibration_key_(calibration.key),
      handlers_(std::move(handlers)) {}

std::unique_ptr<capture::PushedSource> DimosCamera::Listen(transport::Bus& input) {
  auto source = std::make_unique<capture::PushedSource>(config_.image_channel,
                                                        capture::SystemClocks().monotonic);
  input.SubscribeForeign<images::Image>(
      config_.image_channel, Delivery::kLatest,
      [this, pictures = source.get()](const images::Image& picture) {
        HearFrameOf(picture);
        pictures->Push(picture);
        handlers_.picture();
      });
  input.SubscribeForeign<CameraCalibration>(config_.info_channel, Delivery::kLatest,
                                            [this](const CameraCalibration& lens) {
                                              HearFrameOf(lens);
                                              handlers_.lens(lens);
                                            });
  if (!parent_frame_.empty() && !config_.tf_channel.empty()) Follow(input);
  return source;
}

void DimosCamera::Follow(transport::Bus& input) {
  chain_.emplace(parent_frame_);
  chain_->SetCameraFrame(config_.camera_frame);
  input.SubscribeForeign<FrameTransforms>(config_.tf_channel, Delivery::kEvery,
                                          [this](const FrameTransforms& transforms) {
                                            if (const auto pose = chain_->Take(transforms))
                                              handlers_.pose(*pose);
                                          });
}

void DimosCamera::HearFrameOf(const images::Image& picture) {
  if (!chain_ || !config_.camera_frame.empty() || picture.camera.empty()) return;
  has_picture_named_frame_ = true;
  chain_->SetCameraFrame(picture.camera);
}

void DimosCamera::HearFrameOf(const CameraCalibration& lens) {
  const bool is_known = !config_.camera_frame.empty() || has_picture_named_frame_;
  if (chain_ && !is_known && !lens.camera.empty()) chain_->SetCameraFrame(lens.camera);
}

std::string DimosCamera::trouble() const {
  const std::string lacks = chain_ ? chain_->WhatLacks() : "";
  if (lacks.empty()) return "";
  return "no camera pose from '" + config_.tf_channel + "': " + lacks + "; see " +
         calibration_key_ + ".mount.parent_frame and dimos.camera_frame";
}

}  // namespace deixis::dimos
