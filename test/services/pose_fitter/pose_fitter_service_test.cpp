#include "services/pose_fitter/pose_fitter_service.h"

#include <gmock/gmock.h>

#include <limits>
#include <opencv2/imgcodecs.hpp>

#include "common/messages/body_poses.h"
#include "common/messages/person_model.h"
#include "common/messages/stereo_calibration.h"
#include "common/messages/stereo_image.h"
#include "test/services/pose_fitter/synthetic_person.h"
#include "test/support/memory_bus.h"

namespace deixis::pose_fitter {
namespace {

constexpr std::int64_t kPeriod_us = 100'000;
constexpr int kWidth_px = 160;

/// A still person in a room, pictures of it, and what the service answers to them.
class PoseFitterServiceTest : public testing::Test {
 protected:
  PoseFitterServiceTest() {
    const auto body = test::ClothedBody();
    test::Draw(body, test::StandingIn(room_, body, 0.1, 2.4), 1, picture_);
    bus_.Subscribe<body_model::BodyPoses>(
        "BODY_POSES", transport::Delivery::kEvery, [this](const body_model::BodyPoses& poses) {
          for (const auto& person : poses.bodies) {
            all_models_came_first_ &= models_.count(person.model_id) != 0;
          }
          answers_.push_back(poses);
        });
    bus_.Subscribe<body_model::PersonModel>(
        "BODY_MODEL", transport::Delivery::kEvery, [this](const body_model::PersonModel& model) {
          models_[model.body.id()].push_back(model.time.microseconds);
        });
  }
  void Calibrate() {
    auto calibration = test::CalibrationOf(picture_);
    bus_.Publish("STEREO_CALIBRATION", calibration);
    deixis::test::HandleAll(bus_);
  }
  static images::StereoImage StereoOf(std::int64_t time_us, const cv::Mat& depth_mm) {
    std::vector<std::uint8_t> jpeg;
    cv::imencode(".jpg", cv::Mat(depth_mm.size(), CV_8UC3, cv::Scalar(90, 90, 90)), jpeg);
    return {{{time_us}, "STEREO", depth_mm.cols, depth_mm.rows, jpeg}, depth_mm};
  }
  void ShowAt(std::int64_t time_us, const cv::Mat& depth_mm) {
    bus_.Publish("STEREO", StereoOf(time_us, depth_mm));
    deixis::test::HandleAll(bus_);
  }
  void Show() { ShowAt(time_us_ += kPeriod_us, picture_.depth_mm); }
  void ShowMany(int count) {
    for (int i = 0; i < count; ++i) Show();
  }
  std::int64_t Dropped(const std::string& channel, const std::string& reason) const {
    std::int64_t count = 0;
    for (const auto& statistics : bus_.statistics()) {
      const auto drop = statistics.drops.find(reason);
      if (statistics.channel == channel && drop != statistics.drops.end()) count += drop->second;
    }
    return count;
  }

