#pragma once
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "common/body_model/tracked_body.h"
#include "common/geometry/stereo_calibration.h"
#include "common/images/depth_image.h"
#include "services/pose_fitter/core/bodies/followed_person.h"
#include "services/pose_fitter/core/bodies/person_body.h"
#include "services/pose_fitter/core/cues/seen_parts.h"
#include "services/pose_fitter/core/depth/depth_view.h"
#include "services/pose_fitter/core/depth/sound_depth.h"
#include "services/pose_fitter/core/floor/floor_tracker.h"
#include "services/pose_fitter/core/people/background_model.h"
#include "services/pose_fitter/core/people/people_finder.h"
#include "services/pose_fitter/core/people/person_tracks.h"
#include "services/pose_fitter/core/start/searched_places.h"
#include "services/pose_fitter/core/start/starter.h"

namespace deixis::pose_fitter {

struct PoseFitterConfig {
  std::string body_model = "body_models/clothed_body.yaml";  ///< The tree of limbs.
  FitMethod method = FitMethod::kArticulated;  ///< How bodies are fitted: articulated or limb_icp.
  double stature_m = 0.0;                      ///< Of the people who come; 0 = not known.
  double stature_sigma_m = 0.01;               ///< Its spread.
  double guessed_sigma_m = 0.06;  ///< Of a stature that is told from the height of the head.
  double search_s = 0.3;          ///< How often new people are looked for.
  double most_taken = 0.3;        ///< Share of a region that those who are followed may have of it.
  double least_moved = 0.05;  ///< Share of a region that has moved since people were last looked
                              ///< for, of who is explained badly: furniture does not.
  SoundDepthConfig sound;
  FloorTrackerConfig floor;
  BackgroundModelConfig background;
  PeopleFinderConfig people;
  PersonTracksConfig tracks;
  StarterConfig start;
  SeenPartsConfig cues;
  FollowConfig follow;
  LimbSearchConfig limbs;
  BodyEvidenceConfig evidence;
  BodyFitterConfig fit;    ///< By method articulated.
  LimbIcpConfig limb_icp;  ///< By method limb_icp.
  ShapeConfig shape;

  template <typename Visitor>
  void Visit(Visitor& v) {
    v("body_model", body_model);
    v("method", method);
    v("stature_m", stature_m);
    v("stature_sigma_m", stature_sigma_m);
    v("guessed_sigma_m", guessed_sigma_m);
    v("search_s", search_s);
    v("most_taken", most_taken);
    v("least_moved", least_moved);
    v("sound", sound);
    v("floor", floor);
    v("background", background);
    v("people", people);
    v("tracks", tracks);
    v("start", start);
    v("cues", cues);
    v("follow", follow);
    v("limbs", limbs);
    v("evidence", evidence);
    v("fit", fit);
    v("limb_icp", limb_icp);
    v("shape", shape);
  }
  void Validate() const;  ///< Throws FaultsFound.
};

/// Somebody who is followed no longer.
struct GonePerson {
  body_model::BodyPose pose;
  double time_s = 0.0;
};

/// Follows the people in the images of one depth camera.
class PoseFitter {
 public:
  /// Throws ConfigError when the body model cannot be had.
  explicit PoseFitter(const PoseFitterConfig& config);

  /// Everybody in the next image. Throws std::logic_error when the image is none (not CV_16UC1,
  /// empty).
  const body_model::BodyPoses& Track(const images::DepthImage& image,
                                     const geometry::StereoCalibration& calibration);

  /// Hands and faces recognised in the pictures, at any time before the image that they are to help
  /// with.
  void See(const scene::Hands& hands) { parts_.Update(hands); }
  void See(const scene::Objects& objects) { parts_.Update(objects); }

  /// Models of all bodies of the last result.
  std::vector<body_model::PersonModel> Models() const;

 private:
  void Forget();
  void ShareCues(const std::vector<PartCue>& cues);
  std::vector<PartCue>* OwnerOf(const PartCue& cue);  ///< nullptr = nobody.
  void FollowAll(const std::vector<std::uint8_t>& foreground, double seconds, double time_s);
  void LearnRoom(const std::vector<std::uint8_t>& is_sound, double seconds);
  void FindNew(const std::vector<std::uint8_t>& is_sound, double time_s);
  void NoteDepth(double time_s);
  void SeeHeads();
  void Meet(const PersonRegion& region, double time_s, Effort& effort);
  void Search(double time_s, Effort& effort);
  void Conclude(double time_s);
  std::size_t Dress(std::vector<Hypothesis>& starts);
  void Recall(std::vector<Hypothesis>& starts) const;
  double MovedShare(const PersonRegion& region) const;
  bool IsOfSomebody(FollowedPerson& other) const;
  bool HasStrayHead(const PersonRegion& region) const;
  std::vector<PersonBody> BodiesOf(const PersonRegion& region) const;
  void Take(std::size_t person);
  int TakenPixels(const PersonRegion& region, std::vector<int>& by_person) const;
  void Number(double time_s);
  void Report(const images::DepthImage& image);

  PoseFitterConfig config_;
  BodyMaker maker_;
  DepthView view_;
  SoundDepth sound_;
  FloorTracker floor_tracker_;
  std::optional<body_model::Floor> floor_;
  BackgroundModel background_;
  PeopleFinder finder_;
  Starter starter_;
  PersonTracks tracks_;
  SeenParts parts_;
  std::vector<std::vector<PartCue>> own_cues_;  ///< Of each of people_.
  std::vector<std::unique_ptr<FollowedPerson>> people_;
  std::vector<GonePerson> gone_;
  std::vector<float> noted_m_, moved_from_m_;  ///< Depth of a while ago, and of one before that.
  std::optional<double> noted_time_s_;
  std::vector<std::uint8_t> taken_;     ///< Per pixel: 0 = nobody's, else 1 + the person's place.
  std::vector<std::uint8_t> occupied_;  ///< Per pixel: whether it is near to somebody's limbs.
  std::optional<Timestamp> last_time_;
  std::optional<double> last_search_s_;  ///< When all regions had been met.
  /// What is searched now.
  struct Quest {
    Eigen::Vector3d centre_m;
    std::vector<PersonBody> bodies;  ///< That somebody new may have, the likeliest first.
    int owner = -1;                  ///< Else whom it may tell of another pose.
    bool moves = false;              ///< Somebody new.
  };
  std::optional<Quest> quest_;
  SearchedPlaces searched_;
  body_model::BodyPoses poses_;
};

}  // namespace deixis::pose_fitter
