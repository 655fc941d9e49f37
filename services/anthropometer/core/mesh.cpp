#include "services/anthropometer/core/mesh.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>

#include "common/body_model/kinematics.h"

namespace deixis::anthropometer {
namespace {

using body_model::BodyModel;
using Eigen::Vector3d;

constexpr int kAround = 64;
constexpr int kAlong = 8;
using Colour = std::array<std::uint8_t, 3>;  // red, green, blue

Colour ColourOf(const std::string& limb) {
  if (limb.rfind("right_", 0) == 0) return {225, 180, 150};
  if (limb.rfind("left_", 0) == 0) return {160, 190, 225};
  return {195, 205, 205};
}

template <typename T>
void Append(T value, std::string& bytes) {
  static_assert(__BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__, "PLY is written little-endian");
  char raw[sizeof value];
  std::memcpy(raw, &value, sizeof value);
  bytes.append(raw, sizeof value);
}

void Append(const Vector3d& v, std::string& bytes) {
  for (int i = 0; i < 3; ++i) Append(static_cast<float>(v[i]), bytes);
}

std::string HeaderOf(std::size_t points, std::size_t triangles) {
  std::string header = "ply\nformat binary_little_endian 1.0\ncomment Deixis body model, metres\n";
  header += "element vertex " + std::to_string(points) + "\n";
  for (const char* name : {"x", "y", "z", "nx", "ny", "nz"}) {
    header += std::string("property float ") + name + "\n";
  }
  header += "property uchar red\nproperty uchar green\nproperty uchar blue\nproperty ushort limb\n";
  header += "element face " + std::to_string(triangles) + "\n";
  return header + "property list uchar int vertex_indices\nend_header\n";
}

/// The limbs' meshes in the frame of the base limb's joint.
std::vector<LimbMesh> Posed(const BodyModel& model, const body_model::BodyPose& pose) {
  body_model::Kinematics kinematics(model);
  body_model::BodyPose upright = pose;
  upright.frame_from_root = {};
  kinematics.Update(upright);
  std::vector<LimbMesh> meshes;
  for (int i = 0; i < model.limb_count(); ++i) {
    LimbMesh mesh = MeshOf(model.limbs()[static_cast<std::size_t>(i)].shape, kAround, kAlong);
    for (Vector3d& point : mesh.points_m) point = kinematics.limb(i) * point;
    for (Vector3d& normal : mesh.normals) normal = kinematics.limb(i).linear() * normal;
    meshes.push_back(std::move(mesh));
  }
  return meshes;
}

void StandOnFloor(std::vector<LimbMesh>& meshes) {
  double lowest_m = 0.0;
  for (const LimbMesh& mesh : meshes) {
    for (const Vector3d& point : mesh.points_m) lowest_m = std::min(lowest_m, point.z());
  }
  for (LimbMesh& mesh : meshes) {
    for (Vector3d& point : mesh.points_m) point.z() -= lowest_m;
  }
}

/// Points of the side, ring by ring, then the middles of both discs.
void AddPoints(const geometry::DegenerateCylinder& shape, int around, int along, LimbMesh& mesh) {
  for (int ring = 0; ring <= along; ++ring) {
    for (int i = 0; i < around; ++i) {
      const double phi = 2.0 * M_PI * i / around, s = 1.0 * ring / along;
      Vector3d normal = geometry::SideNormal(shape, phi, s);
      if (ring == 0) normal -= Vector3d::UnitZ();
      if (ring == along) normal += Vector3d::UnitZ();
      mesh.points_m.push_back(geometry::SidePoint(shape, phi, s));
      mesh.normals.push_back(normal.normalized());
    }
  }
  mesh.points_m.emplace_back(shape.centre0_m.x(), shape.centre0_m.y(), 0.0);
  mesh.points_m.emplace_back(shape.centre1_m.x(), shape.centre1_m.y(), shape.length_m);
  mesh.normals.emplace_back(-Vector3d::UnitZ());
  mesh.normals.emplace_back(Vector3d::UnitZ());
}

}  // namespace

LimbMesh MeshOf(const geometry::DegenerateCylinder& shape, int around, int along) {
  LimbMesh mesh;
  AddPoints(shape, around, along, mesh);
  const int proximal = around * (along + 1), distal = proximal + 1;
  for (int i = 0; i < around; ++i) {
    const int next = (i + 1) % around;
    for (int ring = 0; ring < along; ++ring) {
      const int low = ring * around, high = low + around;
      mesh.triangles.push_back({low + i, low + next, high + next});
      mesh.triangles.push_back({low + i, high + next, high + i});
    }
    mesh.triangles.push_back({proximal, next, i});
    mesh.triangles.push_back({distal, along * around + i, along * around + next});
  }
  return mesh;
}

std::string PlyOf(const BodyModel& model, const body_model::BodyPose& pose) {
  std::vector<LimbMesh> meshes = Posed(model, pose);
  StandOnFloor(meshes);
  std::string points, triangles;
  std::size_t point_count = 0, triangle_count = 0;
  for (std::size_t limb = 0; limb < meshes.size(); ++limb) {
    const LimbMesh& mesh = meshes[limb];
    for (std::size_t i = 0; i < mesh.points_m.size(); ++i) {
      Append(mesh.points_m[i], points);
      Append(mesh.normals[i], points);
      for (const std::uint8_t part : ColourOf(model.limbs()[limb].name)) Append(part, points);
      Append(static_cast<std::uint16_t>(limb), points);
    }
    for (const auto& triangle : mesh.triangles) {
      Append(std::uint8_t{3}, triangles);
      for (const int corner : triangle) {
        Append(static_cast<std::int32_t>(point_count) + corner, triangles);
      }
    }
    point_count += mesh.points_m.size();
    triangle_count += mesh.triangles.size();
  }
  return HeaderOf(point_count, triangle_count) + points + triangles;
}

}  // namespace deixis::anthropometer
