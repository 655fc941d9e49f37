#pragma once
#include <Eigen/Core>
#include <array>
#include <string>
#include <vector>

#include "common/body_model/body_model.h"

namespace deixis::anthropometer {

/// The surface of one limb: triangles, anticlockwise from outside, that share their corners and
/// leave no gap. Where the side meets a disc, the normal is halfway between both.
struct LimbMesh {
  std::vector<Eigen::Vector3d> points_m;
  std::vector<Eigen::Vector3d> normals;  ///< Unit, outward, one per point.
  std::vector<std::array<int, 3>> triangles;
};

/// In the limb's frame; `around` >= 3 points on each ellipse, `along` >= 1 stretches between them.
LimbMesh MeshOf(const geometry::DegenerateCylinder& shape, int around, int along);

/// All limbs in a pose, as a binary PLY file: points with normals, colours and the number of their
/// limb, triangles. Metres, x forward, z up; the base limb's joint lies above the origin, what is
/// lowest at z = 0.
std::string PlyOf(const body_model::BodyModel& model, const body_model::BodyPose& pose);

}  // namespace deixis::anthropometer
