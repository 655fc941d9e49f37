#include "services/anthropometer/core/urdf.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <random>
#include <set>

#include "common/body_model/joint_angles.h"
#include "common/body_model/kinematics.h"
#include "common/config/config.h"
#include "test/services/anthropometer/person.h"

namespace deixis::anthropometer {
namespace {

using body_model::BodyModel;
using body_model::BodyPose;
using Eigen::Isometry3d;

constexpr const char* kModels[] = {"whole_body_detailed", "clothed_body", "whole_body",
                                   "upper_body", "right_arm"};

BodyPose AnyPose(const BodyModel& model, std::mt19937& random) {
  BodyPose pose = RestPose(model);
  for (int i = 0; i < model.limb_count(); ++i) {
    int angle = model.first_angle(i);
    for (const auto& dof : model.limbs()[static_cast<std::size_t>(i)].dofs) {
      pose.angles_rad[angle++] =
          std::uniform_real_distribution(dof.angle_min_rad, dof.angle_max_rad)(random);
    }
  }
  return pose;
}

/// root_from_link of every link, by the joints alone.
std::map<std::string, Isometry3d> LinksOf(const std::vector<UrdfJoint>& joints,
                                          const std::vector<JointValue>& values) {
  std::map<std::string, double> angles;
  for (const JointValue& value : values) angles[value.joint] = value.angle_rad;
  std::map<std::string, Isometry3d> links = {{"body_x", Isometry3d::Identity()}};
  for (const UrdfJoint& joint : joints) {
    Isometry3d link = links.at(joint.parent);
    link.translate(joint.parent_from_joint.translation_m);
    link.rotate(joint.parent_from_joint.rotation);
    if (!joint.is_fixed) {
      link.rotate(Eigen::AngleAxisd(angles.at(joint.name), joint.turn.axis));
    }
    links[joint.child] = link;
  }
  return links;
}

void ExpectLinksWhereLimbsAre(const BodyModel& model, const std::vector<UrdfJoint>& joints,
                              const BodyPose& pose) {
  body_model::Kinematics kinematics(model);
  kinematics.Update(pose);
  const auto links = LinksOf(joints, JointValues(model, joints, pose));
  for (const UrdfJoint& joint : joints) {
    if (&joint != &joints.back() && (&joint)[1].limb == joint.limb) continue;
    const Isometry3d& limb = kinematics.limb(joint.limb);
    EXPECT_LE((links.at(joint.child).matrix() - limb.matrix()).norm(), 1e-9) << joint.child;
  }
}

TEST(Urdf, BringsEveryLinkToItsLimbInAnyPose) {
  std::mt19937 random(1);
  for (const char* name : kModels) {
    const BodyModel model = TallMan(name);
    const auto joints = UrdfJoints(model, "x");
    for (int i = 0; i < 200; ++i) ExpectLinksWhereLimbsAre(model, joints, AnyPose(model, random));
    ExpectLinksWhereLimbsAre(model, joints, RestPose(model));
    ExpectLinksWhereLimbsAre(model, joints,
                             Standing(model));  // Hanging arms: first and third joint alike.
  }
}

TEST(Urdf, HasLimitsThatEveryPoseKeeps) {
  std::mt19937 random(2);
  for (const char* name : kModels) {
    const BodyModel model = TallMan(name);
    const auto joints = UrdfJoints(model, "x");
    std::map<std::string, ChainJoint> turns;
    for (const UrdfJoint& joint : joints) turns[joint.name] = joint.turn;
    for (int i = 0; i < 2000; ++i) {
      for (const JointValue& value : JointValues(model, joints, AnyPose(model, random))) {
        EXPECT_GE(value.angle_rad, turns[value.joint].angle_min_rad - 1e-12) << value.joint;
        EXPECT_LE(value.angle_rad, turns[value.joint].angle_max_rad + 1e-12) << value.joint;
      }
    }
  }
}

TEST(Urdf, TurnsJointsAsSmallAnglesOfTheModelDo) {
  const BodyModel model = TallMan("whole_body_detailed");
  const int thigh = *model.Find("right_thigh");
  BodyPose pose = RestPose(model);
  pose.angles_rad.segment(model.first_angle(thigh), 3) = Eigen::Vector3d(0.01, -0.02, 0.03);
  const auto& dofs = model.limbs()[static_cast<std::size_t>(thigh)].dofs;
  ASSERT_EQ(dofs[0].name, "flexion");
  std::map<std::string, double> values;
  for (const JointValue& value : JointValues(model, UrdfJoints(model, "x"), pose)) {
    values[value.joint] = value.angle_rad;
  }
  EXPECT_NEAR(values.at("r_r_hip_x"), 0.01, 5e-4);
  EXPECT_NEAR(values.at("r_p_hip_x"), -0.02, 5e-4);
  EXPECT_NEAR(values.at("r_y_hip_x"), 0.03, 5e-4);
}

TEST(Urdf, NamesLinksAsRep155Does) {
  std::set<std::string> links, joints;
  for (const UrdfJoint& joint : UrdfJoints(TallMan("whole_body_detailed"), "x")) {
    EXPECT_TRUE(links.insert(joint.child).second) << joint.child;
    EXPECT_TRUE(joints.insert(joint.name).second) << joint.name;
  }
  for (const char* name :
       {"waist_x", "torso_x", "head_x", "l_y_shoulder_x", "l_p_shoulder_x", "l_shoulder_x",
        "r_elbow_x", "r_wrist_x", "l_y_hip_x", "l_hip_x", "l_knee_x", "r_ankle_x"}) {
    EXPECT_TRUE(links.count(name) + joints.count(name)) << name;
  }
  for (const char* name : {"r_head_x", "y_head_x", "p_head_x", "r_r_shoulder_x", "l_r_hip_x",
                           "l_p_hip_x", "l_elbow_x", "r_knee_x"}) {
    EXPECT_TRUE(joints.count(name)) << name;
  }
}

Eigen::Matrix3d FromRollPitchYaw(const Eigen::Vector3d& rpy) {
  return (Eigen::AngleAxisd(rpy.z(), Eigen::Vector3d::UnitZ()) *
          Eigen::AngleAxisd(rpy.y(), Eigen::Vector3d::UnitY()) *
          Eigen::AngleAxisd(rpy.x(), Eigen::Vector3d::UnitX()))
      .toRotationMatrix();
}

TEST(Urdf, TellsAnyRotationByRollPitchYaw) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> angle(-M_PI, M_PI);
  for (int i = 0; i < 500; ++i) {
    Eigen::Vector3d rpy(angle(random), angle(random), angle(random));
    if (i % 3 == 0) rpy.y() = i % 2 == 0 ? M_PI_2 : -M_PI_2;
    const Eigen::Matrix3d rotation = FromRollPitchYaw(rpy);
    EXPECT_LE((FromRollPitchYaw(RollPitchYaw(rotation)) - rotation).norm(), 1e-9);
  }
}

TEST(Urdf, RefusesTwoLimbsOfOneName) {
  body_model::Limb base;
  base.name = "torso";
  base.shape = {0.1, 0.1, 0.1, 0.1, 0.3};
  body_model::Limb chest = base;
  chest.name = "chest";
  chest.parent = 0;
  EXPECT_THROW(UrdfOf(BodyModel("both", {base, chest}), "x"), config::ConfigError);
}

TEST(Urdf, RefusesNamesThatAreTheRootsOrBreakXml) {
  body_model::Limb limb;
  limb.shape = {0.1, 0.1, 0.1, 0.1, 0.3};
  for (const char* name : {"body", "b<", "b>", "b&", "b\"", "b\n"}) {
    limb.name = name;
    EXPECT_THROW(UrdfOf(BodyModel("one", {limb}), "x"), config::ConfigError) << name;
  }
  limb.name = "base";
  EXPECT_THROW(UrdfOf(BodyModel("o&e", {limb}), "x"), config::ConfigError);
  EXPECT_NO_THROW(UrdfOf(BodyModel("one", {limb}), "x"));
}

}  // namespace
}  // namespace deixis::anthropometer
