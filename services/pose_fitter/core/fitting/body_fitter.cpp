#include "services/pose_fitter/core/fitting/body_fitter.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "common/body_model/joint_angles.h"
#include "common/config/config.h"

namespace deixis::pose_fitter {
namespace {

using Eigen::Vector3d;

constexpr double kLargestStep = 0.4;  // Radians and metres, of one round.
constexpr double kDamping = 1e-3;
constexpr double kFreeAngle_rad = 9.0;  // Rest spreads from here on are none.

std::vector<JointFreedom> FreedomsOf(const BodyFitterConfig& config,
                                     const body_model::BodyModel& model) {
  std::vector<JointFreedom> freedoms;
  for (const auto& limb : model.limbs()) {
    const auto found = std::find_if(
        config.joints.begin(), config.joints.end(),
        [&limb](const JointFreedom& joint) { return joint.limb == WithoutSide(limb.name); });
    freedoms.push_back(found == config.joints.end() ? JointFreedom{limb.name} : *found);
    freedoms.back().rest_rad = std::min(freedoms.back().rest_rad, config.most_rest_rad);
  }
  return freedoms;
}

LimbSurface SurfaceOf(const Eigen::Isometry3d& camera_from_limb,
                      const geometry::DegenerateCylinder& shape) {
  LimbSurface surface{};
  const Eigen::Matrix3d rotation = camera_from_limb.linear();
  const Vector3d camera_m = -(rotation.transpose() * camera_from_limb.translation());
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) {
      surface.camera_from_limb[3 * row + column] = static_cast<float>(rotation(row, column));
    }
    surface.camera_in_limb_m[row] = static_cast<float>(camera_m[row]);
  }
  surface.a0_m = static_cast<float>(shape.a0_m);
  surface.b0_m = static_cast<float>(shape.b0_m);
  surface.a1_m = static_cast<float>(shape.a1_m);
  surface.b1_m = static_cast<float>(shape.b1_m);
  surface.length_m = static_cast<float>(shape.length_m);
  surface.x0_m = static_cast<float>(shape.centre0_m.x());
  surface.y0_m = static_cast<float>(shape.centre0_m.y());
  surface.x1_m = static_cast<float>(shape.centre1_m.x());
  surface.y1_m = static_cast<float>(shape.centre1_m.y());
  return surface;
}

LimbCapsule CapsuleOf(const Eigen::Isometry3d& camera_from_limb,
                      const geometry::DegenerateCylinder& shape) {
  const Vector3d begin_m(shape.centre0_m.x(), shape.centre0_m.y(), 0.0);
  const Vector3d end_m(shape.centre1_m.x(), shape.centre1_m.y(), shape.length_m);
  LimbCapsule capsule;
  capsule.begin_m = (camera_from_limb * begin_m).cast<float>();
  capsule.along_m = (camera_from_limb.linear() * (end_m - begin_m)).cast<float>();
  capsule.inverse_length2 = 1.0F / capsule.along_m.squaredNorm();
  capsule.radius_m = static_cast<float>(std::max({shape.a0_m, shape.b0_m, shape.a1_m, shape.b1_m}));
  return capsule;
}

RayPoints Slice(const BodyPoints& points, int first, int count) {
  return {points.x_m.data() + first, points.y_m.data() + first, points.z_m.data() + first,
          points.sigma_z_m.data() + first, count};
}

Vector3d RotationVector(const Eigen::Quaterniond& rotation) {
  const Eigen::AngleAxisd turn(rotation);
  return turn.angle() * turn.axis();
}

}  // namespace

float LimbCapsule::Distance_m(const Eigen::Vector3f& point_m) const {
  const Eigen::Vector3f from_m = point_m - begin_m;
  const float share = std::clamp(from_m.dot(along_m) * inverse_length2, 0.0F, 1.0F);
  return (from_m - share * along_m).norm() - radius_m;
}

void JointFreedom::Validate() const {
  config::Faults faults;
  faults.Require(motion_rad > 0.0, "motion_rad", "must be positive");
  faults.Require(rest_rad > 0.0, "rest_rad", "must be positive");
  faults.ThrowIfAny();
}

void BodyFitterConfig::Validate() const {
  config::Faults faults;
  faults.Require(iterations >= 1 && iterations <= 1000, "iterations", "must be 1..1000");
  faults.Require(first_points >= 100, "first_points", "must be at least 100");
  const auto positive = [&faults](double value, const char* key) {
    faults.Require(value > 0.0, key, "must be positive");
  };
  positive(first_scale_m, "first_scale_m");
  positive(last_scale_m, "last_scale_m");
  positive(first_reach_m, "first_reach_m");
  positive(last_reach_m, "last_reach_m");
  positive(across_m, "across_m");
  positive(point_weight, "point_weight");
  positive(counted_points, "counted_points");
  positive(root_motion_m, "root_motion_m");
  positive(root_motion_rad, "root_motion_rad");
  positive(motion_weight, "motion_weight");
  positive(limit_rad, "limit_rad");
  faults.ThrowIfAny();
}

