#include "test/common/body_model/body_samples.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <filesystem>

#include "common/anthropometry/person_estimate.h"
#include "common/body_model/body_plan.h"
#include "common/body_model/joint_angles.h"
#include "common/body_model/kinematics.h"

namespace deixis::body_model {

using Eigen::Vector3d;

namespace {

const std::string kConfig = DEIXIS_SOURCE_DIR "/config/";

BodyPose Moved(BodyPose pose, int column, double step) {
  if (column < 3) {
    pose.frame_from_root.translation_m[column] += step;
  } else if (column < 6) {
    const Vector3d turn = step * Vector3d::Unit(column - 3);
    pose.frame_from_root.rotation =
        Eigen::Quaterniond(RotationFrom(turn)) * pose.frame_from_root.rotation;
  } else {
    pose.angles_rad[column - 6] += step;
  }
  return pose;
}

}  // namespace

Limb PlainLimb(const std::string& name, int parent) {
  Limb limb;
  limb.name = name;
  limb.parent = parent;
  limb.shape = {0.05, 0.04, 0.03, 0.02, 0.3};
  if (parent >= 0) limb.rest_in_parent.translation_m = {0.0, 0.0, 0.3};
  return limb;
}

DegreeOfFreedom Dof(const std::string& name, DofKind kind, const Vector3d& axis, double min_rad,
                    double max_rad) {
  DegreeOfFreedom dof;
  dof.name = name;
  dof.kind = kind;
  dof.axis = axis;
  dof.angle_min_rad = min_rad;
  dof.angle_max_rad = max_rad;
  return dof;
}

std::vector<Limb> ArmAndHead() {
  std::vector<Limb> limbs{PlainLimb("trunk", -1), PlainLimb("upper_arm", 0),
                          PlainLimb("lower_arm", 1), PlainLimb("hand", 2), PlainLimb("head", 0)};
  limbs[1].rest_in_parent.rotation =
      Eigen::Quaterniond::FromTwoVectors(Vector3d::UnitZ(), Vector3d(0.2, -1.0, 0.1));
  limbs[1].rest_in_parent.translation_m = {0.01, -0.18, 0.28};
  limbs[1].dofs = {Dof("abduction", DofKind::kSwing, Vector3d::UnitX(), -2.0, 2.0),
                   Dof("flexion", DofKind::kSwing, Vector3d::UnitY(), -2.0, 2.0),
                   Dof("rotation", DofKind::kTwist, -Vector3d::UnitZ(), -1.6, 1.7)};
  limbs[2].dofs = {Dof("flexion", DofKind::kHinge, Vector3d::UnitY(), -0.2, 2.6),
                   Dof("pronation", DofKind::kTwist, Vector3d::UnitZ(), -1.6, 1.6)};
  limbs[3].dofs = {Dof("flexion", DofKind::kSwing, Vector3d::UnitX(), -1.0, 1.3),
                   Dof("deviation", DofKind::kSwing, Vector3d::UnitY(), -0.4, 0.6)};
  return limbs;
}

std::vector<Person> FourPeople() {
  using anthropometry::Sex;
  return {{Sex::kFemale, 1.50}, {Sex::kFemale, 1.68}, {Sex::kMale, 1.80}, {Sex::kMale, 2.00}};
}

BodyModel Shipped(const std::string& name, const Person& person) {
  static const auto populations =
      anthropometry::Populations::Load(kConfig + "kinematics/population.yaml");
  return Build(LoadBodyPlan(kConfig + "body_models/" + name + ".yaml"),
               SizesOf(populations, person.sex, person.stature_m));
}

std::vector<std::string> ShippedNames() {
  std::vector<std::string> names;
  for (const auto& file : std::filesystem::directory_iterator(kConfig + "body_models")) {
    if (file.path().extension() == ".yaml") names.push_back(file.path().stem());
  }
  std::sort(names.begin(), names.end());
  return names;
}

BodyPose RandomPose(const BodyModel& model, std::mt19937& random) {
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  BodyPose pose;
  const Vector3d turn(unit(random), unit(random), unit(random));
  pose.frame_from_root.rotation =
      Eigen::Quaterniond(Eigen::AngleAxisd(3.0 * unit(random), turn.normalized()));
  pose.frame_from_root.translation_m = {unit(random), unit(random), 2.0 + unit(random)};
  pose.angles_rad.resize(model.angle_count());
  int angle = 0;
  for (const Limb& limb : model.limbs()) {
    for (const DegreeOfFreedom& dof : limb.dofs) {
      const double share = 0.5 * (unit(random) + 1.0);
      pose.angles_rad[angle++] =
          dof.angle_min_rad + share * (dof.angle_max_rad - dof.angle_min_rad);
    }
  }
  return pose;
}

void ExpectDerivatives(const BodyModel& model, const BodyPose& pose) {
  const Vector3d in_limb(0.03, -0.02, 0.25);
  Kinematics kinematics(model);
  for (int limb = 0; limb < model.limb_count(); ++limb) {
    kinematics.Update(pose);
    Eigen::Matrix3Xd jacobian(3, 6 + model.angle_count());
    jacobian.setConstant(std::nan(""));
    PointJacobian(kinematics, limb, kinematics.limb(limb) * in_limb, jacobian);
    for (int column = 0; column < jacobian.cols(); ++column) {
      const double h = 1e-6;
      kinematics.Update(Moved(pose, column, h));
      const Vector3d after = kinematics.limb(limb) * in_limb;
      kinematics.Update(Moved(pose, column, -h));
      const Vector3d before = kinematics.limb(limb) * in_limb;
      EXPECT_LE((jacobian.col(column) - (after - before) / (2.0 * h)).norm(), 1e-8)
          << "limb " << limb << " column " << column;
    }
  }
}

}  // namespace deixis::body_model
