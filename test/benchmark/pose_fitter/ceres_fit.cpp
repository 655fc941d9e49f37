#include "test/benchmark/pose_fitter/ceres_fit.h"

#include <ceres/ceres.h>
#include <ceres/normal_prior.h>
#include <ceres/rotation.h>

#include <cmath>
#include <memory>
#include <vector>

#include "common/geometry/closest_points.h"
#include "services/pose_fitter/core/limb_icp/limb_matches.h"

namespace deixis::pose_fitter {
namespace {

using body_model::BodyModel;
using body_model::BodyPose;
using Eigen::Vector3d;

constexpr int kStride = 12;  // Derivatives per pass: a leg's or an arm's chain takes two.
constexpr int kTries = 10;   // Of one step.
constexpr double kSigma_m = 0.01, kRest_rad = 0.05;

/// A measured point, and the plane of its limb's surface that it should lie in, limb's frame.
struct Foot {
  Vector3d measured_m;  ///< Camera frame.
  Vector3d foot_m, normal;
  double weight;
};

template <typename T>
Eigen::Matrix<T, 3, 3> Rotation(const Eigen::Matrix<T, 3, 1>& vector) {
  Eigen::Matrix<T, 3, 3> rotation;
  ceres::AngleAxisToRotationMatrix(vector.data(), rotation.data());
  return rotation;
}

/// Distances of one limb's points to their planes, by the root (6) and the joints above the limb.
struct LimbCost {
  const BodyModel* model;
  std::vector<int> path;  ///< Limbs from the root to this one.
  Eigen::Matrix3d root_rotation;
  std::vector<Foot> feet;

  template <typename T>
  bool operator()(T const* const* blocks, T* residuals) const {
    using Matrix3 = Eigen::Matrix<T, 3, 3>;
    using Vector3 = Eigen::Matrix<T, 3, 1>;
    const Eigen::Map<const Vector3> shift_m(blocks[0]), turn(blocks[0] + 3);
    Matrix3 rotation = Rotation<T>(turn) * root_rotation.cast<T>();
    Vector3 origin_m = shift_m;
    std::size_t block = 1;
    for (const int index : path) {
      const auto& limb = model->limbs()[static_cast<std::size_t>(index)];
      if (limb.parent < 0) continue;
      origin_m += rotation * limb.rest_in_parent.translation_m.template cast<T>();
      rotation = rotation * limb.rest_in_parent.rotation.toRotationMatrix().template cast<T>();
      if (!limb.dofs.empty()) rotation = rotation * Joint(limb, blocks[block++]);
    }
    for (std::size_t i = 0; i < feet.size(); ++i) {
      const Vector3 place_m = origin_m + rotation * feet[i].foot_m.template cast<T>();
      const Vector3 normal = rotation * feet[i].normal.template cast<T>();
      residuals[i] = feet[i].weight * normal.dot(feet[i].measured_m.template cast<T>() - place_m);
    }
    return true;
  }

