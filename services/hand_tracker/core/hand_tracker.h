#pragma once
#include <opencv2/core/mat.hpp>
#include <optional>
#include <vector>

#include "common/config/config.h"
#include "common/images/image.h"
#include "common/scene/hand.h"
#include "common/scene/object.h"
#include "common/skin/skin_model.h"
#include "services/hand_tracker/core/background_model.h"
#include "services/hand_tracker/core/hand_roles.h"
#include "services/hand_tracker/core/hand_tracks.h"
#include "services/hand_tracker/core/people.h"
#include "services/hand_tracker/core/skin_regions.h"
#include "services/hand_tracker/core/working_image.h"

namespace deixis::hand_tracker {

struct HandTrackerConfig {
  int working_width_px = 320;      ///< Width at which images are searched.
  int low_threshold = 150;         ///< Evidence (0..255) from which a pixel belongs to a region.
  int high_threshold = 200;        ///< Evidence that a region must reach somewhere.
  double thinnest = 0.1;           ///< Skin thinner than about this is smoothed away, hand lengths.
  double largest_held_area = 2.5;  ///< Of an arm kept out of the background, hand lengths squared.
  double report_time_s = 0.5;      ///< Hands unseen for longer are no longer told.
  double face_memory_s = 10.0;     ///< How long a face that is out of sight still counts.
  double learn_interval_s = 0.25;  ///< Time between two looks at what skin and scene look like.
  double longest_gap_s = 2.0;      ///< A longer gap between images starts everything anew.
  skin::SkinModelConfig skin;
  BackgroundModelConfig background;
  HandTracksConfig tracks;
  HandRolesConfig roles;

  template <typename Visitor>
  void Visit(Visitor& v) {
    v("working_width_px", working_width_px);
    v("low_threshold", low_threshold);
    v("high_threshold", high_threshold);
    v("thinnest", thinnest);
    v("largest_held_area", largest_held_area);
    v("report_time_s", report_time_s);
    v("face_memory_s", face_memory_s);
    v("learn_interval_s", learn_interval_s);
    v("longest_gap_s", longest_gap_s);
    v("skin", skin);
    v("background", background);
    v("tracks", tracks);
    v("roles", roles);
  }
  void Validate() const;
};

/// Hands of the people in a picture, found by the colour of their skin and by their motion and
/// followed by Kalman filters (Hofemann, Fritsch, Sagerer 2004, section 3).
class HandTracker {
 public:
  explicit HandTracker(const HandTrackerConfig& config = {});

  /// Takes in the newest faces; they may belong to an earlier image.
  void UpdateFaces(const scene::Objects& objects);

  /// Hands in `image`. A time that goes backwards, a long gap or another size starts anew.
  scene::Hands Track(const images::Image& image);

  /// The candidates that the last image showed.
  const Observation& observation() const { return observation_; }

 private:
  bool MovesInside(const scene::Box& box) const;
  double Advance(const images::Image& image);
  void Reset();
  void HoldHands();
  void LearnColours();
  cv::Mat SceneMask() const;
  void FindEvidence();
  Observation Observe(double elapsed_s);
  void GuessUnknownHand(double longest_px, double elapsed_s);
  scene::Hands Report(const images::Image& image) const;

  HandTrackerConfig config_;
  skin::SkinModel skin_;
  BackgroundModel background_;
  People people_;
  HandTracks tracks_;
  HandRoles roles_;

  std::optional<Timestamp> time_;  ///< Of the last image.
  cv::Size size_;                  ///< Of the last image.
  double since_learning_s_ = 0.0;
  std::vector<Person> persons_;  ///< Established at the last image.
  Observation observation_;
  WorkingImage working_;
  cv::Mat previous_;  // The last working image, light evened out.
  cv::Mat fresh_;     // Where it differs from this one.
  cv::Mat evidence_;
  cv::Mat moving_;                   ///< Evidence where the picture just changed.
  std::vector<SkinRegion> regions_;  ///< Of the evidence.
  double unknown_hand_px_ = 1.0;     ///< Length of a hand without a face, working pixels.
  cv::Mat held_;                     ///< CV_8UC1, working size: must not become background.
};

}  // namespace deixis::hand_tracker