BodyFitter::BodyFitter(const BodyFitterConfig& config, const body_model::BodyModel& model)
    : config_(config),
      model_(&model),
      kinematics_(model),
      rest_(body_model::Standing(model)),
      freedoms_(FreedomsOf(config, model)),
      trunk_(TrunkOf(model)),
      outline_(config.outline, model),
      cues_(config.cues, model),
      limb_equations_(model.limb_count()) {
  const auto count = static_cast<std::size_t>(model.limb_count());
  surfaces_.resize(count);
  capsules_.resize(count);
  near_.reserve(count);
  first_of_limb_.resize(count + 1);
  next_of_limb_.resize(count);
  sums_.resize(count);
  result_.limbs.resize(count);
}

const FitResult& BodyFitter::Fit(const BodyEvidence& evidence,
                                 const std::optional<body_model::Floor>& floor,
                                 const body_model::BodyPose& predicted,
                                 std::optional<double> seconds, body_model::BodyPose& pose) {
  Thin(evidence.points());
  for (int round = 0; round < config_.iterations; ++round) {
    const double share =
        config_.iterations > 1 ? static_cast<double>(round) / (config_.iterations - 1) : 1.0;
    const double scale_m =
        config_.first_scale_m * std::pow(config_.last_scale_m / config_.first_scale_m, share);
    const double reach_m =
        config_.first_reach_m * std::pow(config_.last_reach_m / config_.first_reach_m, share);
    const bool is_rough = 3 * round < 2 * config_.iterations;
    const BodyPoints& points = is_rough && thin_.count() > 0 ? thin_ : evidence.points();
    const double weight =
        config_.point_weight * std::min(1.0, config_.counted_points / std::max(1, points.count()));
    kinematics_.Update(pose);
    equations_.SetZero(6 + model_->angle_count());
    limb_equations_.SetZero(kinematics_.proximal_m(0));
    PlaceLimbs();
    // At first, where each point belongs is asked in every other round.
    if (!is_rough || round % 2 == 0) Assign(points, reach_m);
    AddPoints(scale_m);
    for (int limb = 0; limb < model_->limb_count(); ++limb) {
      limb_equations_.Add(limb, sums_[static_cast<std::size_t>(limb)], weight);
    }
    outline_.AddTo(evidence, kinematics_, config_.point_weight, limb_equations_);
    cues_.AddTo(evidence.cues(), kinematics_, 1.0, limb_equations_);
    AddFloor(floor);
    limb_equations_.AddTo(kinematics_, equations_);
    AddPriors(pose, predicted, seconds);
    AddLimits(pose);
    AddUpright(pose, floor);
    Step(pose);
  }
  // Limits are soft while the fit is on its way; nothing leaves the envelope.
  body_model::ClampToEnvelope(*model_, pose);
  kinematics_.Update(pose);
  Judge(evidence);
  return result_;
}

// What the first rounds take of many points; nothing when all are few.
void BodyFitter::Thin(const BodyPoints& points) {
  thin_.Clear();
  const int step = points.count() / config_.first_points;
  if (step < 2) return;
  for (int i = 0; i < points.count(); i += step) {
    const auto k = static_cast<std::size_t>(i);
    thin_.Add({points.x_m[k], points.y_m[k], points.z_m[k]}, points.sigma_z_m[k]);
  }
  thin_.EndBlock();
}

const FitResult& BodyFitter::Judge(const BodyEvidence& evidence, const body_model::BodyPose& pose) {
  kinematics_.Update(pose);
  limb_equations_.SetZero(kinematics_.proximal_m(0));
  Judge(evidence);
  return result_;
}

void BodyFitter::PlaceLimbs() {
  for (int limb = 0; limb < model_->limb_count(); ++limb) {
    const auto k = static_cast<std::size_t>(limb);
    const auto& shape = model_->limbs()[k].shape;
    surfaces_[k] = SurfaceOf(kinematics_.limb(limb), shape);
    capsules_[k] = CapsuleOf(kinematics_.limb(limb), shape);
  }
}

void BodyFitter::Assign(const BodyPoints& points, double reach_m) {
  const auto count = static_cast<std::size_t>(points.count());
  const auto across = static_cast<float>(config_.across_m);
  const auto reach = static_cast<float>(reach_m);
  scores2_.assign(count, reach / across * (reach / across));
  winners_.assign(count, -1);
  for (const PointBlock& block : points.blocks) AssignBlock(points, block, reach);
  SortByLimb(points);
}

