#include "services/pose_fitter/core/cues/cue_owner.h"

#include <algorithm>
#include <limits>
#include <string>

namespace deixis::pose_fitter {
namespace {

using body_model::BodyModel;
using body_model::Kinematics;
using Eigen::Vector3d;

constexpr double kSlack = 1.1;        // Bodies are not known exactly.
constexpr double kHeadReach_m = 0.2;  // From the head's joint to what is seen of the face.

double Length_m(const BodyModel& model, const std::string& name) {
  const auto limb = model.Find(name);
  return limb ? model.limbs()[static_cast<std::size_t>(*limb)].shape.length_m : 0.0;
}

double Distance_m(const PartCue& cue, const Vector3d& point_m) {
  if (cue.distance_m) return (*cue.distance_m * cue.ray - point_m).norm();
  const Vector3d towards = cue.ray.normalized();
  return (towards.dot(point_m) * towards - point_m).norm();
}

}  // namespace

double Reaches(const PartCue& cue, const Kinematics& kinematics) {
  const BodyModel& model = kinematics.model();
  double least = std::numeric_limits<double>::infinity();
  if (cue.part == Part::kFace) {
    const auto head = model.Find("head");
    if (head) least = Distance_m(cue, kinematics.proximal_m(*head)) / kHeadReach_m;
    return least;
  }
  for (const std::string side : {"right_", "left_"}) {
    const auto upper = model.Find(side + "upper_arm");
    if (!upper) continue;
    const double reach_m =
        kSlack * (Length_m(model, side + "upper_arm") + Length_m(model, side + "lower_arm") +
                  Length_m(model, side + "hand"));
    least = std::min(least, Distance_m(cue, kinematics.proximal_m(*upper)) / reach_m);
  }
  return least;
}

}  // namespace deixis::pose_fitter
