#include "services/stereo_driver/core/stereo_driver.h"

#include <opencv2/imgcodecs.hpp>
#include <utility>

#include "common/capture/picture_encoder.h"
#include "common/config/plain_text.h"
#include "common/text/size_text.h"

namespace deixis::stereo_driver {
namespace {

using capture::SourceState;

constexpr double kLargestDepthSigma_m = 1.0;

bool MeasuresDepth(FrameSourceKind kind) {
  return kind == FrameSourceKind::kColourAndDepth || kind == FrameSourceKind::kKinectChannel ||
         kind == FrameSourceKind::kDimos;
}

images::EncodedImage Encoded(const cv::Mat& bgr, Timestamp time, const std::string& camera,
                             int jpeg_quality) {
  capture::Picture picture;
  picture.bgr = bgr;
  capture::EncodingConfig config;
  config.jpeg_quality = jpeg_quality;
  return capture::Encode(picture, time, camera, config);
}

images::EncodedStereoPair Encoded(const images::StereoPair& pair,
                                  const StereoDriverConfig& config) {
  const int quality = config.pair_jpeg_quality;
  const Timestamp time = pair.left.time;
  return {Encoded(pair.left.bgr, time, config.camera + ".left", quality),
          Encoded(pair.right.bgr, time, config.camera + ".right", quality)};
}

void SetTime(Timestamp time, Frame& frame) {
  if (auto* pair = std::get_if<images::StereoPair>(&frame.images)) {
    pair->left.time = pair->right.time = time;
  } else {
    auto& image = std::get<images::RgbdImage>(frame.images);
    image.colour.time = image.depth.time = time;
  }
}

/// A depth camera, said as a pair of cameras: both are the colour camera. Its pictures are not
/// turned, whatever rectification the camera says of itself.
geometry::StereoCalibration AsStereo(geometry::CameraCalibration lens, double sigma_m) {
  lens.rectification.setIdentity();
  geometry::StereoCalibration calibration;
  calibration.left = calibration.right = calibration.rectified = std::move(lens);
  calibration.rectified.distortion_model = geometry::DistortionModel::kNone;
  calibration.rectified.distortion.clear();
  calibration.depth_sigma_m_at_1m = sigma_m;
  return calibration;
}

geometry::StereoCalibration Stamped(geometry::StereoCalibration calibration, Timestamp time,
                                    const std::string& camera) {
  calibration.time = calibration.left.time = calibration.right.time = calibration.rectified.time =
      time;
  calibration.camera = calibration.rectified.camera = camera;
  calibration.left.camera = camera + ".left";
  calibration.right.camera = camera + ".right";
  return calibration;
}

std::string Text(cv::Size size) { return text::SizeText(size.width, size.height); }

void RequireSameView(const images::RgbdImage& image) {
  const cv::Size depth = image.depth.depth_mm.size();
  const cv::Size picture = image.colour.bgr.size();
  if (images::MayCoverSameView(depth, picture)) return;
  throw UnusableFrame("depth of " + Text(depth) + " is of another aspect than its picture of " +
                      Text(picture));
}

capture::Calibration ColourLens(const capture::CalibrationConfig& config,
                                const std::optional<RegistrationCalibration>& registration) {
  if (!registration || !registration->colour_lens()) return capture::Calibration(config);
  return {config, *registration->colour_lens()};
}

bool IsOfSize(const geometry::StereoCalibration& calibration, cv::Size size) {
  return calibration.left.width_px == size.width && calibration.left.height_px == size.height;
}

}  // namespace

void DepthCameraConfig::Validate() const {
  config::Faults faults;
  faults.Require(depth_sigma_m_at_1m >= 0.0 && depth_sigma_m_at_1m <= kLargestDepthSigma_m,
                 "depth_sigma_m_at_1m", "must lie in 0..1 metres");
  calibration.Check(faults);
  const bool has_both_lenses =
      registration.mode == RegistrationMode::kExtrinsics && !registration.intrinsics.empty();
  faults.Require(calibration.file.empty() || !has_both_lenses, "calibration.file",
                 "must be empty when registration.intrinsics has the colour lens, too; or name "
                 "registration.depth_lens instead of that");
  faults.ThrowIfAny();
}

void StereoDriverConfig::Check(config::Faults& faults) const {
  faults.Require(config::IsPlainText(camera), "camera", config::kPlainTextRule);
  faults.Require(start_time_utime >= -1 && start_time_utime <= capture::kLatestTime.microseconds,
                 "start_time_utime",
                 "must be -1 (chosen by the pace) or a time in microseconds, 2^59 at most");
  source.Check(faults);
  faults.Require(MeasuresDepth(source.kind) || matcher.match_size != MatchSize::kHalf ||
                     matcher.depth_size == Size::kHalf,
                 "matcher.depth_size", "must be half when matcher.match_size is");
  faults.Require(jpeg_quality >= 1 && jpeg_quality <= 100, "jpeg_quality", "must lie in 1..100");
  faults.Require(pair_jpeg_quality >= 1 && pair_jpeg_quality <= 100, "pair_jpeg_quality",
                 "must lie in 1..100");
}

bool StereoDriverConfig::LooksForPeople() const {
  return !MeasuresDepth(source.kind) && matcher.match_size == MatchSize::kPeople;
}

StereoDriver::StereoDriver(const StereoDriverConfig& config, std::unique_ptr<FrameSource> source,
                           KeepPairs keep_pairs)
    : config_(config),
      source_(std::move(source)),
      keep_pairs_(keep_pairs),
      pacer_(config.pace, config.start_time_utime),
      people_(config.matcher.people, config.camera) {
  if (source_) is_live_ = source_->status().pictures.is_live;
  if (MeasuresDepth(config.source.kind)) {
    const DepthCameraConfig& depth_camera = config.depth_camera;
    if (depth_camera.registration.mode == RegistrationMode::kExtrinsics) {
      registration_.emplace(depth_camera.registration);
    }
    lens_.emplace(ColourLens(depth_camera.calibration, registration_));
    if (config.source.kind == FrameSourceKind::kDimos) lens_wait_.emplace();
    mount_ = capture::MountOf(depth_camera.calibration.mount);
  } else {
    rig_.emplace(config.calibration);
    mount_ = capture::MountOf(config.calibration.mount);
  }
}

StereoStep StereoDriver::Next(Timestamp now) {
  StereoStep step;
  if (!source_) return step;
  step.state = Fetch();
  if (!waiting_) return step;
  if (!IsDue(now)) {
    step.state = SourceState::kWaiting;
    return step;
  }
  const Timestamp time = is_live_ ? waiting_->time : pacer_.CaptureTime(waiting_->time);
  Frame frame = std::move(*waiting_);
  waiting_.reset();  // Whatever comes of it, it is not tried again.
  const bool is_held = lens_wait_ && lens_wait_->Holds(*lens_, time);
  if (!is_held) step.output = ConvertAt(time, std::move(frame));
  if (!step.output) step.state = SourceState::kWaiting;
  return step;
}

SourceState StereoDriver::Fetch() {
  if (waiting_) return SourceState::kPicture;
  FrameGrab grab = source_->Next();
  waiting_ = std::move(grab.frame);
  return grab.state;
}

bool StereoDriver::IsDue(Timestamp now) { return is_live_ || pacer_.IsDue(waiting_->time, now); }

std::optional<StereoOutput> StereoDriver::ConvertAt(Timestamp time, Frame frame) {
  SetTime(time, frame);
  return std::visit([this](const auto& images) { return TryConvert(images); }, frame.images);
}

StereoOutput StereoDriver::Convert(const images::StereoPair& pair) {
  PrepareRig(pair.left.bgr.size());
  const Windows people = people_.At(pair.left.time, calibration_.rectified);
  StereoOutput output = Packed(matcher_->Measure(pair, people), pair.left.time);
  if (keep_pairs_ == KeepPairs::kYes) output.pair = Encoded(pair, config_);
  return output;
}

StereoOutput StereoDriver::Convert(const images::RgbdImage& image) {
  if (!registration_) RequireSameView(image);
  PrepareDepthCamera(image.colour.bgr.size(), image.depth.depth_mm.size());
  // The other sources do not know.
  if (config_.source.kind == FrameSourceKind::kKinectChannel) {
    registration_fault_ =
        RegistrationFault(config_.depth_camera.registration.mode, image.is_registered);
  }
  return Packed(depth_camera_->Rectify(image), image.colour.time);
}

void StereoDriver::PrepareRig(cv::Size size) {
  if (matcher_ && IsOfSize(calibration_, size)) return;
  if (refused_size_ == size) throw UnusableFrame(refusal_);
  refused_size_ = size;  // Until all has gone well.
  auto [calibration, remark] = KnownFor(*rig_, size);
  refusal_ = MatchingFault(config_.matcher, calibration);
  if (!refusal_.empty()) throw UnusableFrame(refusal_);
  refused_size_ = {};
  matcher_.emplace(config_.matcher, calibration);
  calibration_ = std::move(calibration);
  remark_ = std::move(remark);
  schedule_.BeginAnew();
}

template <typename Calibration>
auto StereoDriver::KnownFor(const Calibration& calibration, cv::Size size)
    -> decltype(calibration.For(size)) {
  try {
    return calibration.For(size);
  } catch (const config::ConfigError& fault) {
    refusal_ = fault.what();
    throw UnusableFrame(refusal_);
  }
}

void StereoDriver::UseLens(const geometry::CameraCalibration& lens) {
  if (lens_ && lens_->UseOwn(lens)) depth_camera_.reset();
}

void StereoDriver::UseMount(const std::optional<geometry::CameraMount>& mount) {
  if (mount_.has_value() != mount.has_value()) schedule_.BeginAnew();
  mount_ = mount;
}

void StereoDriver::PrepareDepthCamera(cv::Size size, cv::Size depth_size) {
  const bool is_same = depth_camera_size_ == depth_size || !registration_;
  if (depth_camera_ && IsOfSize(calibration_, size) && is_same) return;
  depth_camera_.reset();
  auto [lens, remark] = KnownFor(*lens_, size);
  remark_ = std::move(remark);
  calibration_ = AsStereo(std::move(lens), config_.depth_camera.depth_sigma_m_at_1m);
  depth_camera_.emplace(calibration_, config_.matcher.depth_size, ViewOfDepth(depth_size));
  depth_camera_size_ = depth_size;
  schedule_.BeginAnew();
}

std::optional<DepthView> StereoDriver::ViewOfDepth(cv::Size depth_size) {
  if (!registration_) return std::nullopt;
  auto [view, remark] = registration_->For(depth_size);
  if (!remark.empty()) remark_ += (remark_.empty() ? "" : "; ") + remark;
  return std::move(view);
}

StereoOutput StereoDriver::Packed(const RectifiedDepth& depth, Timestamp time) {
  StereoOutput output;
  output.calibration = CalibrationIfDue(time);
  output.stereo.left = Encoded(depth.left_bgr, time, config_.camera, config_.jpeg_quality);
  output.stereo.depth_mm = depth.depth_mm;
  return output;
}

std::optional<geometry::StereoCalibration> StereoDriver::CalibrationIfDue(Timestamp time) {
  if (!schedule_.IsDue(time)) return std::nullopt;
  schedule_.NoteSent(time);
  geometry::StereoCalibration calibration = Stamped(calibration_, time, config_.camera);
  return mount_ ? Mounted(std::move(calibration), *mount_) : calibration;
}

FrameSourceStatus StereoDriver::status() const {
  FrameSourceStatus status;
  status.pictures.is_live = true;
  if (source_) status = source_->status();
  if (lens_wait_) status.pictures.skipped += lens_wait_->held_back();
  status.unusable += unusable_;
  status.last_unusable = last_unusable_;
  status.is_refusing = is_refusing_;
  return status;
}

}  // namespace deixis::stereo_driver
