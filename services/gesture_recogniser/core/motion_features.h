#pragma once
#include <Eigen/Core>
#include <deque>
#include <optional>
#include <vector>

#include "common/config/config.h"
#include "common/time/timestamp.h"

namespace deixis::gesture_recogniser {

struct MotionConfig {
  double step_s = 1.0 / 15.0;  ///< Time between two samples of the motion, whatever the frame rate.
  double history_s = 2.4;      ///< How far back the motion is kept.
  double longest_gap_s = 0.6;  ///< A longer gap between images starts the motion anew.

  template <typename Visitor>
  void Visit(Visitor& v) {
    v("step_s", step_s);
    v("history_s", history_s);
    v("longest_gap_s", longest_gap_s);
  }
  void Validate() const;
};

/// Where a hand was in one image.
struct TrackPoint {
  Timestamp time;
  Eigen::Vector2d position_px = Eigen::Vector2d::Zero();
  double sigma_px = 1.0;    ///< Standard deviation of the position, per axis.
  bool is_measured = true;  ///< False: predicted, merged or hidden.
};

/// Smallest equal angle, in (-pi, pi].
double WrapAngle(double angle_rad);

/// The motion of one hand at equal steps back from the newest image: index 0 is now. Metres in the
/// image plane at the person's distance. All vectors have the same length.
struct Motion {
  double step_s = 0.0;
  double elapsed_s = 0.0;  ///< Since the image before the newest; 0 = the first.
  double sigma_m = 0.0;    ///< Of the newest position, per axis.
  std::vector<Eigen::Vector2d> position_m;
  std::vector<double> speed_m_per_s;          ///< Delta r: between sample i + 1 and i.
  std::vector<double> turn_rad;               ///< Delta gamma: change of direction at sample i + 1.
  std::vector<double> centred_speed_m_per_s;  ///< Between samples i + 1 and i - 1: half the noise.
  std::vector<bool> is_measured;
  Eigen::Vector2d direction = Eigen::Vector2d::Zero();  ///< Of the newest step; unit or zero.

  std::size_t size() const { return position_m.size(); }
};

/// Collects the points of one hand and gives its motion at fixed steps.
class MotionHistory {
 public:
  explicit MotionHistory(const MotionConfig& config) : config_(config) {}

  /// Returns false when the motion begins anew with this point: the first one, a long gap, or time
  /// that does not go forwards. What was only predicted is forgotten when the hand is seen again:
  /// the straight way between two sights is a better guess.
  bool Add(const TrackPoint& point);

  /// Where the hand was seen last; nothing while it never was.
  std::optional<TrackPoint> LastSight() const;

  /// The motion, seen with `px_per_m` pixels to the metre. Valid until the next call.
  const Motion& Sample(double px_per_m);

 private:
  void ForgetPredictions();
  void SamplePositions(double px_per_m);
  /// Adds the position `age_s` ago, on the straight way between two points.
  void SampleBetween(std::size_t newer, std::size_t older, double age_s, double px_per_m);
  double Age(std::size_t point) const;
  void Differentiate();

  MotionConfig config_;
  std::deque<TrackPoint> points_;  // Newest first.
  Motion motion_;
};

}  // namespace deixis::gesture_recogniser
