#pragma once
#include "common/body_model/joint_angles.h"
#include "services/pose_fitter/core/bodies/hypothesis.h"
#include "services/pose_fitter/core/fitting/body_evidence.h"
#include "services/pose_fitter/core/fitting/body_fitter.h"
#include "test/services/pose_fitter/synthetic_body.h"

namespace deixis::pose_fitter::test {

/// Somebody with both arms raised, and the same believed to let the right arm hang.
class LostLimb {
 public:
  LostLimb() {
    view_.Update(picture_.camera, picture_.depth_mm);
    const auto hanging = body_model::Standing(model_);
    for (const char* name :
         {"right_clavicle", "right_upper_arm", "right_lower_arm", "right_hand"}) {
      const int limb = *model_.Find(name);
      const auto count = model_.limbs()[static_cast<std::size_t>(limb)].dofs.size();
      believed_.angles_rad.segment(model_.first_angle(limb), static_cast<Eigen::Index>(count)) =
          hanging.angles_rad.segment(model_.first_angle(limb), static_cast<Eigen::Index>(count));
    }
  }
  /// `pose` and what the picture says around it, without a step of a fit.
  Hypothesis See(const body_model::BodyPose& pose, const ImageContext& context = {}) {
    evidence_.Gather(view_, kinematics_, {&pose}, std::nullopt, context, 0.12);
    Hypothesis now;
    now.pose = pose;
    body_model::BodyPose fitted = pose;
    now.result = fitter_.Fit(evidence_, std::nullopt, pose, std::nullopt, fitted);
    now.rates_rad_per_s.setZero(model_.angle_count());
    kinematics_.Update(pose);
    return now;
  }
  Eigen::Vector3d Wrist_m(const body_model::BodyPose& pose) const {
    body_model::Kinematics kinematics(model_);
    kinematics.Update(pose);
    return kinematics.proximal_m(*model_.Find("right_hand"));
  }

  body_model::BodyModel model_ = BodyOf("clothed_body");
  body_model::BodyPose truth_ = Gesturing(model_), believed_ = truth_;
  BodyPicture picture_ = Look(model_, truth_, 240, 0.003);
  DepthView view_;
  body_model::Kinematics kinematics_{model_};
  BodyEvidence evidence_{BodyEvidenceConfig{}};
  BodyFitter fitter_{BodyFitterConfig{}, model_};
};

}  // namespace deixis::pose_fitter::test
