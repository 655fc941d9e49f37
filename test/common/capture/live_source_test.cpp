#include "common/capture/live_source.h"

#include <gmock/gmock.h>

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <deque>
#include <mutex>
#include <thread>

namespace deixis::capture {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

/// A camera whose pictures the test sends one by one.
class FakeCamera {
 public:
  ~FakeCamera() { Unplug(); }

  void Send(std::int64_t time_us, cv::Mat bgr = cv::Mat(8, 8, CV_8UC3, cv::Scalar::all(9))) {
    const std::lock_guard<std::mutex> lock(mutex_);
    waiting_.push_back(LivePicture{{time_us}, std::move(bgr)});
    changed_.notify_all();
  }
  void Unplug() {
    const std::lock_guard<std::mutex> lock(mutex_);
    is_there_ = false;
    changed_.notify_all();
  }
  void Plug() {
    const std::lock_guard<std::mutex> lock(mutex_);
    is_there_ = true;
  }
  Capture AsCapture() {
    const auto open = [this]() -> ReadLive {
      const std::lock_guard<std::mutex> lock(mutex_);
      if (!is_there_) return {};
      return [this] { return Read(); };
    };
    return {open, "camera 'fake'", "plug it in", std::chrono::milliseconds(1)};
  }

 private:
  std::optional<LivePicture> Read() {
    std::unique_lock<std::mutex> lock(mutex_);
    changed_.wait(lock, [this] { return !waiting_.empty() || !is_there_; });
    if (waiting_.empty()) return std::nullopt;
    LivePicture picture = waiting_.front();
    waiting_.pop_front();
    return picture;
  }

  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<LivePicture> waiting_;
  bool is_there_ = true;
};

template <typename Condition>
bool ComesTrue(Condition condition) {
  const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(20);
  while (!condition()) {
    if (std::chrono::steady_clock::now() > deadline) return false;
    std::this_thread::yield();
  }
  return true;
}

class LiveSourceTest : public testing::Test {
 protected:
  LiveSource Open() {
    return {camera_.AsCapture(), [this] { return Timestamp{now_us_}; }};
  }
  static std::optional<Picture> WaitForPicture(Source& source) {
    Grab grab;
    ComesTrue([&] { return (grab = source.Next()).state == SourceState::kPicture; });
    return grab.picture;
  }
  FakeCamera camera_;
  std::atomic<std::int64_t> now_us_{0};
};

TEST_F(LiveSourceTest, RefusesACameraThatIsNotThereAndSaysTheCure) {
  camera_.Unplug();
  EXPECT_THAT([this] { Open(); }, ThrowsMessage<config::ConfigError>(HasSubstr("plug it in")));
}

TEST_F(LiveSourceTest, DoesNotWaitForAPicture) {
  LiveSource source = Open();
  EXPECT_EQ(source.Next().state, SourceState::kWaiting);
  EXPECT_TRUE(source.status().is_live);
  EXPECT_EQ(source.status().trouble, "");
  camera_.Unplug();
}

TEST_F(LiveSourceTest, GivesThePictureWithItsCaptureTime) {
  LiveSource source = Open();
  camera_.Send(1234);
  EXPECT_EQ(WaitForPicture(source)->time.microseconds, 1234);
  EXPECT_EQ(source.Next().state, SourceState::kWaiting);
  camera_.Unplug();
}

TEST_F(LiveSourceTest, KeepsTheNewestPictureAndCountsWhatItReplaces) {
  LiveSource source = Open();
  for (int i = 1; i <= 3; ++i) camera_.Send(i);
  ASSERT_TRUE(ComesTrue([&] { return source.status().skipped == 2; }));
  EXPECT_EQ(WaitForPicture(source)->time.microseconds, 3);
  camera_.Unplug();
}

TEST_F(LiveSourceTest, CountsPicturesThatCannotBeDecoded) {
  LiveSource source = Open();
  camera_.Send(1, cv::Mat());
  camera_.Send(2);
  EXPECT_EQ(WaitForPicture(source)->time.microseconds, 2);
  EXPECT_EQ(source.status().corrupt, 1);
  camera_.Unplug();
}

TEST_F(LiveSourceTest, SaysThatItsCameraIsLostAndRecovers) {
  LiveSource source = Open();
  camera_.Unplug();
  ASSERT_TRUE(ComesTrue([&] { return !source.status().trouble.empty(); }));
  EXPECT_THAT(source.status().trouble, HasSubstr("camera 'fake' is lost"));
  camera_.Plug();
  camera_.Send(7);
  EXPECT_EQ(WaitForPicture(source)->time.microseconds, 7);
  EXPECT_EQ(source.status().trouble, "");
  camera_.Unplug();
}

TEST_F(LiveSourceTest, SaysThatItsCameraIsSilent) {
  LiveSource source = Open();
  now_us_ = 10'000'000;
  EXPECT_THAT(source.status().trouble, HasSubstr("no picture for 10 s"));
  camera_.Unplug();
}

TEST_F(LiveSourceTest, TellsSilenceWhateverTheCaptureTimesAre) {
  LiveSource source = Open();
  camera_.Send(std::int64_t{1} << 59);  // Before the clock was set back by ages.
  ASSERT_TRUE(WaitForPicture(source));
  EXPECT_EQ(source.status().trouble, "");
  now_us_ = 4'000'000;
  EXPECT_THAT(source.status().trouble, HasSubstr("no picture for 4 s"));
  camera_.Unplug();
}

}  // namespace
}  // namespace deixis::capture