// From the nearest limb on: those come no further that are too far to explain any point better.
void BodyFitter::AssignBlock(const BodyPoints& points, const PointBlock& block, float reach_m) {
  near_.clear();
  for (std::size_t k = 0; k < capsules_.size(); ++k) {
    const float gap_m = capsules_[k].Distance_m(block.centre_m) - block.radius_m;
    if (gap_m <= reach_m) near_.emplace_back(gap_m, static_cast<int>(k));
  }
  std::sort(near_.begin(), near_.end());
  const auto across = static_cast<float>(config_.across_m);
  const Eigen::Map<const Eigen::ArrayXf> sigmas(points.sigma_z_m.data() + block.first, block.count);
  const Eigen::Map<const Eigen::ArrayXf> scores2(scores2_.data() + block.first, block.count);
  const float unit_m = std::max(across, sigmas.maxCoeff());
  for (const auto& [gap_m, limb] : near_) {
    if (gap_m > 0.0F && gap_m * gap_m > scores2.maxCoeff() * unit_m * unit_m) break;
    ScoreLimb(surfaces_[static_cast<std::size_t>(limb)], limb, across,
              Slice(points, block.first, block.count),
              {scores2_.data() + block.first, winners_.data() + block.first});
  }
}

void BodyFitter::SortByLimb(const BodyPoints& points) {
  const auto limbs = static_cast<std::size_t>(model_->limb_count());
  std::fill(first_of_limb_.begin(), first_of_limb_.end(), 0);
  for (const int winner : winners_) {
    if (winner >= 0) ++first_of_limb_[static_cast<std::size_t>(winner) + 1];
  }
  for (std::size_t k = 0; k < limbs; ++k) first_of_limb_[k + 1] += first_of_limb_[k];
  const auto total = static_cast<std::size_t>(first_of_limb_[limbs]);
  for (auto* values : {&sorted_.x_m, &sorted_.y_m, &sorted_.z_m, &sorted_.sigma_z_m}) {
    values->resize(total);
  }
  std::copy(first_of_limb_.begin(), first_of_limb_.end() - 1, next_of_limb_.begin());
  for (std::size_t i = 0; i < winners_.size(); ++i) {
    if (winners_[i] < 0) continue;
    const auto at =
        static_cast<std::size_t>(next_of_limb_[static_cast<std::size_t>(winners_[i])]++);
    sorted_.x_m[at] = points.x_m[i];
    sorted_.y_m[at] = points.y_m[i];
    sorted_.z_m[at] = points.z_m[i];
    sorted_.sigma_z_m[at] = points.sigma_z_m[i];
  }
}

void BodyFitter::AddPoints(double scale_m) {
  const Eigen::Vector3f root_m = limb_equations_.root_m().cast<float>();
  const SumSettings settings{{root_m.x(), root_m.y(), root_m.z()},
                             static_cast<float>(scale_m),
                             static_cast<float>(config_.across_m)};
  for (std::size_t k = 0; k < sums_.size(); ++k) {
    sums_[k] = {};
    const int count = first_of_limb_[k + 1] - first_of_limb_[k];
    if (count > 0)
      SumLimb(surfaces_[k], settings, Slice(sorted_, first_of_limb_[k], count), sums_[k]);
  }
}

void BodyFitter::AddPriors(const body_model::BodyPose& pose, const body_model::BodyPose& predicted,
                           std::optional<double> seconds) {
  auto add = [this](int parameter, double wanted, double weight) {
    equations_.information(parameter, parameter) += weight;
    equations_.pull[parameter] += weight * wanted;
  };
  if (seconds) {
    const double grown = std::pow(std::clamp(30.0 * *seconds, 0.3, 30.0), 1.5);
    const auto weight = [this, grown](double sigma) {
      return config_.motion_weight / (sigma * sigma * grown * grown);
    };
    const Vector3d shift =
        predicted.frame_from_root.translation_m - pose.frame_from_root.translation_m;
    const Vector3d turn = RotationVector(predicted.frame_from_root.rotation *
                                         pose.frame_from_root.rotation.conjugate());
    for (int k = 0; k < 3; ++k) {
      add(k, shift[k], weight(config_.root_motion_m));
      add(3 + k, turn[k], weight(config_.root_motion_rad));
    }
    for (int limb = 0; limb < model_->limb_count(); ++limb) {
      const auto& freedom = freedoms_[static_cast<std::size_t>(limb)];
      const int first = model_->first_angle(limb);
      const auto dofs = model_->limbs()[static_cast<std::size_t>(limb)].dofs.size();
      for (int i = first; i < first + static_cast<int>(dofs); ++i) {
        add(6 + i, predicted.angles_rad[i] - pose.angles_rad[i], weight(freedom.motion_rad));
      }
    }
  }
  for (int limb = 0; limb < model_->limb_count(); ++limb) {
    const auto& freedom = freedoms_[static_cast<std::size_t>(limb)];
    if (freedom.rest_rad >= kFreeAngle_rad) continue;
    const int first = model_->first_angle(limb);
    const auto dofs = model_->limbs()[static_cast<std::size_t>(limb)].dofs.size();
    for (int i = first; i < first + static_cast<int>(dofs); ++i) {
      add(6 + i, rest_.angles_rad[i] - pose.angles_rad[i],
          1.0 / (freedom.rest_rad * freedom.rest_rad));
    }
  }
}

