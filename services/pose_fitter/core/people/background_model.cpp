#include "services/pose_fitter/core/people/background_model.h"

#include <algorithm>

#include "services/pose_fitter/core/depth/sound_depth.h"

namespace deixis::pose_fitter {
namespace {

constexpr double kSlope = 2.0;       // Pixels at a slope shift a little from image to image.
constexpr double kLeastKnown = 0.1;  // Of the picture, before it can tell that the camera moves.

}  // namespace

void BackgroundModelConfig::Validate() const {
  config::Faults faults;
  faults.Require(still_time_s > 0.0, "still_time_s", "must be positive");
  faults.Require(nearer_time_s > 0.0, "nearer_time_s", "must be positive");
  faults.Require(same_fixed_m >= 0.0, "same_fixed_m", "must not be negative");
  faults.Require(same_sigmas > 0.0, "same_sigmas", "must be positive");
  faults.Require(moving_share > 0.0 && moving_share <= 1.0, "moving_share",
                 "must lie between 0 and 1");
  faults.ThrowIfAny();
}

BackgroundModel::BackgroundModel(const BackgroundModelConfig& config) : config_(config) {
  config_.Validate();
}

void BackgroundModel::Reset() {
  for (auto* pixels : {&background_m_, &seen_s_, &other_s_}) {
    std::fill(pixels->begin(), pixels->end(), 0.0F);
  }
  known_share_ = 0.0;
}

void BackgroundModel::Fit(const DepthView& depth) {
  const std::size_t total = depth.z_m().size();
  if (background_m_.size() == total && width_px_ == depth.width_px()) return;
  width_px_ = depth.width_px();
  for (auto* pixels : {&background_m_, &seen_s_, &other_s_}) pixels->resize(total);
  is_foreground_.resize(total);
  Reset();
}

BackgroundRule BackgroundModel::RuleOf(const DepthCamera& camera, double elapsed_s) const {
  BackgroundRule rule;
  rule.elapsed_s = static_cast<float>(std::max(0.0, elapsed_s));
  rule.still_s = static_cast<float>(config_.still_time_s);
  rule.nearer_s = static_cast<float>(config_.nearer_time_s);
  rule.same = StepLimitOf(camera, config_.same_sigmas, kSlope);
  rule.same.fixed_m += static_cast<float>(config_.same_fixed_m);
  return rule;
}

const std::vector<std::uint8_t>& BackgroundModel::Foreground(
    const DepthView& depth, const std::vector<std::uint8_t>& is_sound) {
  if (!config_.is_used) return is_sound;
  Fit(depth);
  const BackgroundRule rule = RuleOf(depth.camera(), 0.0);
  BackgroundMatch match;
  const auto width = static_cast<std::size_t>(depth.width_px());
  for (std::size_t row = 0; row < is_foreground_.size(); row += width) {
    const BackgroundMatch of_row = MarkForegroundRow(
        depth.z_m().data() + row, is_sound.data() + row, depth.width_px(), rule,
        background_m_.data() + row, seen_s_.data() + row, is_foreground_.data() + row);
    match.known += of_row.known;
    match.different += of_row.different;
  }
  known_share_ = match.known / std::max(1.0, static_cast<double>(is_foreground_.size()));
  if (known_share_ > kLeastKnown && match.different > config_.moving_share * match.known) {
    Reset();
    return is_sound;
  }
  return is_foreground_;
}

void BackgroundModel::Learn(const DepthView& depth, const std::vector<std::uint8_t>& is_sound,
                            const std::vector<std::uint8_t>& is_occupied, double elapsed_s) {
  if (!config_.is_used) return;
  Fit(depth);
  const BackgroundRule rule = RuleOf(depth.camera(), elapsed_s);
  const auto width = static_cast<std::size_t>(depth.width_px());
  for (std::size_t row = 0; row < background_m_.size(); row += width) {
    LearnBackgroundRow(depth.z_m().data() + row, is_sound.data() + row,
                       is_occupied.empty() ? nullptr : is_occupied.data() + row, depth.width_px(),
                       rule, background_m_.data() + row, seen_s_.data() + row,
                       other_s_.data() + row);
  }
}

}  // namespace deixis::pose_fitter
