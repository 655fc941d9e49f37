#include "common/capture/live_source.h"

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <mutex>
#include <thread>
#include <utility>

namespace deixis::capture {
namespace {

using std::chrono::milliseconds;

constexpr milliseconds kLastRetry(30'000);
constexpr milliseconds kPatienceAtEnd(300);
constexpr double kStalled_s = 3.0;

}  // namespace

struct LiveSource::Shared {
  Capture capture;
  std::function<Timestamp()> clock;

  mutable std::mutex mutex;
  std::condition_variable changed;
  std::optional<LivePicture> newest;
  std::string trouble;
  std::int64_t skipped = 0;
  std::int64_t corrupt = 0;
  Timestamp heard;  // By the monotonic clock.
  bool must_stop = false;
  bool has_ended = false;

  void Run(ReadLive read) {
    while (true) {
      KeepReading(read);
      read = {};
      if (!OpenAgain(read)) break;
    }
    const std::lock_guard<std::mutex> lock(mutex);
    has_ended = true;
    changed.notify_all();
  }

  void KeepReading(const ReadLive& read) {
    while (true) {
      std::optional<LivePicture> picture = read();
      const std::lock_guard<std::mutex> lock(mutex);
      if (must_stop || !picture) return;
      Keep(std::move(*picture));
    }
  }

  void Keep(LivePicture picture) {
    heard = clock();
    if (picture.bgr.empty()) {
      ++corrupt;
      return;
    }
    if (newest) ++skipped;
    newest = std::move(picture);
    trouble.clear();
  }

  /// Tries until the camera is there again; false = it is time to stop.
  bool OpenAgain(ReadLive& read) {
    for (milliseconds wait = capture.first_retry;; wait = std::min(2 * wait, kLastRetry)) {
      if (!WaitForRetry(wait)) return false;
      read = capture.open();
      if (read) return true;
    }
  }

  bool WaitForRetry(milliseconds wait) {
    std::unique_lock<std::mutex> lock(mutex);
    trouble = capture.name + " is lost; trying again after " +
              std::to_string(std::chrono::duration_cast<std::chrono::seconds>(wait).count()) + " s";
    return !changed.wait_for(lock, wait, [this] { return must_stop; });
  }
};

LiveSource::LiveSource(Capture capture, std::function<Timestamp()> monotonic_clock)
    : shared_(std::make_shared<Shared>()) {
  shared_->capture = std::move(capture);
  shared_->clock = std::move(monotonic_clock);
  ReadLive read = shared_->capture.open();
  if (!read) {
    throw config::ConfigError(shared_->capture.name + " cannot be opened; " +
                              shared_->capture.cure);
  }
  shared_->heard = shared_->clock();
  std::thread([shared = shared_, read = std::move(read)]() mutable {
    shared->Run(std::move(read));
  }).detach();
}

LiveSource::~LiveSource() {
  std::unique_lock<std::mutex> lock(shared_->mutex);
  shared_->must_stop = true;
  shared_->changed.notify_all();
  shared_->changed.wait_for(lock, kPatienceAtEnd, [this] { return shared_->has_ended; });
}

Grab LiveSource::Next() {
  const std::lock_guard<std::mutex> lock(shared_->mutex);
  if (!shared_->newest) return {};
  Picture picture;
  picture.time = shared_->newest->time;
  picture.bgr = std::move(shared_->newest->bgr);
  shared_->newest.reset();
  return {SourceState::kPicture, std::move(picture)};
}

SourceStatus LiveSource::status() const {
  const Timestamp now = shared_->clock();
  const std::lock_guard<std::mutex> lock(shared_->mutex);
  SourceStatus status;
  status.is_live = true;
  status.trouble = shared_->trouble;
  status.skipped = shared_->skipped;
  status.corrupt = shared_->corrupt;
  const double silent_s = SecondsBetween(shared_->heard, now);
  if (status.trouble.empty() && silent_s > kStalled_s) {
    status.trouble = shared_->capture.name + " has sent no picture for " +
                     std::to_string(static_cast<int>(silent_s)) + " s";
  }
  return status;
}

}  // namespace deixis::capture
