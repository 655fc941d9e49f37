#include "common/capture/pushed_source.h"

#include <utility>

namespace deixis::capture {
namespace {

constexpr double kLongestSilence_s = 3.0;

}  // namespace

PushedSource::PushedSource(std::string name, std::function<Timestamp()> clock)
    : name_(std::move(name)), clock_(std::move(clock)), last_arrival_(clock_()) {}

void PushedSource::Push(const images::Image& image) {
  Picture picture;
  picture.time = image.time;
  picture.bgr = image.bgr;
  Keep(std::move(picture));
}

void PushedSource::Push(const images::DepthImage& image) {
  Picture picture;
  picture.time = image.time;
  picture.depth = image.depth_mm;
  Keep(std::move(picture));
}

void PushedSource::Keep(Picture picture) {
  if (waiting_) ++skipped_;
  waiting_ = std::move(picture);
  last_arrival_ = clock_();
  has_begun_ = true;
}

Grab PushedSource::Next() {
  if (!waiting_) return {};
  return {SourceState::kPicture, std::exchange(waiting_, std::nullopt)};
}

SourceStatus PushedSource::status() const {
  SourceStatus status;
  status.is_live = true;
  status.skipped = skipped_;
  if (SecondsBetween(last_arrival_, clock_()) > kLongestSilence_s) {
    status.trouble = (has_begun_ ? "no more pictures on '" : "no picture yet on '") + name_ +
                     "'; see that the robot's camera runs, and that the channel is its own";
  }
  return status;
}

}  // namespace deixis::capture
