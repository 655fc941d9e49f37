#include "services/pose_fitter/core/fitting/limb_equations.h"

#include <gtest/gtest.h>

#include <random>

#include "common/body_model/joint_angles.h"
#include "test/services/pose_fitter/synthetic_person.h"

namespace deixis::pose_fitter {
namespace {

using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;

struct Pulled {
  int limb;
  Vector3d point_m, direction;
  double distance_m, weight;
};

/// A body in some posture, and pulls on its limbs.
class LimbEquationsTest : public ::testing::Test {
 protected:
  LimbEquationsTest() {
    std::mt19937 random(3);
    std::normal_distribution<double> normal;
    const auto vector = [&] { return Vector3d(normal(random), normal(random), normal(random)); };
    pose_.frame_from_root = {Eigen::Quaterniond(body_model::RotationFrom(vector())),
                             {0.1, 0.2, 2.0}};
    for (double& angle : pose_.angles_rad) angle += 0.3 * normal(random);
    kinematics_.Update(pose_);
    for (int i = 0; i < 60; ++i) {
      const int limb = i % body_.limb_count();
      pulls_.push_back({limb, kinematics_.limb(limb) * (0.2 * vector()), vector().normalized(),
                        0.05 * normal(random), 0.5 + std::abs(normal(random))});
    }
  }
  BodyEquations Gathered() {
    LimbEquations limbs(body_.limb_count());
    limbs.SetZero(kinematics_.proximal_m(0));
    for (const Pulled& pull : pulls_) {
      limbs.Pull(pull.limb, pull.point_m, pull.direction, pull.distance_m, pull.weight);
    }
    BodyEquations equations;
    equations.SetZero(6 + body_.angle_count());
    limbs.AddTo(kinematics_, equations);
    return equations;
  }

  body_model::BodyModel body_ = test::ClothedBody();
  body_model::BodyPose pose_ = body_model::Standing(body_);
  body_model::Kinematics kinematics_{body_};
  std::vector<Pulled> pulls_;
};

TEST_F(LimbEquationsTest, AreThoseOfEveryPointsJacobian) {
  const int parameters = 6 + body_.angle_count();
  MatrixXd information = MatrixXd::Zero(parameters, parameters);
  VectorXd wanted = VectorXd::Zero(parameters);
  Eigen::Matrix3Xd jacobian(3, parameters);
  for (const Pulled& pull : pulls_) {
    body_model::PointJacobian(kinematics_, pull.limb, pull.point_m, jacobian);
    const VectorXd row = jacobian.transpose() * pull.direction;
    information += pull.weight * row * row.transpose();
    wanted += pull.weight * pull.distance_m * row;
  }
  const BodyEquations equations = Gathered();
  EXPECT_LT((equations.information - information).norm(), 1e-9 * information.norm());
  EXPECT_LT((equations.pull - wanted).norm(), 1e-9 * wanted.norm());
}

TEST_F(LimbEquationsTest, PullAsTheSlopeOfTheCostSays) {
  std::vector<Vector3d> fixed_m;
  for (const Pulled& pull : pulls_) {
    fixed_m.push_back(kinematics_.limb(pull.limb).inverse() * pull.point_m);
  }
  const auto cost = [&](const body_model::BodyPose& pose) {
    body_model::Kinematics moved(body_);
    moved.Update(pose);
    double sum = 0.0;
    for (std::size_t i = 0; i < pulls_.size(); ++i) {
      const Vector3d went_m = moved.limb(pulls_[i].limb) * fixed_m[i] - pulls_[i].point_m;
      const double left_m = pulls_[i].distance_m - pulls_[i].direction.dot(went_m);
      sum += 0.5 * pulls_[i].weight * left_m * left_m;
    }
    return sum;
  };
  const BodyEquations equations = Gathered();
  constexpr double kStep = 1e-6;
  for (int angle = 0; angle < body_.angle_count(); ++angle) {
    body_model::BodyPose ahead = pose_, back = pose_;
    ahead.angles_rad[angle] += kStep;
    back.angles_rad[angle] -= kStep;
    EXPECT_NEAR(equations.pull[6 + angle], -(cost(ahead) - cost(back)) / (2.0 * kStep), 1e-5);
  }
}

TEST_F(LimbEquationsTest, TakeWhatAKernelSummed) {
  LimbSums sums{};
  const Pulled& pull = pulls_[7];
  Eigen::Matrix<double, 6, 1> v;
  v << (pull.point_m - kinematics_.proximal_m(0)).cross(pull.direction), pull.direction;
  int at = 0;
  for (int row = 0; row < 6; ++row) {
    for (int column = 0; column <= row; ++column) {
      sums.values[at++] = static_cast<float>(v[row] * v[column]);
    }
  }
  for (int row = 0; row < 6; ++row) {
    sums.values[at++] = static_cast<float>(pull.distance_m * v[row]);
  }
  LimbEquations summed(body_.limb_count()), pulled(body_.limb_count());
  summed.SetZero(kinematics_.proximal_m(0));
  pulled.SetZero(kinematics_.proximal_m(0));
  summed.Add(pull.limb, sums, 2.0);
  pulled.Pull(pull.limb, pull.point_m, pull.direction, pull.distance_m, 2.0);
  EXPECT_LT((summed.information(pull.limb) - pulled.information(pull.limb)).norm(), 1e-5);
  BodyEquations of_sums, of_pull;
  of_sums.SetZero(6 + body_.angle_count());
  of_pull.SetZero(6 + body_.angle_count());
  summed.AddTo(kinematics_, of_sums);
  pulled.AddTo(kinematics_, of_pull);
  EXPECT_LT((of_sums.pull - of_pull.pull).norm(), 1e-5);
}

}  // namespace
}  // namespace deixis::pose_fitter
