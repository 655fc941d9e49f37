#include "services/gesture_recogniser/evaluation/examples.h"

#include <algorithm>
#include <cmath>

#include "services/gesture_recogniser/core/destination.h"

namespace deixis::gesture_recogniser {
namespace {

constexpr double kRestExample_s = 0.33;
constexpr double kRestRadius_m = 0.02;  // A hand that stays within, noise apart, is resting.
constexpr double kRestDeviations = 3.5;

/// One hand's way through a recording, in metres.
class Way {
 public:
  Way(const Recording& recording, const std::vector<scene::Hands>& tracked, scene::Side side,
      const ImageScaleConfig& scale_config)
      : scale_(scale_config) {
    double px_per_m = scale_config.fixed_px_per_m;
    for (std::size_t i = 0; i < tracked.size(); ++i) {
      scale_.Observe(ObjectsAt(recording, recording.frames[i], {}));
      for (const scene::Hand& hand : tracked[i].hands) {
        if (hand.side != side) continue;
        const auto face = scale_.FaceOf(hand, tracked[i].time);
        px_per_m = scale_.PixelsPerMetre(face);
        times_s_.push_back(recording.frames[i].time_s);
        positions_px_.push_back(hand.centre_px);
        px_per_m_.push_back(px_per_m);
        faces_.push_back(face ? std::optional(face->box) : std::nullopt);
      }
    }
  }

  bool Covers(double from_s, double to_s) const {
    return !times_s_.empty() && times_s_.front() <= from_s && times_s_.back() >= to_s;
  }
  double PixelsPerMetre(double time_s) const { return px_per_m_[Before(time_s)]; }
  const std::optional<scene::Box>& Face(double time_s) const { return faces_[Before(time_s)]; }

  /// Position in metres, with the scale at `scale_time_s`.
  Eigen::Vector2d At(double time_s, double scale_time_s) const {
    const std::size_t i = Before(time_s);
    const std::size_t next = std::min(i + 1, times_s_.size() - 1);
    const double span_s = times_s_[next] - times_s_[i];
    const double share = span_s > 0.0 ? std::clamp((time_s - times_s_[i]) / span_s, 0.0, 1.0) : 0.0;
    return ((1.0 - share) * positions_px_[i] + share * positions_px_[next]) /
           PixelsPerMetre(scale_time_s);
  }

 private:
  std::size_t Before(double time_s) const {
    const auto after = std::upper_bound(times_s_.begin(), times_s_.end(), time_s + 1e-6);
    return after == times_s_.begin() ? 0 : static_cast<std::size_t>(after - times_s_.begin()) - 1;
  }