void BodyFitter::AddLimits(const body_model::BodyPose& pose) {
  const double weight = 1.0 / (config_.limit_rad * config_.limit_rad);
  for (int limb = 0; limb < model_->limb_count(); ++limb) {
    int angle = model_->first_angle(limb);
    for (const auto& dof : model_->limbs()[static_cast<std::size_t>(limb)].dofs) {
      const double now = pose.angles_rad[angle];
      const double wanted = std::clamp(now, dof.angle_min_rad, dof.angle_max_rad) - now;
      if (wanted != 0.0) {
        equations_.information(6 + angle, 6 + angle) += weight;
        equations_.pull[6 + angle] += weight * wanted;
      }
      ++angle;
    }
  }
}

void BodyFitter::AddUpright(const body_model::BodyPose& pose,
                            const std::optional<body_model::Floor>& floor) {
  if (config_.upright_rad >= kFreeAngle_rad) return;
  const Vector3d up = floor ? floor->normal : Vector3d(-Vector3d::UnitY());
  const Vector3d tilt = (pose.frame_from_root.rotation * Vector3d::UnitZ()).cross(up);
  const double weight = 1.0 / (config_.upright_rad * config_.upright_rad);
  for (int k = 0; k < 3; ++k) {
    equations_.information(3 + k, 3 + k) += weight * (1.0 - up[k] * up[k]);
    equations_.pull[3 + k] += weight * tilt[k];
  }
}

// Nothing of the body is below the floor; it need not stand on it.
void BodyFitter::AddFloor(const std::optional<body_model::Floor>& floor) {
  if (!floor) return;
  constexpr double kSigma_m = 0.02;
  for (int limb = 0; limb < model_->limb_count(); ++limb) {
    const Vector3d end_m = kinematics_.distal_m(limb);
    const double above_m = floor->normal.dot(end_m) + floor->offset_m;
    if (above_m < 0.0) {
      limb_equations_.Pull(limb, end_m, floor->normal, -above_m, 1.0 / (kSigma_m * kSigma_m));
    }
  }
}

void BodyFitter::Step(body_model::BodyPose& pose) {
  equations_.information.diagonal() *= 1.0 + kDamping;
  factors_.compute(equations_.information);
  step_ = factors_.solve(equations_.pull);
  const double largest = step_.cwiseAbs().maxCoeff();
  if (!std::isfinite(largest)) return;
  if (largest > kLargestStep) step_ *= kLargestStep / largest;
  pose.frame_from_root.translation_m += step_.head<3>();
  const Eigen::Matrix3d turn = body_model::RotationFrom(step_.segment<3>(3));
  pose.frame_from_root.rotation =
      (Eigen::Quaterniond(turn) * pose.frame_from_root.rotation).normalized();
  pose.angles_rad += step_.tail(model_->angle_count());
}

void BodyFitter::Judge(const BodyEvidence& evidence) {
  const BodyPoints& points = evidence.points();
  PlaceLimbs();
  Assign(points, config_.last_reach_m);
  AddPoints(config_.judged_scale_m);
  int explained = 0;
  double cost = 0.0;
  for (int limb = 0; limb < model_->limb_count(); ++limb) {
    const auto k = static_cast<std::size_t>(limb);
    LimbEvidence& found = result_.limbs[k];
    found = {};
    found.inlier_count = first_of_limb_[k + 1] - first_of_limb_[k];
    if (found.inlier_count > 0) {
      found.residual_m = std::sqrt(static_cast<double>(sums_[k].values[29]) / found.inlier_count);
    }
    found.view = outline_.Look(evidence, kinematics_, limb);
    explained += found.inlier_count;
    cost += static_cast<double>(sums_[k].values[27]);
  }
  Score(trunk_, points.count(), explained, cost, result_);
  result_.cue_cost = cues_.Cost(evidence.cues(), kinematics_);
}

}  // namespace deixis::pose_fitter
