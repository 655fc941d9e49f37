#include "services/gesture_recogniser/evaluation/tracked_hands.h"

#include <cmath>
#include <map>

#include "common/filtering/kalman_filter.h"
#include "common/filtering/random.h"

namespace deixis::gesture_recogniser {
namespace {

constexpr int kFaceId = 1000000;  // Far from any object's id.

/// Noise that depends on sequence, hand and seed only.
class NoisySight {
 public:
  NoisySight(const std::string& name, int hand, std::uint64_t seed)
      : random_(seed, Hash(name) + static_cast<std::uint64_t>(hand)) {}
  double Next(double sigma) { return sigma * static_cast<double>(random_.Normal(counter_++)); }

 private:
  static std::uint64_t Hash(const std::string& name) {
    std::uint64_t hash = 0;
    for (const char letter : name) hash = hash * 131 + static_cast<unsigned char>(letter);
    return hash << 8;
  }
  filtering::CounterRandom random_;
  std::uint64_t counter_ = 0;
};

/// Filters one hand's noisy positions.
class Filter {
 public:
  Filter(const TrackNoise& noise, const Eigen::Vector2d& start)
      : x_({noise.jerk_density, noise.acceleration_time_s}, {start.x(), 0.0, 0.0}, Start(noise)),
        y_({noise.jerk_density, noise.acceleration_time_s}, {start.y(), 0.0, 0.0}, Start(noise)) {}

  void Step(double elapsed_s, const Eigen::Vector2d& seen, double sigma) {
    x_.Predict(elapsed_s);
    y_.Predict(elapsed_s);
    x_.Update(seen.x(), sigma);
    y_.Update(seen.y(), sigma);
  }

  void Write(scene::Hand& hand) const {
    hand.centre_px = {x_.position(), y_.position()};
    hand.velocity_px_per_s = {x_.velocity(), y_.velocity()};
    for (int i = 0; i < 2; ++i) {
      for (int j = 0; j < 2; ++j) {
        hand.covariance(2 * i, 2 * j) = x_.covariance()(i, j);
        hand.covariance(2 * i + 1, 2 * j + 1) = y_.covariance()(i, j);
      }
    }
  }

 private:
  static Eigen::Vector3d Start(const TrackNoise& noise) {
    return {noise.sigma_px, 100.0 * noise.sigma_px, 1000.0 * noise.sigma_px};
  }
  filtering::ConstantAccelerationFilter x_;
  filtering::ConstantAccelerationFilter y_;
};

struct Sight {
  NoisySight noise;
  std::optional<Filter> filter;
  double time_s = 0.0;
};

scene::Hand AsMessage(const RecordedHand& recorded) {
  scene::Hand hand;
  hand.id = recorded.id;
  hand.person_id = 0;
  hand.side = recorded.side;
  hand.side_probability = recorded.side == scene::Side::kUnknown ? 0.0 : 1.0;
  hand.is_acting = recorded.is_acting;
  hand.state = recorded.is_measured ? scene::HandState::kMeasured : scene::HandState::kPredicted;
  hand.centre_px = recorded.centre_px;
  hand.covariance.diagonal().head<2>().setConstant(recorded.sigma_px * recorded.sigma_px);
  return hand;
}

void AddNoise(const TrackNoise& noise, double time_s, Sight& sight, scene::Hand& hand) {
  const double right = sight.noise.Next(noise.sigma_px);
  const double down = sight.noise.Next(noise.sigma_px);
  const Eigen::Vector2d seen = hand.centre_px + Eigen::Vector2d(right, down);
  if (sight.filter) {
    sight.filter->Step(time_s - sight.time_s, seen, noise.sigma_px);
  } else {
    sight.filter.emplace(noise, seen);
  }
  sight.time_s = time_s;
  sight.filter->Write(hand);
}

}  // namespace

Timestamp TimeOf(double seconds) {
  return {1000000 + static_cast<std::int64_t>(std::llround(1e6 * seconds))};
}

std::vector<scene::Hands> TrackedHands(const Recording& recording, const TrackNoise& noise) {
  std::vector<scene::Hands> tracked;
  std::map<int, Sight> sights;
  for (const RecordedFrame& frame : recording.frames) {
    scene::Hands& hands = tracked.emplace_back();
    hands.time = TimeOf(frame.time_s);
    for (const RecordedHand& recorded : frame.hands) {
      scene::Hand hand = AsMessage(recorded);
      if (recorded.sigma_px <= 0.0 && noise.sigma_px > 0.0) {
        auto [sight, is_new] = sights.try_emplace(
            recorded.id, Sight{{recording.name, recorded.id, noise.seed}, std::nullopt, 0.0});
        AddNoise(noise, frame.time_s, sight->second, hand);
      }
      hands.hands.push_back(hand);
    }
  }
  return tracked;
}

scene::Objects ObjectsAt(const Recording& recording, const RecordedFrame& frame,
                         const std::vector<scene::Object>& objects) {
  scene::Objects message;
  message.time = TimeOf(frame.time_s);
  message.source = recording.name;
  message.objects = objects;
  if (frame.face) {
    scene::Object& face = message.objects.emplace_back();
    face.id = kFaceId;
    face.label = "face";
    face.kind = scene::ObjectKind::kFace;
    face.person_id = 0;
    face.box = frame.face;
    face.score = 1.0;
  }
  return message;
}

}  // namespace deixis::gesture_recogniser
