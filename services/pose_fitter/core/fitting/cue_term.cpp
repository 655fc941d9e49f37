#include "services/pose_fitter/core/fitting/cue_term.h"

#include <algorithm>

#include "common/config/config.h"

namespace deixis::pose_fitter {
namespace {

using Eigen::Vector3d;

constexpr double kThickness_m = 0.02;   // From what is seen of a part to its middle.
constexpr double kAlongSigma_m = 0.03;  // Error along the ray beside that across it.

/// What moves a point to where the cue is: across its ray, and along it where that is measured.
Vector3d Off(const PartCue& cue, const Vector3d& point_m) {
  if (cue.distance_m) return (*cue.distance_m + kThickness_m) * cue.ray - point_m;
  const Vector3d towards = cue.ray.normalized();
  return towards.dot(point_m) * towards - point_m;
}

}  // namespace

void CueConfig::Validate() const {
  config::Faults faults;
  faults.Require(hand_weight >= 0.0, "hand_weight", "must not be negative");
  faults.Require(face_weight >= 0.0, "face_weight", "must not be negative");
  faults.Require(body_sigma_m > 0.0, "body_sigma_m", "must be positive");
  faults.Require(most_m > 0.0, "most_m", "must be positive");
  faults.Require(side_cost >= 0.0, "side_cost", "must not be negative");
  faults.ThrowIfAny();
}

CueTerm::CueTerm(const CueConfig& config, const body_model::BodyModel& model) : config_(config) {
  const std::array<const char*, 2> names{"right_hand", "left_hand"};
  for (std::size_t side = 0; side < 2; ++side) {
    if (const auto limb = model.Find(names[side])) {
      const auto& hand = model.limbs()[static_cast<std::size_t>(*limb)];
      hands_[side] = {*limb, kHandShare * hand.shape.length_m * Vector3d::UnitZ()};
    }
  }
  if (const auto limb = model.Find("head")) {
    const auto& shape = model.limbs()[static_cast<std::size_t>(*limb)].shape;
    face_ = {*limb, {shape.centre0_m.x() + shape.a0_m - kThickness_m, 0.0, 0.0}};
  }
}

Vector3d CueTerm::Place(const BodyPart& part, const body_model::Kinematics& kinematics) const {
  return kinematics.limb(part.limb) * part.point_m;
}

double CueTerm::Cost(const PartCue& cue, const Vector3d& place_m) const {
  const double off2_m2 = Off(cue, place_m).squaredNorm();
  return off2_m2 / (off2_m2 + config_.most_m * config_.most_m);
}

double CueTerm::HandCost(const PartCue& cue, int side,
                         const body_model::Kinematics& kinematics) const {
  const BodyPart& hand = hands_[static_cast<std::size_t>(side)];
  if (hand.limb < 0) return cue.trust;
  const double wrong_side = side == 0 ? 1.0 - cue.right_probability : cue.right_probability;
  return cue.trust * (Cost(cue, Place(hand, kinematics)) + config_.side_cost * wrong_side);
}

// Each hand goes with one cue at most, so that all together cost the least; a cue that no hand goes
// with costs 1 times its trust.
double CueTerm::AssignHands(const std::vector<PartCue>& cues,
                            const body_model::Kinematics& kinematics) {
  cue_of_hand_ = {-1, -1};
  const int count = static_cast<int>(cues.size());
  double least_gain = 0.0;
  double unexplained = 0.0;
  for (const PartCue& cue : cues) unexplained += cue.part == Part::kHand ? cue.trust : 0.0;
  const auto gain = [&](int cue, int side) {
    if (cue < 0) return 0.0;
    const PartCue& hand = cues[static_cast<std::size_t>(cue)];
    return HandCost(hand, side, kinematics) - hand.trust;
  };
  const auto is_hand = [&cues](int cue) {
    return cue < 0 || cues[static_cast<std::size_t>(cue)].part == Part::kHand;
  };
  for (int right = -1; right < count; ++right) {
    if (!is_hand(right)) continue;
    const double of_right = gain(right, 0);
    for (int left = -1; left < count; ++left) {
      if (!is_hand(left) || (left >= 0 && left == right)) continue;
      const double both = of_right + gain(left, 1);
      if (both >= least_gain) continue;
      least_gain = both;
      cue_of_hand_ = {right, left};
    }
  }
  return unexplained + least_gain;
}

void CueTerm::Pull(const PartCue& cue, const BodyPart& part,
                   const body_model::Kinematics& kinematics, double weight,
                   LimbEquations& equations) const {
  const Vector3d place_m = Place(part, kinematics);
  if (place_m.z() <= 0.0) return;
  const Vector3d off_m = Off(cue, place_m);
  const double across_m = cue.sigma * place_m.z();
  const double variance_m2 = config_.body_sigma_m * config_.body_sigma_m + across_m * across_m;
  const double near = 1.0 - Cost(cue, place_m);
  const double w = weight * cue.trust * near * near / variance_m2;
  const Vector3d along = cue.ray.normalized(), across = along.unitOrthogonal();
  for (const Vector3d& direction : {across, Vector3d(along.cross(across))}) {
    equations.Pull(part.limb, place_m, direction, direction.dot(off_m), w);
  }
  if (!cue.distance_m) return;
  const double slack = variance_m2 / (variance_m2 + kAlongSigma_m * kAlongSigma_m);
  equations.Pull(part.limb, place_m, along, along.dot(off_m), w * slack);
}

void CueTerm::AddTo(const std::vector<PartCue>& cues, const body_model::Kinematics& kinematics,
                    double weight, LimbEquations& equations) {
  if (cues.empty()) return;
  AssignHands(cues, kinematics);
  for (std::size_t side = 0; side < 2; ++side) {
    if (cue_of_hand_[side] < 0) continue;
    Pull(cues[static_cast<std::size_t>(cue_of_hand_[side])], hands_[side], kinematics,
         weight * config_.hand_weight, equations);
  }
  if (face_.limb < 0) return;
  for (const PartCue& cue : cues) {
    if (cue.part == Part::kFace) {
      Pull(cue, face_, kinematics, weight * config_.face_weight, equations);
    }
  }
}

double CueTerm::Cost(const std::vector<PartCue>& cues, const body_model::Kinematics& kinematics) {
  double cost = AssignHands(cues, kinematics);
  if (face_.limb < 0) return cost;
  for (const PartCue& cue : cues) {
    if (cue.part != Part::kFace) continue;
    // A face is seen from before.
    const auto& head = kinematics.limb(face_.limb);
    const bool is_before = (head.linear() * Vector3d::UnitX()).dot(head.translation()) < 0.0;
    cost += is_before ? Cost(cue, Place(face_, kinematics)) : 1.0;
  }
  return cost;
}

}  // namespace deixis::pose_fitter
