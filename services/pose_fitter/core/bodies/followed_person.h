#pragma once
#include <memory>
#include <optional>
#include <vector>

#include "common/body_model/tracked_body.h"
#include "services/pose_fitter/core/bodies/hypothesis.h"
#include "services/pose_fitter/core/bodies/limb_search.h"
#include "services/pose_fitter/core/bodies/person_body.h"
#include "services/pose_fitter/core/fitting/body_evidence.h"
#include "services/pose_fitter/core/fitting/method_choice.h"
#include "services/pose_fitter/core/shape/shape_calibration.h"
#include "services/pose_fitter/core/start/starter.h"

namespace deixis::pose_fitter {

struct FollowConfig {
  double velocity_share = 0.6;      ///< Of the motion that goes on from image to image.
  double settle_s = 0.5;            ///< Time that rival poses have to prove themselves.
  double doubtful_score = 0.4;      ///< From here on other poses of the person are tried.
  double proven_score = 0.35;       ///< Who was once explained so well is somebody,
  double turned_about = 0.3;        ///< Added to the score of rivals that look the other way.
  double lost_score = 0.8;          ///< and only gone from here on; others by `worst_score`.
  int least_points = 50;            ///< With fewer a person is not seen.
  double position_sigma_m = 0.010;  ///< Spread of joint places that a fit does not know of.
  double unseen_rad = 0.45;         ///< Spread of the angles of a limb that is not seen at all.
  double covariance_factor = 1.0;   ///< Times the covariance that a fit believes in.
  int shape_frames = 20;            ///< Well seen images that a person's shape is learned from;
                                    ///< again from twice and from four times as many; 0 = never.
  double shape_period_s = 0.15;     ///< Between two of them.
  double shape_score = 0.4;         ///< Images with a worse one are not taken.
  int shape_points = 400;           ///< Taken from each.
  int shape_work = 4;               ///< Of them so many are looked at again in each image.

  template <typename Visitor>
  void Visit(Visitor& v) {
    v("velocity_share", velocity_share);
    v("settle_s", settle_s);
    v("doubtful_score", doubtful_score);
    v("proven_score", proven_score);
    v("turned_about", turned_about);
    v("lost_score", lost_score);
    v("least_points", least_points);
    v("position_sigma_m", position_sigma_m);
    v("unseen_rad", unseen_rad);
    v("covariance_factor", covariance_factor);
    v("shape_frames", shape_frames);
    v("shape_period_s", shape_period_s);
    v("shape_score", shape_score);
    v("shape_points", shape_points);
    v("shape_work", shape_work);
  }
  void Validate() const;  ///< Throws FaultsFound.
};

/// All that following a person needs to know.
struct FollowSettings {
  FollowConfig follow;
  StarterConfig start;
  LimbSearchConfig limbs;
  BodyEvidenceConfig evidence;
  FitSettings fit;
  ShapeConfig shape;
};

/// A person who is followed from image to image, by one pose or, while that is in doubt, by
/// several.
class FollowedPerson {
 public:
  /// `starts`: at least one. `plan` must outlive it.
  FollowedPerson(const FollowSettings& settings, const PersonBody& body,
                 const body_model::BodyPlan& plan, std::vector<Hypothesis> starts);

  /// Gathers what the image says around the poses, and their pixels, without moving them.
  void Look(const DepthView& view, const std::optional<body_model::Floor>& floor);
  /// Moves on to the next image, `seconds` later.
  void Follow(const DepthView& view, const std::optional<body_model::Floor>& floor,
              const ImageContext& context, double seconds);
  /// Other poses that it may have.
  void AddRivals(std::vector<Hypothesis> rivals);

  /// As pose_fitter::Reaches, of its last pose.
  double Reaches(const PartCue& cue);

  /// Sets the pixels whose points its limbs explain, or that are next to such.
  void MarkLimbs(std::vector<std::uint8_t>& pixels) const;

  int id = -1;  ///< Track; -1 = none yet.
  const Hypothesis& best() const { return hypotheses_.front(); }
  const BodyEvidence& evidence() const { return evidence_; }
  const body_model::BodyModel& model() const { return *model_; }
  /// Nothing where the model has no head.
  std::optional<Eigen::Vector3d> HeadMiddle_m();
  /// Whether the image shows a head where the body has it. Somebody with a head is there, however
  /// badly he is explained.
  void SeeHead(bool is_seen) { has_head_ = is_seen; }
  double unseen_s() const { return unseen_s_; }
  bool IsDoubtful() const;
  bool IsNobody() const;  ///< It has been explained badly for too long.
  body_model::TrackedBody Describe();
  body_model::PersonModel DescribeModel(Timestamp time) const;

 private:
  void Fit(const std::optional<body_model::Floor>& floor, const body_model::BodyPose& predicted,
           double seconds, Hypothesis& hypothesis);
  void MakeLimbSearch();
  void Choose();
  void Remember(double seconds);
  void LearnShape();
  void Wear(const CalibratedShape& shape);
  void AddUnseen(Eigen::MatrixXd& covariance) const;
  void AddSize(body_model::TrackedBody& body) const;
  /// 0 x 0 = not known.
  Eigen::MatrixXd CovarianceOf(const Eigen::MatrixXd& information) const;

  FollowSettings settings_;
  const body_model::BodyPlan* plan_;
  anthropometry::PersonEstimate estimate_;
  std::unique_ptr<body_model::BodyModel> first_model_;  ///< Before anything was learned.
  std::unique_ptr<body_model::BodyModel> model_;
  std::unique_ptr<body_model::Kinematics> kinematics_;
  std::unique_ptr<PoseMethod> fitter_;
  BodyEvidence evidence_;
  std::vector<Hypothesis> hypotheses_;  ///< The best one first.
  std::unique_ptr<LimbSearch> search_;
  bool is_proven_ = false;
  bool has_head_ = false;
  double unseen_s_ = 0.0;
  std::vector<ShapeFrame> frames_;
  double since_frame_s_ = 0.0;
  std::unique_ptr<ShapeCalibration> lesson_;  ///< What is being learned.
  int next_lesson_ = 0;  ///< Number of frames that the shape is learned from next; 0 = no more.
};

}  // namespace deixis::pose_fitter
