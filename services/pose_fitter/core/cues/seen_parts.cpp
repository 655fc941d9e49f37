#include "services/pose_fitter/core/cues/seen_parts.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "common/config/config.h"

namespace deixis::pose_fitter {
namespace {

using Eigen::Vector2d;

constexpr double kAround_m = 0.02;  // What is measured so near to a part may be its own.
constexpr double kUsual_m = 2.0;    // Of a person whose distance is not known.
constexpr std::size_t kMost = 32;   // Cues of one image; those that come later do not count.
constexpr int kMostAround_px = 4;

/// Pixels of a picture become those of the depth image that covers the same view.
Vector2d ScaledPixel(const Vector2d& pixel_px, const Vector2d& scale) {
  return (pixel_px.array() + 0.5) * scale.array() - 0.5;
}

double Median(double* values, std::size_t count) {
  auto* middle = values + count / 2;
  std::nth_element(values, middle, values + count);
  return *middle;
}

std::optional<double> DepthAround(const DepthView& view, const Vector2d& pixel_px) {
  const int u = static_cast<int>(std::lround(pixel_px.x()));
  const int v = static_cast<int>(std::lround(pixel_px.y()));
  const auto is_inside = [&view](int x, int y) {
    return x >= 0 && x < view.width_px() && y >= 0 && y < view.height_px();
  };
  if (!is_inside(u, v)) return std::nullopt;
  const double near_m = std::max(0.3, static_cast<double>(view.z_m(u, v)));
  const int around = std::clamp(static_cast<int>(view.camera().focal_px.x() * kAround_m / near_m),
                                1, kMostAround_px);
  std::array<double, (2 * kMostAround_px + 1) * (2 * kMostAround_px + 1)> found{};
  std::size_t count = 0;
  for (int y = v - around; y <= v + around; ++y) {
    for (int x = u - around; x <= u + around; ++x) {
      if (!is_inside(x, y) || view.z_m(x, y) <= 0.0F) continue;
      found[count++] = static_cast<double>(view.z_m(x, y));
    }
  }
  if (count == 0) return std::nullopt;
  return Median(found.data(), count);
}

/// How old what was seen then is at `time`; nothing when that is of no use.
std::optional<double> Age_s(Timestamp seen, Timestamp time, double oldest_s) {
  const double age_s = SecondsBetween(seen, time);
  if (age_s < 0.0 || age_s > oldest_s) return std::nullopt;
  return age_s;
}

}  // namespace

void SeenPartsConfig::Validate() const {
  config::Faults faults;
  faults.Require(oldest_s >= 0.0, "oldest_s", "must not be negative");
  faults.Require(hand_px > 0.0, "hand_px", "must be positive");
  faults.Require(face_px > 0.0, "face_px", "must be positive");
  faults.Require(merged_trust >= 0.0 && merged_trust <= 1.0, "merged_trust", "must be 0..1");
  faults.Require(face_trust >= 0.0 && face_trust <= 1.0, "face_trust", "must be 0..1");
  faults.Require(face_m >= 0.0, "face_m", "must not be negative");
  faults.Require(elsewhere_trust >= 0.0 && elsewhere_trust <= 1.0, "elsewhere_trust",
                 "must be 0..1");
  faults.Require(acceleration_px_per_s2 >= 0.0, "acceleration_px_per_s2", "must not be negative");
  faults.ThrowIfAny();
}

const std::vector<PartCue>& SeenParts::At(Timestamp time, const std::string& camera,
                                          const Vector2d& picture_px, const DepthView& view) {
  cues_.clear();
  const Vector2d scale = Vector2d(view.width_px(), view.height_px()).cwiseQuotient(picture_px);
  if (hands_ && hands_->camera == camera) {
    if (const auto age_s = Age_s(hands_->time, time, config_.oldest_s)) {
      for (const scene::Hand& hand : hands_->hands) AddHand(hand, *age_s, scale, view);
    }
  }
  if (objects_ && objects_->camera == camera) {
    if (const auto age_s = Age_s(objects_->time, time, config_.oldest_s)) {
      for (const scene::Object& object : objects_->objects) AddFace(object, *age_s, scale, view);
    }
  }
  DoubtHandsAtFaces();
  return cues_;
}

void SeenParts::DoubtHandsAtFaces() {
  for (PartCue& hand : cues_) {
    if (hand.part != Part::kHand) continue;
    for (const PartCue& face : cues_) {
      if (face.part != Part::kFace) continue;
      const double z_m = face.distance_m.value_or(hand.distance_m.value_or(kUsual_m));
      const bool is_at = z_m * (hand.ray - face.ray).norm() < config_.face_m;
      if (is_at) hand.trust = std::min(hand.trust, config_.face_trust);
    }
  }
}

void SeenParts::AddHand(const scene::Hand& hand, double age_s, const Vector2d& scale,
                        const DepthView& view) {
  using scene::HandState;
  if (hand.state != HandState::kMeasured && hand.state != HandState::kMerged) return;
  const double stated_px2 = 0.5 * (hand.covariance(0, 0) + hand.covariance(1, 1));
  const double moved_px = 0.5 * config_.acceleration_px_per_s2 * age_s * age_s;
  const double sigma_px =
      std::sqrt(config_.hand_px * config_.hand_px + stated_px2 + moved_px * moved_px);
  const Vector2d pixel_px = hand.centre_px + age_s * hand.velocity_px_per_s;
  PartCue* cue = Add(Part::kHand, ScaledPixel(pixel_px, scale), sigma_px * scale.x(), view);
  if (cue == nullptr) return;
  cue->is_measured = hand.state == HandState::kMeasured;
  if (!cue->is_measured) cue->trust = config_.merged_trust;
  if (hand.side == scene::Side::kRight) cue->right_probability = hand.side_probability;
  if (hand.side == scene::Side::kLeft) cue->right_probability = 1.0 - hand.side_probability;
}

void SeenParts::AddFace(const scene::Object& face, double age_s, const Vector2d& scale,
                        const DepthView& view) {
  if (face.kind != scene::ObjectKind::kFace || !face.box ||
      face.visibility != scene::Visibility::kSeen) {
    return;
  }
  const double moved_px = 0.5 * config_.acceleration_px_per_s2 * age_s * age_s;
  const double sigma_px = std::sqrt(config_.face_px * config_.face_px + moved_px * moved_px);
  const Vector2d pixel_px = scene::Centre(*face.box);
  Add(Part::kFace, ScaledPixel(pixel_px, scale), sigma_px * scale.x(), view);
}

PartCue* SeenParts::Add(Part part, const Vector2d& pixel_px, double sigma_px,
                        const DepthView& view) {
  const DepthCamera& camera = view.camera();
  if (cues_.size() >= kMost || !camera.Contains(pixel_px) || !(sigma_px < camera.width_px)) {
    return nullptr;
  }
  PartCue& cue = cues_.emplace_back();
  cue.part = part;
  cue.ray = camera.Ray(pixel_px.x(), pixel_px.y());
  cue.sigma = sigma_px / camera.focal_px.x();
  cue.distance_m = DepthAround(view, pixel_px);
  return &cue;
}

}  // namespace deixis::pose_fitter
