#pragma once
#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "common/anthropometry/body_measures.h"
#include "common/body_model/body_model.h"
#include "common/body_model/kinematics.h"
#include "common/time/timestamp.h"

namespace deixis::body_model {

/// The shape of one person, as it holds from one image on.
struct PersonModel {
  Timestamp time;  ///< Of that image.
  BodyModel body;
  int person_id = -1;                       ///< Track; -1 = nobody's, the average person's.
  std::string identity{};                   ///< Stable key of the person; empty = not known.
  std::optional<anthropometry::Sex> sex{};  ///< What the proportions suggest. Never a fact.
  double female_probability = 0.5;          ///< That the female tables fit better, 0..1.
  double stature_m = 0.0;                   ///< 0 = not known.
  double stature_variance_m2 = 0.0;
  bool is_frozen = false;  ///< No longer adapted.
};

/// How a body is known.
enum class BodyState {
  kStarting,  ///< Found, not settled yet.
  kTracked,   ///< Followed.
  kLost       ///< Last known pose, not to be relied upon.
};

/// What a limb's place rests on.
enum class LimbState {
  kMeasured,  ///< Its own data.
  kInferred,  ///< Its neighbours and limits.
  kHidden,    ///< It is known to be out of sight.
  kLost       ///< Not to be relied upon.
};

/// Where one limb is, in the frame of the body's root, and how sure that is.
struct LimbPose {
  geometry::RigidTransform parent_from_limb;  ///< Of the base limb as `frame_from_limb`.
  geometry::RigidTransform frame_from_limb;
  Eigen::Vector3d proximal_m = Eigen::Vector3d::Zero();
  Eigen::Matrix3d proximal_covariance_m2 = Eigen::Matrix3d::Zero();
  Eigen::Vector3d distal_m = Eigen::Vector3d::Zero();
  Eigen::Matrix3d distal_covariance_m2 = Eigen::Matrix3d::Zero();
  LimbState state = LimbState::kLost;
  double residual_m = -1.0;  ///< RMS distance of its points to its surface; -1 = no points.
  int inlier_count = 0;      ///< Points that rest on this limb.
};

/// One person at one image.
struct TrackedBody {
  int person_id = 0;          ///< Track, >= 0.
  std::string identity;       ///< Stable key of the person; empty = not known.
  std::int64_t model_id = 0;  ///< BodyModel::id() of the model that the angles belong to.
  BodyState state = BodyState::kStarting;
  BodyPose pose;
  Eigen::Vector3d root_velocity_m_per_s = Eigen::Vector3d::Zero();
  Eigen::Vector3d root_rate_rad_per_s = Eigen::Vector3d::Zero();  ///< Angular, in the frame.
  Eigen::VectorXd rates_rad_per_s;  ///< One per angle; empty or zeros = not known.
  /// Of root translation (metres), root rotation (a rotation vector in the frame, radians) and
  /// angles (radians), in the order of PointJacobian; 0 x 0 = not known.
  Eigen::MatrixXd covariance;
  std::vector<LimbPose> limbs;  ///< In the model's order.
};

/// normal . point + offset_m = 0 on the floor.
struct Floor {
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();  ///< Of unit length, upward.
  double offset_m = 0.0;
};

/// Everybody at one image; an empty list says that nobody is there.
struct BodyPoses {
  Timestamp time;
  std::string camera;  ///< Image that the poses come from.
  std::string frame;   ///< Frame of positions.
  std::string source;  ///< Which tracker says so.
  std::optional<Floor> floor;
  std::vector<TrackedBody> bodies;  ///< By ascending person_id.
};

/// Says where the limbs are: fills `model_id` and, in `limbs`, transforms, ends and their
/// covariances (zero where the body's is not known) from pose and covariance by forward kinematics.
/// What limbs rest on stays as it is. Throws std::logic_error when angles or covariance are not of
/// the model's size.
void PlaceLimbs(Kinematics& kinematics, TrackedBody& body);

}  // namespace deixis::body_model
