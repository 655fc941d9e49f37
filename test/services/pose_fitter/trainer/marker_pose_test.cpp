#include "services/pose_fitter/trainer/marker_pose.h"

#include <gtest/gtest.h>

#include <random>

#include "common/body_model/joint_angles.h"
#include "common/body_model/kinematics.h"
#include "test/services/pose_fitter/trainer/standing_person.h"

namespace deixis::pose_fitter {
namespace {

using body_model::BodyModel;
using body_model::BodyPose;

BodyPose AnyPose(const BodyModel& model, std::mt19937& random) {
  BodyPose pose = body_model::Standing(model);
  int index = 0;
  for (const body_model::Limb& limb : model.limbs()) {
    for (const body_model::DegreeOfFreedom& dof : limb.dofs) {
      const double reach = 0.22 * (dof.angle_max_rad - dof.angle_min_rad);
      double& angle = pose.angles_rad[index++];
      angle += std::uniform_real_distribution<double>(-reach, reach)(random);
      angle = std::min(std::max(angle, dof.angle_min_rad), dof.angle_max_rad);
    }
  }
  pose.frame_from_root = CameraFromRoot();
  pose.frame_from_root.rotation =
      Eigen::AngleAxisd(0.8, Eigen::Vector3d::UnitY()) * pose.frame_from_root.rotation;
  return pose;
}

TEST(MarkerPose, MeetsTheJointsOfAnyPose) {
  const BodyModel model = Build(StartPlan(), TallSizes());
  const auto places = PlaceMarkers(StandingPerson(model), 0, model);
  std::mt19937 random(3);
  for (int i = 0; i < 20; ++i) {
    const Markers markers = MarkersOf(model, AnyPose(model, random));
    const MarkerPose found = FindPose(model, places, markers);
    EXPECT_LT(found.joint_error_m, 0.005) << i;
    body_model::Kinematics kinematics(model);
    kinematics.Update(found.pose);
    const auto wrist = kinematics.proximal_m(model.Find("left_hand").value());
    EXPECT_LT((wrist - markers.at("l_wrist")).norm(), 0.015) << i;
  }
}

TEST(MarkerPose, TellsWhenJointsCannotBeMet) {
  const BodyModel model = Build(StartPlan(), TallSizes());
  const RenderedPerson person = StandingPerson(model);
  Markers markers = person.frames[0];
  for (auto& [name, place_m] : markers) place_m = 1.2 * (place_m - markers.at("pelvis"));
  EXPECT_GT(FindPose(model, PlaceMarkers(person, 0, model), markers).joint_error_m, 0.01);
}

}  // namespace
}  // namespace deixis::pose_fitter
