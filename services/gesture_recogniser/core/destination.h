#pragma once
#include <Eigen/Core>
#include <optional>
#include <vector>

#include "common/config/config.h"
#include "services/gesture_recogniser/core/gesture_model.h"
#include "services/gesture_recogniser/core/hand_recogniser.h"

namespace deixis::gesture_recogniser {

struct DestinationConfig {
  double elsewhere_weight = 0.3;  ///< How often strokes end at no known place, relative to objects.
  double rest_weight = 1.0;       ///< ... at the rest place.
  double face_weight = 1.0;       ///< ... at the own face.
  double reach_m2 = 1.2;          ///< Area in the image plane that a hand can reach.
  double rest_spread_m = 0.05;    ///< How exactly hands return to rest.
  double face_spread_m = 0.03;    ///< How far beside the face a hand that touches it may be.
  double gap_extra_m = 0.015;     ///< Added to the spread of the gap: boxes are not exact.
  double stray_share = 0.07;      ///< Share of gestures that arrive from just anywhere.
  double rest_return_m = 0.05;    ///< A stroke that comes nearer to rest than it began ends there.
  double arrival_s = 0.2;         ///< Last part of the way that tells the direction.
  double elbow_sag = 0.6;         ///< How far elbows hang, 0..1 of what the arm's length allows.
  bool use_posture = true;        ///< Use the direction of the forearm, guessed from face and hand.

  template <typename Visitor>
  void Visit(Visitor& v) {
    v("elsewhere_weight", elsewhere_weight);
    v("rest_weight", rest_weight);
    v("face_weight", face_weight);
    v("reach_m2", reach_m2);
    v("rest_spread_m", rest_spread_m);
    v("face_spread_m", face_spread_m);
    v("gap_extra_m", gap_extra_m);
    v("stray_share", stray_share);
    v("rest_return_m", rest_return_m);
    v("arrival_s", arrival_s);
    v("elbow_sag", elbow_sag);
    v("use_posture", use_posture);
  }
  void Validate() const;
};

/// A stroke that ended: where it came from and where it stopped.
struct Arrival {
  Eigen::Vector2d position_m = Eigen::Vector2d::Zero();  ///< Mean of the hold.
  double sigma_m = 0.0;                                  ///< Of that mean.
  Eigen::Vector2d way_m = Eigen::Vector2d::Zero();       ///< Last part of the way.
  double way_sigma_m = 0.0;                              ///< Of the way, per axis.
  double nearest_rest_m = 0.0;  ///< Distance to the rest place about the time when it began.
};

/// Log-densities of an arrival for every place where it may have been meant to go. Units: per m^2
/// and rad, so that they can be compared.
struct DestinationDensities {
  std::vector<double> target;  ///< Prior included.
  double elsewhere = 0.0;
  double rest = 0.0;
  double face = 0.0;
};

/// About where a shoulder is, from the face, for a person who faces the camera. Metres.
Eigen::Vector2d ShoulderFromFace(const scene::Box& face_m, scene::Side side);

/// Where the forearm points in the image, guessed from a planar arm of usual length whose elbow
/// hangs below the line from shoulder to hand: `sag` = 0 not at all, 1 as far as it can. Not
/// normalised.
Eigen::Vector2d ForearmDirection(const Eigen::Vector2d& shoulder_m, const Eigen::Vector2d& hand_m,
                                 double sag);

/// Tells where strokes were meant to go.
class Destinations {
 public:
  Destinations(const DestinationConfig& config, const TargetStatistics& statistics);

  DestinationDensities Judge(const Arrival& arrival, const Surroundings& surroundings,
                             const std::optional<Eigen::Vector2d>& rest_m, scene::Side side) const;

 private:
  /// What of an arrival is the same for every target.
  struct Approach {
    const Arrival& arrival;
    double way_sigma_rad = 0.0;              ///< Of the way's direction.
    double log_share = 0.0;                  ///< Prior of each target.
    std::optional<Eigen::Vector2d> forearm;  ///< Its direction; nothing = not known.
  };

  double LogTarget(const Approach& approach, const scene::Box& box_m) const;
  double WaySigma(const Arrival& arrival) const;
  double LogGap(const scene::Box& box_m, const Arrival& arrival) const;
  double LogDirection(const Eigen::Vector2d& direction, double sigma_rad,
                      const Eigen::Vector2d& way) const;
  double LogRest(const Arrival& arrival, const Eigen::Vector2d& rest_m) const;
  double LogFace(const Arrival& arrival, const scene::Box& face_m) const;

  DestinationConfig config_;
  TargetStatistics statistics_;
};

}  // namespace deixis::gesture_recogniser
