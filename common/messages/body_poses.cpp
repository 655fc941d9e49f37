#include "common/messages/body_poses.h"

#include <deixis/body_poses_t.hpp>

#include "common/messages/geometry_parts.h"

namespace deixis::messages {
namespace {

using body_model::BodyModel;
using body_model::BodyPoses;
using body_model::BodyState;
using body_model::Floor;
using body_model::LimbPose;
using body_model::LimbState;
using body_model::TrackedBody;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int kRootDimensions = 6;
constexpr std::int32_t kMostAngles = 3 * BodyModel::kMostLimbs;
constexpr double kLargestAngle_rad = 100.0;  // Trackers need not keep to one turn.
constexpr double kLargestEntry = kFarthest_m * kFarthest_m;

VectorXd ToAngles(const std::vector<double>& sent, double largest) {
  VectorXd angles(static_cast<Eigen::Index>(sent.size()));
  for (std::size_t i = 0; i < sent.size(); ++i) {
    angles[static_cast<Eigen::Index>(i)] = Within(sent[i], largest);
  }
  return angles;
}

std::vector<double> FromAngles(const VectorXd& angles, Eigen::Index count) {
  if (angles.size() != count) throw std::logic_error("a pose has not one rate for each angle");
  if (!angles.allFinite()) throw std::logic_error("an angle to be published is not finite");
  return {angles.data(), angles.data() + angles.size()};
}

MatrixXd ToFullCovariance(const body_pose_t& message) {
  if (message.covariance.empty()) return {};
  const Eigen::Index size = kRootDimensions + message.n_angles;
  if (message.n_covariance != size * (size + 1) / 2) throw Rejected("bad_covariance_size");
  MatrixXd covariance(size, size);
  auto entry = message.covariance.begin();
  for (Eigen::Index row = 0; row < size; ++row) {
    for (Eigen::Index column = 0; column <= row; ++column, ++entry) {
      covariance(row, column) = covariance(column, row) = Within(*entry, kLargestEntry);
    }
    NotNegative(covariance(row, row), kLargestEntry);
  }
  return covariance;
}

/// Zeros stand for rates that nobody knows.
std::vector<double> FromRates(const VectorXd& rates, Eigen::Index count) {
  if (rates.size() == 0) return std::vector<double>(static_cast<std::size_t>(count));
  return FromAngles(rates, count);
}

std::vector<float> FromFullCovariance(const TrackedBody& body) {
  const MatrixXd& covariance = body.covariance;
  if (covariance.size() == 0) return {};
  const Eigen::Index size = kRootDimensions + body.pose.angles_rad.size();
  if (covariance.rows() != size || covariance.cols() != size) {
    throw std::logic_error("a covariance to be published is not of root and angles");
  }
  if (!(covariance.array().abs() <= kLargestEntry).all()) {
    throw std::logic_error("a covariance to be published is not finite, or absurd");
  }
  std::vector<float> entries;
  entries.reserve(static_cast<std::size_t>(size * (size + 1) / 2));
  for (Eigen::Index row = 0; row < size; ++row) {
    for (Eigen::Index column = 0; column <= row; ++column) {
      entries.push_back(static_cast<float>(covariance(row, column)));
    }
  }
  return entries;
}

double ToResidual(double residual_m) {
  return residual_m == -1.0 ? residual_m : NotNegative(residual_m, kFarthest_m);
}

LimbPose ToLimb(const limb_pose_t& message) {
  LimbPose limb;
  limb.parent_from_limb =
      ToTransform(message.in_parent.translation_m, message.in_parent.rotation_wxyz);
  limb.frame_from_limb =
      ToTransform(message.in_frame.translation_m, message.in_frame.rotation_wxyz);
  limb.proximal_m = ToMetres<3>(message.proximal_m);
  limb.proximal_covariance_m2 = ToCovariance<3>(message.proximal_covariance_m2, kFarthest_m);
  limb.distal_m = ToMetres<3>(message.distal_m);
  limb.distal_covariance_m2 = ToCovariance<3>(message.distal_covariance_m2, kFarthest_m);
  limb.state = Enumeration(message.state, LimbState::kLost);
  limb.residual_m = ToResidual(message.residual_m);
  limb.inlier_count = AtLeast(0, message.n_inliers);
  return limb;
}

limb_pose_t FromLimb(const LimbPose& limb) {
  limb_pose_t message{};
  FromTransform(limb.parent_from_limb, message.in_parent.translation_m,
                message.in_parent.rotation_wxyz);
  FromTransform(limb.frame_from_limb, message.in_frame.translation_m,
                message.in_frame.rotation_wxyz);
  FromVector(limb.proximal_m, message.proximal_m);
  FromSymmetric(limb.proximal_covariance_m2, message.proximal_covariance_m2);
  FromVector(limb.distal_m, message.distal_m);
  FromSymmetric(limb.distal_covariance_m2, message.distal_covariance_m2);
  message.state = Number(limb.state);
  message.residual_m = Outgoing(limb.residual_m);
  message.n_inliers = limb.inlier_count;
  return message;
}

TrackedBody ToBody(const body_pose_t& message) {
  RequireCount(message.n_angles, kMostAngles);
  RequireCount(message.n_limbs, BodyModel::kMostLimbs);
  TrackedBody body;
  body.person_id = AtLeast(0, message.person_id);
  body.identity = Text(message.identity);
  if (message.model_id == 0) throw Rejected("bad_model_id");
  body.model_id = message.model_id;
  body.state = Enumeration(message.state, BodyState::kLost);
  body.pose.frame_from_root =
      ToTransform(message.root_in_frame.translation_m, message.root_in_frame.rotation_wxyz);
  const auto velocity = ToMetres<6>(message.root_velocity);
  body.root_velocity_m_per_s = velocity.head<3>();
  body.root_rate_rad_per_s = velocity.tail<3>();
  body.pose.angles_rad = ToAngles(message.angles_rad, kLargestAngle_rad);
  body.rates_rad_per_s = ToAngles(message.rates_rad_per_s, kFarthest_m);
  body.covariance = ToFullCovariance(message);
  for (const limb_pose_t& limb : message.limbs) body.limbs.push_back(ToLimb(limb));
  return body;
}

body_pose_t FromBody(const TrackedBody& body) {
  body_pose_t message{};
  message.person_id = body.person_id;
  message.identity = body.identity;
  message.model_id = body.model_id;
  message.state = Number(body.state);
  FromTransform(body.pose.frame_from_root, message.root_in_frame.translation_m,
                message.root_in_frame.rotation_wxyz);
  Eigen::Matrix<double, 6, 1> velocity;
  velocity << body.root_velocity_m_per_s, body.root_rate_rad_per_s;
  FromVector(velocity, message.root_velocity);
  const Eigen::Index angle_count = body.pose.angles_rad.size();
  message.n_angles = static_cast<std::int32_t>(angle_count);
  message.angles_rad = FromAngles(body.pose.angles_rad, angle_count);
  message.rates_rad_per_s = FromRates(body.rates_rad_per_s, angle_count);
  message.covariance = FromFullCovariance(body);
  message.n_covariance = static_cast<std::int32_t>(message.covariance.size());
  for (const LimbPose& limb : body.limbs) message.limbs.push_back(FromLimb(limb));
  message.n_limbs = static_cast<std::int32_t>(message.limbs.size());
  return message;
}

Floor ToFloor(const double (&plane)[4]) {
  const auto values = ToMetres<4>(plane);
  const Floor floor{values.head<3>(), values[3]};
  if (!(std::abs(floor.normal.norm() - 1.0) <= kUnitTolerance)) throw Rejected("not_a_plane");
  return floor;
}

void RequireAscending(const std::vector<body_pose_t>& bodies) {
  for (std::size_t i = 1; i < bodies.size(); ++i) {
    if (bodies[i].person_id <= bodies[i - 1].person_id) throw Rejected("bad_order");
  }
}

}  // namespace

Decoded<BodyPoses> Codec<BodyPoses>::Decode(Bytes bytes) {
  const auto message = DecodeWire<body_poses_t>(bytes);
  RequireCount(message.n_bodies, kMostBodies);
  RequireAscending(message.bodies);
  BodyPoses poses;
  poses.time = ToTimestamp(message.utime);
  poses.camera = Text(message.camera);
  poses.frame = Text(message.frame);
  poses.source = Text(message.source);
  if (message.has_floor) poses.floor = ToFloor(message.floor_plane);
  for (const body_pose_t& body : message.bodies) poses.bodies.push_back(ToBody(body));
  return {std::move(poses), Count(message.sequence)};
}

std::vector<std::uint8_t> Codec<BodyPoses>::Encode(const BodyPoses& poses, std::int64_t sequence) {
  body_poses_t message{};
  message.utime = poses.time.microseconds;
  message.sequence = sequence;
  message.camera = poses.camera;
  message.frame = poses.frame;
  message.source = poses.source;
  message.has_floor = poses.floor.has_value();
  if (poses.floor) {
    Eigen::Vector4d plane;
    plane << poses.floor->normal, poses.floor->offset_m;
    FromVector(plane, message.floor_plane);
  }
  for (const TrackedBody& body : poses.bodies) message.bodies.push_back(FromBody(body));
  message.n_bodies = static_cast<std::int32_t>(message.bodies.size());
  return EncodeWire(message);
}

void CheckAgainst(const TrackedBody& body, const BodyModel& model) {
  if (body.model_id != model.id()) throw Rejected("other_model");
  if (body.pose.angles_rad.size() != model.angle_count()) throw Rejected("bad_angle_count");
  if (static_cast<int>(body.limbs.size()) != model.limb_count()) throw Rejected("bad_limb_count");
}

}  // namespace deixis::messages
