#include "services/pose_fitter/trainer/marker_pose.h"

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <utility>

#include "common/body_model/joint_angles.h"
#include "common/body_model/kinematics.h"

namespace deixis::pose_fitter {
namespace {

using body_model::BodyModel;
using body_model::BodyPose;
using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr int kIterations = 40;
constexpr double kSoft = 0.5;          // Weight of markers on skin, which moves on the bones.
constexpr double kDamping = 1e-4;      // m^2 per rad^2: angles that nothing shows stay.
constexpr double kLimitWeight = 0.05;  // m^2 per rad^2 beyond the envelope.
constexpr double kLargestStep_rad = 0.5;

struct Joint {
  const char* marker;
  const char* limb;
};
constexpr Joint kMiddle[] = {{"spine", "abdomen"}, {"neck", "neck"}, {"head", "head"}};
constexpr Joint kSided[] = {{"shoulder", "upper_arm"}, {"elbow", "lower_arm"}, {"wrist", "hand"},
                            {"hip", "thigh"},          {"knee", "shank"},      {"ankle", "foot"}};
constexpr std::pair<const char*, const char*> kSides[] = {{"r_", "right_"}, {"l_", "left_"}};

Matrix3d RootAxes(const Markers& markers) {
  Matrix3d axes;
  axes.col(1) = (markers.at("l_hip") - markers.at("r_hip")).normalized();
  const Vector3d up = markers.at("spine") - markers.at("pelvis");
  axes.col(2) = (up - up.dot(axes.col(1)) * axes.col(1)).normalized();
  axes.col(0) = axes.col(1).cross(axes.col(2));
  return axes;
}

int Limb(const BodyModel& model, const std::string& name) { return model.Find(name).value(); }

/// Height of the hips in the base limb's frame.
double HipHeight(const BodyModel& model) {
  const auto thigh = static_cast<std::size_t>(Limb(model, "right_thigh"));
  return model.limbs()[thigh].rest_in_parent.translation_m.z();
}

BodyPose StartAt(const BodyModel& model, const Markers& markers) {
  BodyPose pose = body_model::Standing(model);
  const Matrix3d axes = RootAxes(markers);
  pose.frame_from_root = {Eigen::Quaterniond(axes),
                          markers.at("pelvis") - HipHeight(model) * axes.col(2)};
  const auto point = [&](const std::string& limb, const std::string& from, const std::string& to) {
    const Vector3d direction = markers.at(to) - markers.at(from);
    body_model::PointLimb(model, Limb(model, limb), axes.transpose() * direction, pose);
  };
  for (const auto& [side, limb] : kSides) {
    const std::string s(side), l(limb);
    point(l + "upper_arm", s + "shoulder", s + "elbow");
    point(l + "thigh", s + "hip", s + "knee");
  }
  return pose;
}

/// Where the markers of heads stand in the frame of a limb that stands upright.
Vector3d UprightPlace(const RenderedPerson& person, const Markers& markers, const std::string& from,
                      const std::string& to) {
  const Vector3d left = markers.at("l_hip") - markers.at("r_hip");
  Matrix3d axes;
  axes.col(2) = person.up;
  axes.col(1) = (left - left.dot(person.up) * person.up).normalized();
  axes.col(0) = axes.col(1).cross(axes.col(2));
  return axes.transpose() * (markers.at(to) - markers.at(from));
}

class NormalEquations {
 public:
  NormalEquations(const BodyModel& model)
      : size_(6 + model.angle_count()),
        jacobian_(3, size_),
        matrix_(size_, size_),
        vector_(size_) {}

  void Reset() {
    matrix_.setZero();
    vector_.setZero();
  }
  void Add(const body_model::Kinematics& kinematics, const MarkerPlace& place,
           const Vector3d& wanted_m) {
    const Vector3d point_m = kinematics.limb(place.limb) * place.place_m;
    body_model::PointJacobian(kinematics, place.limb, point_m, jacobian_);
    matrix_.noalias() += place.weight * jacobian_.transpose() * jacobian_;
    vector_.noalias() += place.weight * jacobian_.transpose() * (wanted_m - point_m);
  }
  void AddLimits(const BodyModel& model, const BodyPose& pose) {
    matrix_.diagonal().array() += kDamping;
    int index = 0;
    for (const body_model::Limb& limb : model.limbs()) {
      for (const body_model::DegreeOfFreedom& dof : limb.dofs) {
        const double angle = pose.angles_rad[index];
        const double beyond =
            angle - std::min(std::max(angle, dof.angle_min_rad), dof.angle_max_rad);
        if (beyond != 0.0) {
          matrix_(6 + index, 6 + index) += kLimitWeight;
          vector_[6 + index] -= kLimitWeight * beyond;
        }
        vector_[6 + index] -= 0.1 * kDamping * angle;
        ++index;
      }
    }
  }
  Eigen::VectorXd Step() const {
    Eigen::VectorXd step = matrix_.ldlt().solve(vector_);
    const double largest = step.tail(size_ - 3).cwiseAbs().maxCoeff();
    return largest > kLargestStep_rad ? step * (kLargestStep_rad / largest) : step;
  }

