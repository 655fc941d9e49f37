#include "services/camera_driver/camera_driver_service.h"

#include <opencv2/core/utils/logger.hpp>

#include "common/capture/pushed_source.h"
#include "common/capture/system_clocks.h"
#include "common/logging/log.h"
#include "common/messages/camera_calibration.h"
#include "common/messages/image.h"
#include "common/program/source_step.h"
#include "common/transport/channel_name.h"

namespace deixis::camera_driver {
namespace {

// OpenCV would say a page on every way in which it failed to open something; ours is one line.
std::unique_ptr<capture::Source> OpenQuietly(const capture::LoopableSourceConfig& config) {
  cv::utils::logging::setLogLevel(cv::utils::logging::LOG_LEVEL_SILENT);
  return capture::MakeSource(config, capture::SystemClocks());
}

void Append(const std::string& part, std::string& text) {
  if (!part.empty()) text += (text.empty() ? "" : "; ") + part;
}

}  // namespace

void CameraDriverServiceConfig::Validate() const {
  config::Faults faults;
  const auto channel_faults =
      transport::ChannelFaults({{"image_channel", image_channel},
                                {"calibration_channel", calibration_channel},
                                {"dimos.image_channel", dimos.image_channel},
                                {"dimos.info_channel", dimos.info_channel}});
  for (const auto& [key, fault] : channel_faults) faults.Require(false, key, fault);
  driver.Check(faults);
  faults.ThrowIfAny();
}

CameraDriverService::CameraDriverService(const CameraDriverServiceConfig& config,
                                         transport::Bus& input, transport::Bus& output)
    : config_(config),
      output_(output),
      clock_(capture::SystemClocks()),
      driver_(config.driver, SourceOf(config, input)) {}

std::unique_ptr<capture::Source> CameraDriverService::SourceOf(
    const CameraDriverServiceConfig& config, transport::Bus& input) {
  if (config.driver.source.kind != capture::SourceKind::kDimos) {
    return OpenQuietly(config.driver.source);
  }
  auto source = std::make_unique<capture::PushedSource>(config.dimos.image_channel,
                                                        capture::SystemClocks().monotonic);
  input.SubscribeForeign<images::Image>(
      config.dimos.image_channel, transport::Delivery::kLatest,
      [pictures = source.get()](const images::Image& image) { pictures->Push(image); });
  input.SubscribeForeign<geometry::CameraCalibration>(
      config.dimos.info_channel, transport::Delivery::kLatest,
      [this](const geometry::CameraCalibration& lens) { driver_.UseLens(lens); });
  return source;
}

program::StepResult CameraDriverService::Step() {
  const DriverOutput step = driver_.Next(clock_.Now());
  Publish(step);
  LogNews();
  if (step.state == capture::SourceState::kFinished) LogSummary();
  return program::ResultOf(step.state);
}

void CameraDriverService::Publish(const DriverOutput& step) {
  if (step.calibration) output_.Publish(config_.calibration_channel, *step.calibration);
  if (!step.picture) return;
  output_.Publish(config_.image_channel, *step.picture);
  ++published_;
}

void CameraDriverService::LogSummary() const {
  const capture::SourceStatus status = driver_.status();
  if (published_ == 0) {
    throw config::ConfigError("no picture of '" + config_.driver.source.path + "' can be read (" +
                              std::to_string(status.corrupt) +
                              " tried); set source.path to pictures that OpenCV can read");
  }
  if (status.corrupt == 0) {
    logging::Info("recording_finished", {{"published", published_}});
    return;
  }
  logging::Warn("recording_finished", {{"published", published_},
                                       {"unreadable", status.corrupt},
                                       {"last_unreadable", status.last_corrupt}});
}

void CameraDriverService::LogNews() {
  const std::string& remark = driver_.calibration_remark();
  if (remark != logged_remark_) logging::Info("calibration", {{"remark", remark}});
  logged_remark_ = remark;
  const std::string trouble = driver_.status().trouble;
  if (trouble.empty() == logged_trouble_.empty()) return;
  if (trouble.empty()) logging::Info("source_recovered");
  if (!trouble.empty()) logging::Warn("source_lost", {{"reason", trouble}});
  logged_trouble_ = trouble;
}

transport::Health CameraDriverService::health() const {
  const capture::SourceStatus status = driver_.status();
  transport::Health health;
  health.is_degraded = !status.trouble.empty();
  Append(status.trouble, health.text);
  Append(driver_.calibration_remark(), health.text);
  if (status.corrupt > 0) Append(std::to_string(status.corrupt) + " corrupt pictures", health.text);
  if (status.skipped > 0) Append(std::to_string(status.skipped) + " skipped pictures", health.text);
  return health;
}

}  // namespace deixis::camera_driver