  template <typename T>
  static Eigen::Matrix<T, 3, 3> Joint(const body_model::Limb& limb, const T* angles) {
    using body_model::DofKind;
    using Vector3 = Eigen::Matrix<T, 3, 1>;
    Vector3 swing = Vector3::Zero();
    Eigen::Matrix<T, 3, 3> turns = Eigen::Matrix<T, 3, 3>::Identity();
    for (const DofKind kind : {DofKind::kSwing, DofKind::kHinge, DofKind::kTwist}) {
      for (std::size_t k = 0; k < limb.dofs.size(); ++k) {
        if (limb.dofs[k].kind != kind) continue;
        const Vector3 turn = limb.dofs[k].axis.template cast<T>() * angles[k];
        if (kind == DofKind::kSwing) {
          swing += turn;
        } else {
          turns = turns * Rotation<T>(turn);
        }
      }
    }
    return Rotation<T>(swing) * turns;
  }
};

std::vector<LimbCost> Associate(const BodyModel& model, const BodyPoints& points,
                                const body_model::Kinematics& kinematics, LimbMatches& matches,
                                double reach_m, double scale_m) {
  matches.Find(points, kinematics, {reach_m, 0.0});
  std::vector<LimbCost> costs(static_cast<std::size_t>(model.limb_count()));
  std::vector<std::vector<Eigen::Vector3f>> own(costs.size());
  for (std::size_t i = 0; i < points.x_m.size(); ++i) {
    if (matches.winners()[i] < 0) continue;
    const auto k = static_cast<std::size_t>(matches.winners()[i]);
    own[k].emplace_back(points.x_m[i], points.y_m[i], points.z_m[i]);
  }
  std::vector<float> x, y, z, distance, nx, ny, nz;
  for (std::size_t k = 0; k < costs.size(); ++k) {
    const auto count = own[k].size();
    for (auto* values : {&x, &y, &z, &distance, &nx, &ny, &nz}) values->resize(count);
    const Eigen::Isometry3f limb_from_camera =
        kinematics.limb(static_cast<int>(k)).inverse().cast<float>();
    for (std::size_t i = 0; i < count; ++i) {
      const Eigen::Vector3f point_m = limb_from_camera * own[k][i];
      x[i] = point_m.x();
      y[i] = point_m.y();
      z[i] = point_m.z();
    }
    FindClosestPoints(model.limbs()[k].shape,
                      {x.data(), y.data(), z.data(), static_cast<int>(count)},
                      {distance.data(), nx.data(), ny.data(), nz.data()});
    for (std::size_t i = 0; i < count; ++i) {
      const auto off_m = static_cast<double>(distance[i]);
      const Vector3d normal = Eigen::Vector3f(nx[i], ny[i], nz[i]).cast<double>();
      const Vector3d point_m = Eigen::Vector3f(x[i], y[i], z[i]).cast<double>();
      const double robust = scale_m * scale_m / (scale_m * scale_m + off_m * off_m);
      costs[k].feet.push_back(
          {own[k][i].cast<double>(), point_m - off_m * normal, normal, robust / kSigma_m});
    }
  }
  return costs;
}

/// Points do not tell all angles (round limbs turn unseen): these stay where they are.
void AddRest(const BodyModel& model, BodyPose& pose, ceres::Problem& problem) {
  for (int limb = 1; limb < model.limb_count(); ++limb) {
    const auto size = static_cast<int>(model.limbs()[static_cast<std::size_t>(limb)].dofs.size());
    double* const block = pose.angles_rad.data() + model.first_angle(limb);
    if (size == 0 || !problem.HasParameterBlock(block)) continue;
    problem.AddResidualBlock(
        new ceres::NormalPrior(Eigen::MatrixXd::Identity(size, size) / kRest_rad,
                               Eigen::VectorXd(Eigen::Map<Eigen::VectorXd>(block, size))),
        nullptr, block);
  }
}

/// One good step per association; one that is refused only makes the region of trust smaller.
class AfterOneStep final : public ceres::IterationCallback {
 public:
  ceres::CallbackReturnType operator()(const ceres::IterationSummary& summary) override {
    return summary.iteration > 0 && summary.step_is_successful
               ? ceres::SOLVER_TERMINATE_SUCCESSFULLY
               : ceres::SOLVER_CONTINUE;
  }
};

void Step(const BodyModel& model, std::vector<LimbCost> costs, BodyPose& pose) {
  Eigen::Matrix<double, 6, 1> root = Eigen::Matrix<double, 6, 1>::Zero();
  root.head<3>() = pose.frame_from_root.translation_m;
  ceres::Problem problem;
  for (int limb = 0; limb < model.limb_count(); ++limb) {
    LimbCost& cost = costs[static_cast<std::size_t>(limb)];
    if (cost.feet.empty()) continue;
    cost.model = &model;
    cost.root_rotation = pose.frame_from_root.rotation.toRotationMatrix();
    for (int at = limb; at >= 0; at = model.limbs()[static_cast<std::size_t>(at)].parent) {
      cost.path.insert(cost.path.begin(), at);
    }
    const auto count = static_cast<int>(cost.feet.size());
    std::vector<double*> blocks{root.data()};
    std::vector<int> sizes{6};
    for (const int at : cost.path) {
      const auto& dofs = model.limbs()[static_cast<std::size_t>(at)].dofs;
      if (at == 0 || dofs.empty()) continue;
      blocks.push_back(pose.angles_rad.data() + model.first_angle(at));
      sizes.push_back(static_cast<int>(dofs.size()));
    }
    auto* const function =
        new ceres::DynamicAutoDiffCostFunction<LimbCost, kStride>(new LimbCost(std::move(cost)));
    for (const int size : sizes) function->AddParameterBlock(size);
    function->SetNumResiduals(count);
    problem.AddResidualBlock(function, nullptr, blocks);
  }
  AddRest(model, pose, problem);
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::DENSE_NORMAL_CHOLESKY;
  options.max_num_iterations = kTries;
  options.initial_trust_region_radius = 50.0;
  AfterOneStep stop;
  options.callbacks.push_back(&stop);
  options.logging_type = ceres::SILENT;
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem, &summary);
  pose.frame_from_root.translation_m = root.head<3>();
  pose.frame_from_root.rotation =
      (Eigen::Quaterniond(body_model::RotationFrom(root.tail<3>())) * pose.frame_from_root.rotation)
          .normalized();
}

}  // namespace

void FitByCeres(const BodyModel& model, const BodyPoints& points, int rounds, BodyPose& pose) {
  body_model::Kinematics kinematics(model);
  LimbMatches matches(model);
  for (int round = 0; round < rounds; ++round) {
    const double share = rounds > 1 ? static_cast<double>(round) / (rounds - 1) : 1.0;
    kinematics.Update(pose);
    Step(model,
         Associate(model, points, kinematics, matches, 0.25 * std::pow(0.4, share),
                   0.1 * std::pow(0.3, share)),
         pose);
  }
}

}  // namespace deixis::pose_fitter
