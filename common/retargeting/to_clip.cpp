#include "common/retargeting/to_clip.h"

#include <algorithm>
#include <array>

#include "common/body_model/joint_angles.h"
#include "common/body_model/kinematics.h"
#include "common/motion/bvh.h"

namespace deixis::retargeting {
namespace {

using body_model::BodyModel;
using body_model::Kinematics;
using Eigen::Matrix3d;
using motion::ChannelKind;

/// x left, y up, z forward, as most motion files.
Matrix3d FileFromBody() {
  Matrix3d axes;
  axes << 0, 1, 0, 0, 0, 1, 1, 0, 0;
  return axes;
}

motion::Skeleton SkeletonOf(const BodyModel& model, const Kinematics& standing) {
  const Matrix3d file_from_body = FileFromBody();
  motion::Skeleton skeleton;
  for (int i = 0; i < model.limb_count(); ++i) {
    const body_model::Limb& limb = model.limbs()[static_cast<std::size_t>(i)];
    motion::Joint joint;
    joint.name = limb.name;
    joint.parent = limb.parent;
    if (limb.parent < 0) {
      joint.channels = {ChannelKind::kXTranslation, ChannelKind::kYTranslation,
                        ChannelKind::kZTranslation};
    } else {
      joint.offset_m = file_from_body * (standing.proximal_m(i) - standing.proximal_m(limb.parent));
    }
    for (const auto kind :
         {ChannelKind::kZRotation, ChannelKind::kXRotation, ChannelKind::kYRotation}) {
      joint.channels.push_back(kind);
    }
    if (model.children(i).empty()) {
      joint.end_sites_m = {file_from_body * (standing.distal_m(i) - standing.proximal_m(i))};
    }
    skeleton.joints.push_back(std::move(joint));
  }
  return skeleton;
}

}  // namespace

motion::Clip ToClip(const BodyMotion& motion) {
  const BodyModel& model = motion.model;
  const Matrix3d file_from_body = FileFromBody();
  Kinematics standing(model), now(model);
  body_model::BodyPose upright = Standing(model);
  upright.frame_from_root = {};
  standing.Update(upright);
  motion::Clip clip;
  clip.skeleton = SkeletonOf(model, standing);
  clip.frame_rate_hz = motion.frame_rate_hz;
  clip.frames.resize(static_cast<Eigen::Index>(motion.poses.size()), clip.skeleton.ChannelCount());
  std::vector<Matrix3d> turned(model.limbs().size());
  for (Eigen::Index frame = 0; frame < clip.frames.rows(); ++frame) {
    now.Update(motion.poses[static_cast<std::size_t>(frame)]);
    clip.frames.row(frame).head<3>() = (file_from_body * now.proximal_m(0)).transpose();
    for (int i = 0; i < model.limb_count(); ++i) {
      const int parent = model.limbs()[static_cast<std::size_t>(i)].parent;
      Matrix3d& turn = turned[static_cast<std::size_t>(i)];
      turn = file_from_body * now.limb(i).linear() * standing.limb(i).linear().transpose() *
             file_from_body.transpose();
      const Matrix3d local =
          parent < 0 ? turn : turned[static_cast<std::size_t>(parent)].transpose() * turn;
      const std::array<double, 3> angles_rad = motion::AnglesZxy(local);
      std::copy(angles_rad.begin(), angles_rad.end(), &clip.frames(frame, 3 + 3 * i));
    }
  }
  return clip;
}

}  // namespace deixis::retargeting