  test::Room room_;
  test::Picture picture_ = test::Look(room_, kWidth_px);
  const test::Picture empty_ = test::Look(room_, kWidth_px);
  transport::Bus bus_{deixis::test::Memory()};
  PoseFitterServiceConfig config_;
  std::int64_t time_us_ = 1'000'000;
  std::vector<body_model::BodyPoses> answers_;
  std::map<std::int64_t, std::vector<std::int64_t>> models_;  ///< Times of each, by its id.
  bool all_models_came_first_ = true;
};

TEST_F(PoseFitterServiceTest, AnswersEveryImageAtItsTime) {
  PoseFitterService service(config_, bus_, bus_);
  Calibrate();
  ShowMany(3);
  ASSERT_EQ(answers_.size(), 3U);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(answers_[i].time.microseconds,
              1'000'000 + kPeriod_us * (static_cast<std::int64_t>(i) + 1));
    EXPECT_EQ(answers_[i].camera, "STEREO");
    EXPECT_EQ(answers_[i].frame, "STEREO");
    EXPECT_EQ(answers_[i].source, "pose_fitter");
    ASSERT_EQ(answers_[i].bodies.size(), 1U);
  }
}

TEST_F(PoseFitterServiceTest, SaysThatNobodyIsThere) {
  PoseFitterService service(config_, bus_, bus_);
  Calibrate();
  ShowAt(2'000'000, empty_.depth_mm);
  ShowAt(2'100'000, cv::Mat::zeros(empty_.depth_mm.size(), CV_16UC1));
  ASSERT_EQ(answers_.size(), 2U);
  EXPECT_TRUE(answers_[0].bodies.empty());
  EXPECT_TRUE(answers_[1].bodies.empty());
}

TEST_F(PoseFitterServiceTest, SendsEachModelBeforeItsFirstPoseAndOnceASecond) {
  PoseFitterService service(config_, bus_, bus_);
  Calibrate();
  ShowMany(45);
  EXPECT_TRUE(all_models_came_first_);
  ASSERT_FALSE(models_.empty());
  std::vector<std::int64_t> times;
  for (const auto& [id, sent] : models_) times.insert(times.end(), sent.begin(), sent.end());
  EXPECT_GE(times.size(), 5U);
  for (const auto& [id, sent] : models_) {
    for (std::size_t i = 1; i < sent.size(); ++i) EXPECT_LE(sent[i] - sent[i - 1], 1'000'000);
  }
}

TEST_F(PoseFitterServiceTest, WaitsForTheCalibrationAndCountsWhatComesBefore) {
  PoseFitterService service(config_, bus_, bus_);
  Show();
  EXPECT_TRUE(answers_.empty());
  EXPECT_EQ(Dropped("STEREO", "no_calibration"), 1);
  EXPECT_THAT(service.health().text, testing::HasSubstr("STEREO_CALIBRATION"));
  Calibrate();
  EXPECT_EQ(service.health().text, "");
  Show();
  EXPECT_EQ(answers_.size(), 1U);
}

TEST_F(PoseFitterServiceTest, RefusesDepthOfAnotherView) {
  PoseFitterService service(config_, bus_, bus_);
  Calibrate();
  ShowAt(2'000'000, cv::Mat(400, 60, CV_16UC1, cv::Scalar(2000)));
  EXPECT_TRUE(answers_.empty());
  EXPECT_EQ(Dropped("STEREO", "depth_of_other_view"), 1);
  Show();
  EXPECT_EQ(answers_.size(), 1U);
}

TEST_F(PoseFitterServiceTest, KeepsItsCalibrationWhenOneComesThatIsNone) {
  PoseFitterService service(config_, bus_, bus_);
  Calibrate();
  const std::vector<std::uint8_t> junk(64, 0xAB);
  bus_.PublishRaw("STEREO_CALIBRATION", {junk.data(), junk.size()}, {1});
  auto bad = test::CalibrationOf(picture_);
  bad.rectified.focal_px.x() = 0.0;
  bus_.Publish("STEREO_CALIBRATION", bad);
  deixis::test::HandleAll(bus_);
  EXPECT_EQ(Dropped("STEREO_CALIBRATION", "out_of_range"), 1);
  Show();
  EXPECT_EQ(answers_.size(), 1U);
}

TEST_F(PoseFitterServiceTest, LeavesLateAndRepeatedImagesOutAndGoesOnFollowing) {
  PoseFitterService service(config_, bus_, bus_);
  Calibrate();
  ShowMany(8);
  const int id = answers_.back().bodies.at(0).person_id;
  ShowAt(time_us_, picture_.depth_mm);
  ShowAt(time_us_ - 300'000, empty_.depth_mm);
  EXPECT_EQ(answers_.size(), 8U);
  EXPECT_EQ(Dropped("STEREO", "late_image"), 2);
  Show();
  EXPECT_EQ(answers_.back().bodies.at(0).person_id, id);
}

TEST_F(PoseFitterServiceTest, StartsAnewWhenTimeJumps) {
  PoseFitterService service(config_, bus_, bus_);
  Calibrate();
  constexpr std::int64_t kHour_us = 3'600'000'000;
  constexpr std::int64_t kLast_us = (std::int64_t{1} << 60) - 1'000'000'000;  // The year 38,500.
  for (const std::int64_t start_us : {kHour_us, std::int64_t{0}, kLast_us, 2 * kHour_us}) {
    time_us_ = start_us;
    ShowMany(2);
    ASSERT_EQ(answers_.back().time.microseconds, time_us_);
    EXPECT_EQ(answers_.back().bodies.size(), 1U);
  }
  EXPECT_EQ(answers_.size(), 8U);
  EXPECT_TRUE(all_models_came_first_);
}

TEST_F(PoseFitterServiceTest, GoesOnAfterAMessageThatIsNoImage) {
  PoseFitterService service(config_, bus_, bus_);
  Calibrate();
  const std::vector<std::uint8_t> junk(40, 0xAB);
  bus_.PublishRaw("STEREO", {junk.data(), junk.size()}, {1});
  deixis::test::HandleAll(bus_);
  EXPECT_TRUE(answers_.empty());
  Show();
  EXPECT_EQ(answers_.size(), 1U);
}

TEST_F(PoseFitterServiceTest, TakesAnImageOfOnePixel) {
  PoseFitterService service(config_, bus_, bus_);
  Calibrate();
  ShowAt(time_us_, cv::Mat(1, 1, CV_16UC1, cv::Scalar(2000)));
  for (const auto& answer : answers_) EXPECT_TRUE(answer.bodies.empty());
  Show();
  EXPECT_EQ(answers_.back().time.microseconds, time_us_);
}

TEST_F(PoseFitterServiceTest, SaysTheSameBytesAboutTheSameImages) {
  std::vector<std::vector<std::uint8_t>> said[2];
  for (auto& bytes : said) {
    transport::Bus bus(deixis::test::Memory());
    bus.SubscribeRaw("BODY_POSES", [&bytes](const transport::RawMessage& message) {
      bytes.emplace_back(message.bytes.data, message.bytes.data + message.bytes.size);
    });
    PoseFitterService service(config_, bus, bus);
    bus.Publish("STEREO_CALIBRATION", test::CalibrationOf(picture_));
    for (int i = 1; i <= 6; ++i) {
      bus.Publish("STEREO", StereoOf(i * kPeriod_us, picture_.depth_mm));
      deixis::test::HandleAll(bus);
    }
  }
  ASSERT_EQ(said[0].size(), 6U);
  EXPECT_EQ(said[0], said[1]);
}

TEST_F(PoseFitterServiceTest, PublishesWhereTheConfigurationSays) {
  config_.poses_channel = "ELSEWHERE";
  int elsewhere = 0;
  bus_.Subscribe<body_model::BodyPoses>("ELSEWHERE", transport::Delivery::kEvery,
                                        [&elsewhere](const auto&) { ++elsewhere; });
  PoseFitterService service(config_, bus_, bus_);
  Calibrate();
  Show();
  EXPECT_EQ(elsewhere, 1);
  EXPECT_TRUE(answers_.empty());
}

TEST(PoseFitterServiceConfig, RefusesToPublishOnAnInput) {
  PoseFitterServiceConfig config;
  EXPECT_NO_THROW(config.Validate());
  config.poses_channel = config.stereo_channel;
  EXPECT_THROW(config.Validate(), config::ConfigError);
}

}  // namespace
}  // namespace deixis::pose_fitter
