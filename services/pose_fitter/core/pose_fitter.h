#pragma once
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "common/body_model/body_plan.h"
#include "common/body_model/tracked_body.h"
#include "common/geometry/stereo_calibration.h"
#include "common/images/depth_image.h"
#include "services/pose_fitter/core/depth/depth_view.h"
#include "services/pose_fitter/core/depth/sound_depth.h"
#include "services/pose_fitter/core/fitting/body_evidence.h"
#include "services/pose_fitter/core/fitting/body_fitter.h"
#include "services/pose_fitter/core/floor/floor_tracker.h"
#include "services/pose_fitter/core/people/people_finder.h"
#include "services/pose_fitter/core/people/person_tracks.h"

namespace deixis::pose_fitter {

struct StartConfig {
  int iterations = 12;          ///< Of the fit of each start pose.
  double first_scale_m = 0.1;   ///< Of its robust weights, in the first round.
  double first_reach_m = 0.25;  ///< Points farther from all limbs do not count, in the first round.
  double rest_rad = 0.5;        ///< Spread of all joints about the start pose, in its first fit.
  double upright_rad = 0.25;    ///< Of the base limb about the vertical, likewise.
  double worst_score = 0.6;     ///< Fits that are worse are nobody.
  double doubtful_score = 0.4;  ///< From here on other poses of the person are tried.
  double least_trunk = 0.5;     ///< Share of trunk and head that must be seen.
  double facing_away = 0.04;    ///< Added to the score of who turns the back: robots are looked at.
  double settle_s = 0.5;        ///< Time that rival poses have to prove themselves.
  double gate_m = 0.2;          ///< Pixels this near to a start pose may belong to the person.
  double head_m = 0.25;         ///< Height of the part of a region that is taken for the head.
  double again_s = 0.3;         ///< Between two tries.
  double most_taken = 0.3;      ///< Share of a region that those who are followed may have of it.

  template <typename Visitor>
  void Visit(Visitor& v) {
    v("iterations", iterations);
    v("first_scale_m", first_scale_m);
    v("first_reach_m", first_reach_m);
    v("rest_rad", rest_rad);
    v("upright_rad", upright_rad);
    v("worst_score", worst_score);
    v("doubtful_score", doubtful_score);
    v("least_trunk", least_trunk);
    v("facing_away", facing_away);
    v("settle_s", settle_s);
    v("gate_m", gate_m);
    v("head_m", head_m);
    v("again_s", again_s);
    v("most_taken", most_taken);
  }
  void Validate() const;  ///< Throws FaultsFound.
};

struct PoseFitterConfig {
  std::string body_model = "body_models/clothed_body.yaml";  ///< The tree of limbs.
  double stature_m = 0.0;           ///< Of the people who come; 0 = not known.
  double stature_sigma_m = 0.01;    ///< Its spread.
  double velocity_share = 0.6;      ///< Of the motion that goes on from image to image.
  double position_sigma_m = 0.012;  ///< Spread of joint places that the fit does not know of.
  double covariance_factor = 1.0;   ///< Times the covariance that the fit believes in.
  SoundDepthConfig sound;
  FloorTrackerConfig floor;
  PeopleFinderConfig people;
  PersonTracksConfig tracks;
  StartConfig start;
  BodyEvidenceConfig evidence;
  BodyFitterConfig fit;

  template <typename Visitor>
  void Visit(Visitor& v) {
    v("body_model", body_model);
    v("stature_m", stature_m);
    v("stature_sigma_m", stature_sigma_m);
    v("velocity_share", velocity_share);
    v("position_sigma_m", position_sigma_m);
    v("covariance_factor", covariance_factor);
    v("sound", sound);
    v("floor", floor);
    v("people", people);
    v("tracks", tracks);
    v("start", start);
    v("evidence", evidence);
    v("fit", fit);
  }
  void Validate() const;  ///< Throws FaultsFound.
};

/// Follows the people in the images of one depth camera.
class PoseFitter {
 public:
  /// Throws ConfigError when the body model cannot be had.
  explicit PoseFitter(const PoseFitterConfig& config);
  ~PoseFitter();

  /// Everybody in the next image. Throws std::logic_error when the image is none (not CV_16UC1,
  /// empty).
  const body_model::BodyPoses& Track(const images::DepthImage& image,
                                     const geometry::StereoCalibration& calibration);

  /// Models that bodies of the last result are of.
  std::vector<body_model::PersonModel> Models() const;

 private:
  struct Hypothesis;
  struct Person;
  void Follow(Person& person, double seconds);
  void Fit(Person& person, Hypothesis& hypothesis, const body_model::BodyPose& predicted,
           double seconds);
  void Choose(Person& person);
  double FacingPenalty(const body_model::BodyPose& pose) const;
  body_model::BodyPose Predict(const Hypothesis& hypothesis, double seconds) const;
  void Take(const Person& person);
  void FindNew(const std::vector<std::uint8_t>& is_sound, double time_s);
  bool IsTaken(const PersonRegion& region) const;
  void Number(double time_s);
  void LetGo();
  std::unique_ptr<Person> Start(const PersonRegion& region);
  std::vector<Hypothesis> StartsIn(const PersonRegion& region, BodyFitter& fitter,
                                   BodyEvidence& evidence);
  void Doubt(const PersonRegion& region);
  Person* OwnerOf(const PersonRegion& region);
  void Report(const images::DepthImage& image);

  PoseFitterConfig config_;
  body_model::BodyModel model_;
  double stature_m_ = 0.0;
  DepthView view_;
  SoundDepth sound_;
  FloorTracker floor_tracker_;
  std::optional<body_model::Floor> floor_;
  PeopleFinder finder_;
  PersonTracks tracks_;
  std::optional<double> last_try_s_;
  std::vector<std::uint8_t> taken_;  ///< Per pixel: 0 = nobody's, else 1 + the person's place.
  std::vector<std::unique_ptr<Person>> people_;
  BodyEvidence start_evidence_;
  std::optional<Timestamp> last_time_;
  body_model::BodyPoses poses_;
};

}  // namespace deixis::pose_fitter
