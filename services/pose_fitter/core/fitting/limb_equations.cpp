#include "services/pose_fitter/core/fitting/limb_equations.h"

#include <Eigen/Geometry>

namespace deixis::pose_fitter {

void BodyEquations::SetZero(int parameters) {
  information.setZero(parameters, parameters);
  pull.setZero(parameters);
}

LimbEquations::LimbEquations(int limb_count) {
  const auto count = static_cast<std::size_t>(limb_count);
  information_.resize(count);
  composite_information_.resize(count);
  pull_.resize(count);
  composite_pull_.resize(count);
}

void LimbEquations::SetZero(const Eigen::Vector3d& root_m) {
  root_m_ = root_m;
  for (auto& matrix : information_) matrix.setZero();
  for (auto& vector : pull_) vector.setZero();
}

void LimbEquations::Pull(int limb, const Eigen::Vector3d& point_m, const Eigen::Vector3d& direction,
                         double distance_m, double weight) {
  Vector6 v;
  v << (point_m - root_m_).cross(direction), direction;
  const auto k = static_cast<std::size_t>(limb);
  information_[k].noalias() += (weight * v) * v.transpose();
  pull_[k] += (weight * distance_m) * v;
}

void LimbEquations::Add(int limb, const LimbSums& sums, double weight) {
  const auto k = static_cast<std::size_t>(limb);
  int at = 0;
  for (int row = 0; row < 6; ++row) {
    for (int column = 0; column <= row; ++column, ++at) {
      const double value = weight * static_cast<double>(sums.values[at]);
      information_[k](row, column) += value;
      if (row != column) information_[k](column, row) += value;
    }
  }
  for (int row = 0; row < 6; ++row, ++at) {
    pull_[k][row] += weight * static_cast<double>(sums.values[at]);
  }
}

void LimbEquations::Accumulate(const body_model::BodyModel& model) {
  composite_information_ = information_;
  composite_pull_ = pull_;
  for (int limb = model.limb_count() - 1; limb > 0; --limb) {
    const auto parent =
        static_cast<std::size_t>(model.limbs()[static_cast<std::size_t>(limb)].parent);
    composite_information_[parent] += composite_information_[static_cast<std::size_t>(limb)];
    composite_pull_[parent] += composite_pull_[static_cast<std::size_t>(limb)];
  }
}

void LimbEquations::FindMotions(const body_model::Kinematics& kinematics) {
  const auto& model = kinematics.model();
  const int parameters = 6 + model.angle_count();
  motions_.setZero(6, parameters);
  moved_.assign(static_cast<std::size_t>(parameters), 0);
  for (int k = 0; k < 3; ++k) {
    motions_(3 + k, k) = 1.0;
    motions_(k, 3 + k) = 1.0;
  }
  for (int limb = 0; limb < model.limb_count(); ++limb) {
    const Eigen::Vector3d joint_m = kinematics.proximal_m(limb) - root_m_;
    const auto dofs = model.limbs()[static_cast<std::size_t>(limb)].dofs.size();
    for (int i = 0; i < static_cast<int>(dofs); ++i) {
      const int angle = model.first_angle(limb) + i;
      const Eigen::Vector3d axis = kinematics.angle_axis(angle);
      motions_.col(6 + angle) << axis, joint_m.cross(axis);
      moved_[static_cast<std::size_t>(6 + angle)] = limb;
    }
  }
}

void LimbEquations::AddTo(const body_model::Kinematics& kinematics, BodyEquations& equations) {
  const auto& model = kinematics.model();
  Accumulate(model);
  FindMotions(kinematics);
  const int parameters = 6 + model.angle_count();
  for (int i = 0; i < parameters; ++i) {
    const int limb = moved_[static_cast<std::size_t>(i)];
    const Vector6 force = composite_information_[static_cast<std::size_t>(limb)] * motions_.col(i);
    equations.pull[i] += motions_.col(i).dot(composite_pull_[static_cast<std::size_t>(limb)]);
    // Against each parameter of this limb and of those that it hangs on.
    for (int above = limb; above >= 0;
         above = model.limbs()[static_cast<std::size_t>(above)].parent) {
      const auto dofs =
          static_cast<int>(model.limbs()[static_cast<std::size_t>(above)].dofs.size());
      const int first = 6 + model.first_angle(above);
      for (int j = first; j < first + dofs && j <= i; ++j) {
        const double value = motions_.col(j).dot(force);
        equations.information(i, j) += value;
        if (i != j) equations.information(j, i) += value;
      }
    }
    for (int j = 0; j < 6 && j <= i; ++j) {
      const double value = motions_.col(j).dot(force);
      equations.information(i, j) += value;
      if (i != j) equations.information(j, i) += value;
    }
  }
}

}  // namespace deixis::pose_fitter