  ImageScale scale_;
  std::vector<double> times_s_;
  std::vector<Eigen::Vector2d> positions_px_;
  std::vector<double> px_per_m_;
  std::vector<std::optional<scene::Box>> faces_;
};

double Heading(const Eigen::Vector2d& way) { return std::atan2(way.y(), way.x()); }

/// Fills the motion of an example from `start_s` to `end_s`.
Example MotionBetween(const Way& way, double start_s, double end_s, int points, double step_s) {
  Example example;
  example.duration_s = end_s - start_s;
  for (int i = 0; i < points; ++i) {
    const double time_s = start_s + example.duration_s * i / (points - 1);
    const auto at = [&](double steps) { return way.At(time_s + steps * step_s, start_s); };
    example.speed_m_per_s.push_back((at(0) - at(-1)).norm() / step_s);
    example.turn_rad.push_back(WrapAngle(Heading(at(0) - at(-1)) - Heading(at(-1) - at(-2))));
    example.centred_speed_m_per_s.push_back((at(1) - at(-1)).norm() / (2.0 * step_s));
  }
  return example;
}

const scene::Object* Find(const Recording& recording, int object_id) {
  for (const scene::Object& object : recording.objects) {
    if (object.id == object_id && object.box) return &object;
  }
  return nullptr;
}

/// Mean position of the first steps of a hold.
Eigen::Vector2d HoldAfter(const Way& way, double apex_s, double step_s, double scale_time_s) {
  Eigen::Vector2d held = Eigen::Vector2d::Zero();
  for (int i = 1; i <= 4; ++i) held += 0.25 * way.At(apex_s + i * step_s, scale_time_s);
  return held;
}

/// The forearm's direction as the recogniser guesses it; nothing without a face.
std::optional<Eigen::Vector2d> ForearmOf(const Way& way, const LabelledGesture& gesture,
                                         const Eigen::Vector2d& held_m) {
  const auto& face = way.Face(gesture.apex_s);
  if (!face) return std::nullopt;
  const scene::Box face_m = InMetres(*face, way.PixelsPerMetre(gesture.start_s));
  return ForearmDirection(ShoulderFromFace(face_m, gesture.side), held_m,
                          DestinationConfig{}.elbow_sag);
}

Example StrokeExample(const Way& way, const LabelledGesture& gesture, const scene::Object& object,
                      int points, double step_s) {
  const double start_s = gesture.start_s;
  Example example = MotionBetween(way, start_s, gesture.apex_s, points, step_s);
  const scene::Box box_m = InMetres(*object.box, way.PixelsPerMetre(start_s));
  for (int i = 0; i < points; ++i) {
    const double time_s = start_s + example.duration_s * i / (points - 1);
    example.gap_m.push_back(scene::DistanceTo(box_m, way.At(time_s, start_s)));
  }
  const Eigen::Vector2d held = HoldAfter(way, gesture.apex_s, step_s, start_s);
  const Eigen::Vector2d last =
      held - way.At(gesture.apex_s - DestinationConfig{}.arrival_s, start_s);
  const double heading = Heading(scene::Centre(box_m) - held);
  example.final_gap_m = scene::DistanceTo(box_m, held);
  example.arrival_error_rad = WrapAngle(Heading(last) - heading);
  if (const auto arm = ForearmOf(way, gesture, held)) {
    example.posture_error_rad = WrapAngle(Heading(*arm) - heading);
  }
  return example;
}

bool IsResting(const Way& way, double start_s, double end_s, double step_s, double sigma_px) {
  const double radius = kRestRadius_m + kRestDeviations * sigma_px / way.PixelsPerMetre(start_s);
  const Eigen::Vector2d middle = way.At(0.5 * (start_s + end_s), start_s);
  for (double time_s = start_s - 0.3; time_s <= end_s + 0.3; time_s += step_s) {
    if ((way.At(time_s, start_s) - middle).norm() > radius) return false;
  }
  return true;
}

bool IsWithinGesture(const Recording& recording, scene::Side side, double start_s, double end_s) {
  return std::any_of(
      recording.gestures.begin(), recording.gestures.end(), [&](const auto& gesture) {
        return gesture.side == side && start_s < gesture.retract_end_s && end_s > gesture.start_s;
      });
}

void CollectStrokes(const Recording& recording, const Way& way, scene::Side side, int points,
                    double step_s, std::vector<Example>& strokes) {
  for (const LabelledGesture& gesture : recording.gestures) {
    const scene::Object* object = Find(recording, gesture.object_id);
    const bool is_whole = way.Covers(gesture.start_s - 3 * step_s, gesture.apex_s + 5 * step_s);
    if (gesture.side != side || object == nullptr || !is_whole) continue;
    strokes.push_back(StrokeExample(way, gesture, *object, points, step_s));
  }
}

void CollectRests(const Recording& recording, const Way& way, scene::Side side, int points,
                  double step_s, double sigma_px, std::vector<Example>& rests) {
  const double last_s = recording.frames.back().time_s;
  for (double start_s = 0.6; start_s + kRestExample_s + 0.6 < last_s;
       start_s += 2 * kRestExample_s) {
    const double end_s = start_s + kRestExample_s;
    if (!way.Covers(start_s - 0.5, end_s + 0.5)) continue;
    if (IsWithinGesture(recording, side, start_s, end_s)) continue;
    if (!IsResting(way, start_s, end_s, step_s, sigma_px)) continue;
    rests.push_back(MotionBetween(way, start_s, end_s, points, step_s));
  }
}

}  // namespace

std::vector<GestureModel> TrainModels(const std::vector<Recording>& recordings,
                                      const std::string& without_person, const TrackNoise& noise,
                                      const MotionConfig& motion, const ImageScaleConfig& scale) {
  const TrainingConfig config;
  std::vector<Example> strokes;
  std::vector<Example> rests;
  for (const Recording& recording : recordings) {
    const bool is_left_out = !without_person.empty() && recording.person == without_person;
    if (is_left_out || recording.gestures.empty() || recording.frames.empty()) continue;
    const auto tracked = TrackedHands(recording, noise);
    for (const scene::Side side : {scene::Side::kLeft, scene::Side::kRight}) {
      const Way way(recording, tracked, side, scale);
      CollectStrokes(recording, way, side, config.points, motion.step_s, strokes);
      CollectRests(recording, way, side, config.points, motion.step_s, noise.sigma_px, rests);
    }
  }
  return {TrainStroke(config, "approach", strokes), TrainRest(config, "rest", rests)};
}

}  // namespace deixis::gesture_recogniser
