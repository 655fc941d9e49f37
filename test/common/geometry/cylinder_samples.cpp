#include "test/common/geometry/cylinder_samples.h"

#include <cmath>
#include <random>

namespace deixis::geometry {
namespace {

using Eigen::Vector3d;

double Between(std::mt19937& random, double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(random);
}

}  // namespace

std::vector<DegenerateCylinder> RandomCylinders(int count) {
  std::mt19937 random(7);
  std::vector<DegenerateCylinder> all;
  for (int i = 0; i < count; ++i) {
    const double least = i % 5 == 4 ? 0.002 : 0.02;
    DegenerateCylinder cylinder{Between(random, least, 0.2), Between(random, least, 0.2),
                                Between(random, least, 0.2), Between(random, least, 0.2),
                                Between(random, 0.05, 0.6)};
    if (i % 2 == 1) {
      cylinder.centre0_m = {Between(random, -0.05, 0.05), Between(random, -0.05, 0.05)};
      cylinder.centre1_m = {Between(random, -0.05, 0.05), Between(random, -0.05, 0.05)};
    }
    all.push_back(cylinder);
  }
  return all;
}

std::vector<Vector3d> RandomPoints(const DegenerateCylinder& cylinder, int count) {
  std::mt19937 random(11);
  std::vector<Vector3d> all;
  for (int i = 0; i < count; ++i) {
    const double phi = Between(random, 0.0, 2.0 * M_PI), s = Between(random, 0.0, 1.0);
    const double off_m = Between(random, -0.03, 0.03);
    const Vector3d on_side = SidePoint(cylinder, phi, s);
    const Vector3d axis(cylinder.centre0_m.x() * (1 - s) + cylinder.centre1_m.x() * s,
                        cylinder.centre0_m.y() * (1 - s) + cylinder.centre1_m.y() * s,
                        s * cylinder.length_m);
    const Vector3d kinds[] = {
        on_side + off_m * SideNormal(cylinder, phi, s),
        axis + Between(random, 0.0, 1.0) * (on_side - axis),
        axis,
        axis + Vector3d(0.0, 0.0, Between(random, -1.0, 1.0)),
        on_side + Vector3d(0.0, 0.0, Between(random, -1.0, 1.0)),
        on_side + Between(random, 0.0, 1.0) * SideNormal(cylinder, phi, s),
    };
    all.push_back(kinds[i % 6]);
  }
  return all;
}

std::vector<DegenerateCylinder> BodyLimbs() {
  DegenerateCylinder chest{0.16, 0.11, 0.19, 0.12, 0.55};
  chest.centre0_m = {0.0, 0.01};
  chest.centre1_m = {0.0, -0.02};
  DegenerateCylinder thigh{0.09, 0.085, 0.06, 0.055, 0.43};
  thigh.centre0_m = {0.01, 0.015};
  return {chest,
          thigh,
          {0.075, 0.09, 0.07, 0.085, 0.22},
          {0.055, 0.05, 0.045, 0.04, 0.29},
          {0.045, 0.04, 0.03, 0.025, 0.26},
          {0.06, 0.055, 0.04, 0.035, 0.42},
          {0.04, 0.015, 0.035, 0.01, 0.18},
          {0.05, 0.035, 0.045, 0.02, 0.24}};
}

std::vector<Vector3d> PointsNear(const DegenerateCylinder& cylinder, double distance_m, int count) {
  std::mt19937 random(13);
  std::vector<Vector3d> all;
  while (static_cast<int>(all.size()) < count) {
    const double phi = Between(random, 0.0, 2.0 * M_PI);
    const Vector3d point =
        SidePoint(cylinder, phi, Between(random, 0.0, 1.0)) +
        Between(random, -distance_m, distance_m) * SideNormal(cylinder, phi, 0.5) +
        Vector3d(0.0, 0.0, Between(random, -distance_m, distance_m));
    if (std::abs(FindClosest(cylinder, point).signed_distance_m) <= distance_m) {
      all.push_back(point);
    }
  }
  return all;
}

std::vector<Vector3d> DenseSurface(const DegenerateCylinder& cylinder, int around, int along) {
  std::vector<Vector3d> all;
  for (int i = 0; i < around; ++i) {
    const double phi = 2.0 * M_PI * i / around;
    for (int k = 0; k <= along; ++k) {
      all.push_back(SidePoint(cylinder, phi, 1.0 * k / along));
      for (const double s : {0.0, 1.0}) {
        const Vector3d rim = SidePoint(cylinder, phi, s);
        const Eigen::Vector2d centre = s == 0.0 ? cylinder.centre0_m : cylinder.centre1_m;
        const Vector3d middle(centre.x(), centre.y(), rim.z());
        all.emplace_back(middle + (1.0 * k / along) * (rim - middle));
      }
    }
  }
  return all;
}

}  // namespace deixis::geometry
