#include "services/anthropometer/core/mesh.h"

#include <gtest/gtest.h>

#include <map>

#include "common/body_model/joint_angles.h"
#include "services/anthropometer/core/solid.h"
#include "test/services/anthropometer/person.h"

namespace deixis::anthropometer {
namespace {

using Eigen::Vector3d;

double VolumeOf(const LimbMesh& mesh) {
  double six_volumes = 0.0;
  for (const auto& [a, b, c] : mesh.triangles) {
    const auto at = [&](int i) { return mesh.points_m[static_cast<std::size_t>(i)]; };
    six_volumes += at(a).dot(at(b).cross(at(c)));
  }
  return six_volumes / 6.0;
}

TEST(Mesh, LeavesNoGapAndLooksOutward) {
  const auto model = TallMan("whole_body_detailed");
  for (const auto& limb : model.limbs()) {
    const LimbMesh mesh = MeshOf(limb.shape, 64, 8);
    std::map<std::pair<int, int>, int> edges;
    for (const auto& [a, b, c] : mesh.triangles) {
      for (const auto& edge : {std::pair(a, b), std::pair(b, c), std::pair(c, a)}) ++edges[edge];
    }
    for (const auto& [edge, count] : edges) {
      EXPECT_EQ(count, 1) << limb.name;
      EXPECT_EQ(edges.count({edge.second, edge.first}), 1u) << limb.name;
    }
    EXPECT_NEAR(VolumeOf(mesh) / SolidOf(limb.shape).volume_m3, 1.0, 0.003) << limb.name;
  }
}

TEST(Mesh, HasUnitNormalsThatPointAsItsTrianglesDo) {
  const LimbMesh mesh = MeshOf({0.1, 0.05, 0.04, 0.06, 0.3, {0.01, 0.0}, {-0.02, 0.03}}, 24, 3);
  ASSERT_EQ(mesh.normals.size(), mesh.points_m.size());
  for (const auto& triangle : mesh.triangles) {
    const auto at = [&](int k) { return mesh.points_m[static_cast<std::size_t>(triangle[k])]; };
    const Vector3d outward = (at(1) - at(0)).cross(at(2) - at(0));
    for (const int corner : triangle) {
      const Vector3d& normal = mesh.normals[static_cast<std::size_t>(corner)];
      EXPECT_NEAR(normal.norm(), 1.0, 1e-12);
      EXPECT_GT(normal.dot(outward), 0.0);
    }
  }
}

TEST(Mesh, BeginsItsFileWithTheCounts) {
  const auto model = TallMan("right_arm");
  const std::string ply = PlyOf(model, Standing(model));
  const int points = model.limb_count() * (64 * 9 + 2);
  EXPECT_EQ(ply.rfind("ply\nformat binary_little_endian 1.0\n", 0), 0u);
  EXPECT_NE(ply.find("element vertex " + std::to_string(points) + "\n"), std::string::npos);
  EXPECT_EQ(ply, PlyOf(model, Standing(model)));
}

TEST(Solid, IsThatOfKnownBodies) {
  const Solid cylinder = SolidOf({0.1, 0.1, 0.1, 0.1, 0.5, {0.0, 0.2}, {0.0, 0.2}});
  const double volume = M_PI * 0.01 * 0.5;
  EXPECT_NEAR(cylinder.volume_m3, volume, 1e-15);
  EXPECT_LE((cylinder.centre_m - Vector3d(0.0, 0.2, 0.25)).norm(), 1e-12);
  EXPECT_NEAR(cylinder.inertia_m5(2, 2), 0.5 * volume * 0.01, 1e-12);
  EXPECT_NEAR(cylinder.inertia_m5(0, 0), volume * (0.01 / 4.0 + 0.25 / 12.0), 1e-12);
  // A cone's frustum: V = pi L (R^2 + R r + r^2) / 3.
  EXPECT_NEAR(SolidOf({0.2, 0.2, 0.1, 0.1, 1.0}).volume_m3, M_PI * 0.07 / 3.0, 1e-12);
  EXPECT_NEAR(MeanRadius_m({0.1, 0.1, 0.1, 0.1, 0.5}), 0.1, 1e-12);
}

}  // namespace
}  // namespace deixis::anthropometer
