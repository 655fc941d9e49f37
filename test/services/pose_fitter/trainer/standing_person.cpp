#include "test/services/pose_fitter/trainer/standing_person.h"

#include <Eigen/Geometry>

#include "common/anthropometry/person_estimate.h"
#include "common/body_model/joint_angles.h"
#include "common/body_model/kinematics.h"
#include "services/pose_fitter/trainer/clothed_plan.h"

namespace deixis::pose_fitter {
namespace {

using Eigen::Vector3d;

const std::string kConfig = DEIXIS_SOURCE_DIR "/config/";

class Marked {
 public:
  Marked(const body_model::BodyModel& model, const body_model::BodyPose& pose)
      : model_(model), kinematics_(model) {
    kinematics_.Update(pose);
  }
  void Add(const std::string& marker, const std::string& limb, const Vector3d& place_m) {
    markers_[marker] = kinematics_.limb(model_.Find(limb).value()) * place_m;
  }
  Markers markers() const { return markers_; }

 private:
  const body_model::BodyModel& model_;
  body_model::Kinematics kinematics_;
  Markers markers_;
};

void AddSide(const std::string& side, const std::string& limb, Marked& marked) {
  const Vector3d joint = Vector3d::Zero();
  marked.Add(side + "shoulder", limb + "upper_arm", joint);
  marked.Add(side + "elbow", limb + "lower_arm", joint);
  marked.Add(side + "wrist", limb + "hand", joint);
  marked.Add(side + "hip", limb + "thigh", joint);
  marked.Add(side + "knee", limb + "shank", joint);
  marked.Add(side + "ankle", limb + "foot", joint);
  marked.Add(side + "hand", limb + "hand", {0.0, 0.0, 0.06});
  const double towards_palm = limb == "left_" ? 1.0 : -1.0;
  marked.Add(side + "fingertip", limb + "hand", {0.02, 0.02 * towards_palm, 0.15});
  marked.Add(side + "foot", limb + "foot", {-0.04, 0.0, 0.08});
}

}  // namespace

body_model::Sizes TallSizes() {
  return anthropometry::SizesOf(
      anthropometry::Populations::Load(kConfig + "kinematics/population.yaml"),
      anthropometry::Sex::kMale, 1.8);
}

body_model::BodyPlan StartPlan() {
  return ClothedPlan(body_model::LoadBodyPlan(kConfig + "body_models/whole_body_detailed.yaml"));
}

Markers MarkersOf(const body_model::BodyModel& model, const body_model::BodyPose& pose) {
  const auto thigh = static_cast<std::size_t>(model.Find("right_thigh").value());
  const double hips_m = model.limbs()[thigh].rest_in_parent.translation_m.z();
  Marked marked(model, pose);
  marked.Add("pelvis", "pelvis", {0.0, 0.0, hips_m});
  marked.Add("spine", "abdomen", Vector3d::Zero());
  marked.Add("chest", "chest", Vector3d::Zero());
  marked.Add("neck", "neck", Vector3d::Zero());
  marked.Add("head", "head", Vector3d::Zero());
  marked.Add("head_top", "head", {0.03, 0.0, 0.16});
  marked.Add("nose", "head", {0.12, 0.0, 0.0});
  marked.Add("chin", "head", {0.08, 0.0, -0.08});
  AddSide("r_", "right_", marked);
  AddSide("l_", "left_", marked);
  return marked.markers();
}

geometry::RigidTransform CameraFromRoot() {
  Eigen::Matrix3d axes;
  axes << 0, 1, 0, 0, 0, -1, -1, 0, 0;
  return {Eigen::Quaterniond(axes), {0.1, 0.2, 2.5}};
}

RenderedPerson StandingPerson(const body_model::BodyModel& model) {
  RenderedPerson person;
  person.id = "somebody";
  person.stature_m = 1.8;
  body_model::BodyPose pose = body_model::Standing(model);
  pose.frame_from_root = CameraFromRoot();
  person.frames = {MarkersOf(model, pose)};
  const auto length = [&model](const std::string& limb) {
    return model.limbs()[static_cast<std::size_t>(model.Find(limb).value())].shape.length_m;
  };
  person.lengths_m = {{"stature", 1.8},
                      {"r_upper_arm", length("right_upper_arm")},
                      {"r_forearm", length("right_lower_arm")},
                      {"r_hand", length("right_hand")},
                      {"r_thigh", length("right_thigh")},
                      {"r_lower_leg", length("right_shank")},
                      {"r_foot", length("right_foot")}};
  return person;
}

}  // namespace deixis::pose_fitter
