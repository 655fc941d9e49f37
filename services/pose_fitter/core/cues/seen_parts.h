#pragma once
#include <optional>
#include <vector>

#include "common/scene/hand.h"
#include "common/scene/object.h"
#include "services/pose_fitter/core/cues/part_cue.h"
#include "services/pose_fitter/core/depth/depth_view.h"

namespace deixis::pose_fitter {

struct SeenPartsConfig {
  double oldest_s = 0.2;         ///< Hands and faces seen longer ago do not count.
  double hand_px = 6.0;          ///< Error of a tracked hand beside what the tracker states,
  double face_px = 4.0;          ///< and of a face's centre; pixels of the published picture.
  double merged_trust = 0.5;     ///< In a hand that shares a region with something.
  double face_trust = 0.1;       ///< In a hand at a face: it may be the face's own skin.
  double face_m = 0.15;          ///< So near to its middle is at a face.
  double elsewhere_trust = 0.2;  ///< In what is measured out of everybody's reach.
  double acceleration_px_per_s2 = 1500.0;  ///< One sigma of what moves on since it was seen.

  template <typename Visitor>
  void Visit(Visitor& v) {
    v("oldest_s", oldest_s);
    v("hand_px", hand_px);
    v("face_px", face_px);
    v("merged_trust", merged_trust);
    v("face_trust", face_trust);
    v("face_m", face_m);
    v("elsewhere_trust", elsewhere_trust);
    v("acceleration_px_per_s2", acceleration_px_per_s2);
  }
  void Validate() const;  ///< Throws FaultsFound.
};

/// Keeps the last hands and faces that others have recognised, and tells where they are in the next
/// depth image.
class SeenParts {
 public:
  explicit SeenParts(const SeenPartsConfig& config) : config_(config) {}

  void Update(const scene::Hands& hands) { hands_ = hands; }
  void Update(const scene::Objects& objects) { objects_ = objects; }

  /// What is known of at the time of `view`, whose picture was published with `picture_px`. What
  /// comes from a later image, from one too old or from another camera's does not count. Holds
  /// until the next call.
  const std::vector<PartCue>& At(Timestamp time, const std::string& camera,
                                 const Eigen::Vector2d& picture_px, const DepthView& view);

 private:
  void AddHand(const scene::Hand& hand, double age_s, const Eigen::Vector2d& scale,
               const DepthView& view);
  void AddFace(const scene::Object& face, double age_s, const Eigen::Vector2d& scale,
               const DepthView& view);
  void DoubtHandsAtFaces();
  /// Nothing when it is of no use: out of view, as uncertain as the view is wide, or one too many.
  PartCue* Add(Part part, const Eigen::Vector2d& pixel_px, double sigma_px, const DepthView& view);

  SeenPartsConfig config_;
  std::optional<scene::Hands> hands_;
  std::optional<scene::Objects> objects_;
  std::vector<PartCue> cues_;
};

}  // namespace deixis::pose_fitter
