// Writes a log with a person of config/body_models and how they stand, for readers in other
// languages: BODY_MODEL, then BODY_POSES of a standing, a pointing and a random pose.
#include <cmath>
#include <iostream>
#include <string>

#include "common/body_model/joint_angles.h"
#include "common/messages/body_poses.h"
#include "common/messages/person_model.h"
#include "common/transport/bus.h"
#include "test/common/body_model/body_samples.h"
#include "test/common/body_model/tracked_samples.h"

namespace {

using namespace deixis;
using body_model::BodyModel;
using body_model::BodyPose;
using Eigen::Vector3d;

constexpr std::int64_t kFrame_us = 33'333;

/// Of somebody who stands 3 m before a camera and looks into it, in its optical frame.
geometry::RigidTransform CameraFromRoot() {
  Eigen::Matrix3d rotation;  // Columns: anterior, to the left, cranial.
  rotation.col(0) = -Vector3d::UnitZ();
  rotation.col(1) = Vector3d::UnitX();
  rotation.col(2) = -Vector3d::UnitY();
  return {Eigen::Quaterniond(rotation), {0.1, 0.05, 3.0}};
}

BodyPose InView(const BodyModel& model) {
  BodyPose pose = body_model::Standing(model);
  pose.frame_from_root = CameraFromRoot();
  return pose;
}

/// The right arm to the side and forward.
BodyPose Pointing(const BodyModel& model) {
  BodyPose pose = InView(model);
  PointLimb(model, model.Find("right_upper_arm").value(), Vector3d(0.6, -0.8, 0.1), pose);
  return pose;
}

void Write(const std::string& name, transport::Bus& bus) {
  std::mt19937 random(5);
  const BodyModel model = body_model::Shipped(name, {anthropometry::Sex::kMale, 1.80});
  bus.Publish("BODY_MODEL", body_model::PersonOf(model));
  BodyPose any = RandomPose(model, random);
  any.frame_from_root.rotation.normalize();
  body_model::Kinematics kinematics(model);
  int frame = 0;
  for (const BodyPose& pose : {InView(model), Pointing(model), any}) {
    body_model::TrackedBody body = BodyOf(model, random);
    body.pose = pose;
    PlaceLimbs(kinematics, body);
    for (body_model::LimbPose& limb : body.limbs) limb.state = body_model::LimbState::kMeasured;
    body_model::BodyPoses poses = body_model::PosesOf(body);
    poses.time.microseconds += frame++ * kFrame_us;
    bus.Publish("BODY_POSES", poses);
  }
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) {
    std::cerr << "usage: write_body_messages MODEL LOG\nMODEL: a file of config/body_models, "
                 "without its ending\n";
    return 2;
  }
  try {
    transport::BusOptions options;
    options.url = "file://" + std::string(argv[2]) + "?mode=w";
    transport::Bus bus(options);
    Write(argv[1], bus);
    bus.Flush();
    return 0;
  } catch (const std::exception& error) {
    std::cerr << "write_body_messages: " << error.what() << "\n";
    return 1;
  }
}