 private:
  Eigen::Index size_;
  Eigen::Matrix3Xd jacobian_;
  Eigen::MatrixXd matrix_;
  Eigen::VectorXd vector_;
};

void Move(const Eigen::VectorXd& step, BodyPose& pose) {
  pose.frame_from_root.translation_m += step.head<3>();
  const Eigen::Quaterniond turn(body_model::RotationFrom(step.segment<3>(3)));
  pose.frame_from_root.rotation = (turn * pose.frame_from_root.rotation).normalized();
  pose.angles_rad += step.tail(step.size() - 6);
}

double JointError(const body_model::Kinematics& kinematics, const std::vector<MarkerPlace>& places,
                  const Markers& markers) {
  double sum_m = 0.0;
  int count = 0;
  for (const MarkerPlace& place : places) {
    if (place.weight < 1.0) continue;
    sum_m += (kinematics.limb(place.limb) * place.place_m - markers.at(place.marker)).norm();
    ++count;
  }
  return sum_m / count;
}

void PlaceSide(const RenderedPerson& person, const Markers& markers, const BodyModel& model,
               const std::string& side, const std::string& prefix,
               std::vector<MarkerPlace>& places) {
  for (const Joint& joint : kSided) {
    places.push_back(
        {side + joint.marker, Limb(model, prefix + joint.limb), Vector3d::Zero(), 1.0});
  }
  const double palm_m = (markers.at(side + "hand") - markers.at(side + "wrist")).norm();
  places.push_back({side + "hand", Limb(model, prefix + "hand"), {0.0, 0.0, palm_m}, kSoft});
  const double towards_left = prefix == "left_" ? 1.0 : -1.0;
  const double hand_m = person.lengths_m.at("r_hand");
  // Of the index finger, slightly bent: on the thumb's side and before the palm.
  const Vector3d fingertip(0.13 * hand_m, 0.12 * hand_m * towards_left, 0.85 * hand_m);
  places.push_back({side + "fingertip", Limb(model, prefix + "hand"), fingertip, 0.1});
  const Vector3d foot = UprightPlace(person, markers, side + "ankle", side + "foot");
  places.push_back({side + "foot",
                    Limb(model, prefix + "foot"),
                    {foot.z(), 0.0, std::hypot(foot.x(), foot.y())},
                    kSoft});
}

}  // namespace

std::vector<MarkerPlace> PlaceMarkers(const RenderedPerson& person, int frame,
                                      const BodyModel& model) {
  const Markers& markers = person.frames.at(static_cast<std::size_t>(frame));
  std::vector<MarkerPlace> places{{"pelvis", 0, {0.0, 0.0, HipHeight(model)}, 1.0}};
  for (const Joint& joint : kMiddle) {
    places.push_back({joint.marker, Limb(model, joint.limb), Vector3d::Zero(), 1.0});
  }
  for (const char* marker : {"head_top", "nose", "chin"}) {
    places.push_back(
        {marker, Limb(model, "head"), UprightPlace(person, markers, "head", marker), kSoft});
  }
  for (const auto& [side, prefix] : kSides) {
    PlaceSide(person, markers, model, side, prefix, places);
  }
  return places;
}

MarkerPose FindPose(const BodyModel& model, const std::vector<MarkerPlace>& places,
                    const Markers& markers) {
  MarkerPose found{StartAt(model, markers), 0.0};
  body_model::Kinematics kinematics(model);
  NormalEquations equations(model);
  for (int i = 0; i < kIterations; ++i) {
    kinematics.Update(found.pose);
    equations.Reset();
    for (const MarkerPlace& place : places) {
      equations.Add(kinematics, place, markers.at(place.marker));
    }
    equations.AddLimits(model, found.pose);
    Move(equations.Step(), found.pose);
  }
  kinematics.Update(found.pose);
  found.joint_error_m = JointError(kinematics, places, markers);
  return found;
}

}  // namespace deixis::pose_fitter
