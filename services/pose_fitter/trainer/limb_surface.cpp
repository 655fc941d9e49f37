#include "services/pose_fitter/trainer/limb_surface.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <string>

#include "common/geometry/degenerate_cylinder.h"

namespace deixis::pose_fitter {
namespace {

using body_model::BodyModel;
using Eigen::Vector3d;
using geometry::ClosestPoint;
using geometry::CylinderPart;
using geometry::DegenerateCylinder;

constexpr double kFacing = 0.3;  // Least cosine between the normals of point and limb.
constexpr double kExplained_m = 0.05;
constexpr double kRobust_m = 0.02;       // Geman and McClure's scale.
constexpr double kSigma_m = 0.01;        // Of one point; of many see kIndependent.
constexpr double kIndependent = 200.0;   // Points of one limb say no more than so many.
constexpr double kCentreSpread = 0.012;  // Of the stature.
constexpr double kRadiusSpread = 0.25;   // Of the semi-axis.
constexpr double kThinnest = 0.3;        // Of the expected semi-axis.
constexpr int kIterations = 4;
constexpr double kStep_m = 2e-4;

/// Labels of the mask that a limb may carry.
class Labels {
 public:
  explicit Labels(const std::string& limb) {
    const auto has = [&limb](const char* part) { return limb.find(part) != std::string::npos; };
    const bool is_head = limb == "head" || limb == "jaw" || limb == "skull_cap" || limb == "neck";
    const bool is_arm = has("lower_arm") || has("hand") || has("upper_arm") || has("deltoid");
    if (is_head) {
      allowed_ = {kHeadSkin, kHair, kEyes};
      if (limb == "neck") allowed_.insert(kClothes);
    } else {
      allowed_ = {kClothes, kOtherSkin};
      if (!is_arm) allowed_.insert({kHeadSkin, kHair});
    }
    if (is_arm || has("clavicle")) allowed_.insert(has("left") ? kLeftArmSkin : kRightArmSkin);
  }
  bool Allow(int label) const { return allowed_.count(label) != 0; }

 private:
  enum { kClothes = 1, kHeadSkin, kRightArmSkin, kLeftArmSkin, kHair, kEyes, kOtherSkin };
  std::set<int> allowed_;
};

double Radius(const DegenerateCylinder& shape) {
  const double thickest_m = std::max({shape.a0_m, shape.b0_m, shape.a1_m, shape.b1_m});
  return std::hypot(0.5 * shape.length_m,
                    thickest_m + shape.centre0_m.norm() + shape.centre1_m.norm());
}

class Assignment {
 public:
  Assignment(const BodyModel& model, double reach_m)
      : model_(model), kinematics_(model), reach_m_(reach_m) {
    for (const body_model::Limb& limb : model.limbs()) labels_.emplace_back(limb.name);
  }

  void Pose(const body_model::BodyPose& pose) { kinematics_.Update(pose); }

  LimbPoint Nearest(const SurfacePoint& point) const {
    LimbPoint nearest;
    nearest.distance_m = reach_m_;
    for (int i = 0; i < model_.limb_count(); ++i) {
      if (labels_[static_cast<std::size_t>(i)].Allow(point.part)) Try(i, point, nearest);
    }
    return nearest;
  }

 private:
  void Try(int index, const SurfacePoint& point, LimbPoint& nearest) const {
    const DegenerateCylinder& shape = model_.limbs()[static_cast<std::size_t>(index)].shape;
    const Vector3d place_m = kinematics_.limb(index).inverse() * point.point_m;
    const Vector3d middle_m(0.0, 0.0, 0.5 * shape.length_m);
    if ((place_m - middle_m).norm() > Radius(shape) + reach_m_) return;
    const ClosestPoint closest = geometry::FindClosest(shape, place_m);
    if (std::abs(closest.signed_distance_m) >= std::abs(nearest.distance_m)) return;
    const Vector3d normal = kinematics_.limb(index).linear() * closest.normal;
    if (normal.dot(point.normal) < kFacing) return;
    nearest = {index, place_m, closest.signed_distance_m};
  }

  const BodyModel& model_;
  body_model::Kinematics kinematics_;
  std::vector<Labels> labels_;
  double reach_m_;
};

using Numbers = Eigen::Matrix<double, 8, 1>;

Numbers NumbersOf(const DegenerateCylinder& c) {
  Numbers n;
  n << c.centre0_m, c.centre1_m, c.a0_m, c.b0_m, c.a1_m, c.b1_m;
  return n;
}

DegenerateCylinder CylinderOf(const Numbers& n, double length_m) {
  return {n[4], n[5], n[6], n[7], length_m, n.segment<2>(0), n.segment<2>(2)};
}

Numbers Spreads(const DegenerateCylinder& expected, bool is_middle, double stature_m) {
  Numbers spreads = kRadiusSpread * NumbersOf(expected);
  spreads.head<4>().setConstant(kCentreSpread * stature_m);
  if (is_middle) spreads[1] = spreads[3] = 1e-6;
  return spreads;
}

/// Gauss-Newton step of all points.
Numbers Step(const Numbers& now, const Numbers& expected, const Numbers& spreads, double length_m,
             const std::vector<Vector3d>& points_m) {
  std::array<DegenerateCylinder, 8> moved;
  for (int j = 0; j < 8; ++j) {
    moved[static_cast<std::size_t>(j)] = CylinderOf(now + kStep_m * Numbers::Unit(j), length_m);
  }
  const DegenerateCylinder shape = CylinderOf(now, length_m);
  Eigen::Matrix<double, 8, 8> matrix = spreads.cwiseAbs2().cwiseInverse().asDiagonal();
  Numbers vector = (expected - now).cwiseQuotient(spreads.cwiseAbs2());
  const double count = static_cast<double>(points_m.size());
  const double weight = 1.0 / (kSigma_m * kSigma_m) / (1.0 + count / kIndependent);
  for (const Vector3d& point_m : points_m) {
    const ClosestPoint closest = geometry::FindClosest(shape, point_m);
    if (closest.part != CylinderPart::kSide) continue;
    const double distance_m = closest.signed_distance_m;
    Numbers slope;
    for (int j = 0; j < 8; ++j) {
      const auto& other = moved[static_cast<std::size_t>(j)];
      slope[j] = (geometry::FindClosest(other, point_m).signed_distance_m - distance_m) / kStep_m;
    }
    const double scale = kRobust_m * kRobust_m;
    const double robust = std::pow(scale / (scale + distance_m * distance_m), 2);
    matrix.noalias() += weight * robust * slope * slope.transpose();
    vector.noalias() -= weight * robust * distance_m * slope;
  }
  return matrix.ldlt().solve(vector);
}

}  // namespace

std::vector<LimbPoint> AssignPoints(const BodyModel& model, const std::vector<PosedSurface>& frames,
                                    double reach_m) {
  Assignment assignment(model, reach_m);
  std::vector<LimbPoint> assigned;
  for (const PosedSurface& frame : frames) {
    assignment.Pose(frame.pose);
    for (const SurfacePoint& point : frame.points) assigned.push_back(assignment.Nearest(point));
  }
  return assigned;
}

SurfaceError MeasureSurface(const BodyModel& model, const std::vector<PosedSurface>& frames) {
  SurfaceError error;
  double square = 0.0, explained = 0.0;
  for (const LimbPoint& point : AssignPoints(model, frames, kExplained_m)) {
    ++error.points;
    if (point.limb < 0) continue;
    explained += 1.0;
    square += point.distance_m * point.distance_m;
  }
  if (explained > 0.0) error.rms_m = std::sqrt(square / explained);
  if (error.points > 0) error.explained = explained / static_cast<double>(error.points);
  return error;
}

DegenerateCylinder FitCylinder(const DegenerateCylinder& expected, const DegenerateCylinder& start,
                               const std::vector<Vector3d>& points_m, bool is_middle,
                               double stature_m) {
  const Numbers wanted = NumbersOf(expected);
  const Numbers spreads = Spreads(expected, is_middle, stature_m);
  Numbers now = NumbersOf(start);
  for (int i = 0; i < kIterations; ++i) {
    now += Step(now, wanted, spreads, expected.length_m, points_m);
    now.tail<4>() = now.tail<4>().cwiseMax(kThinnest * wanted.tail<4>());
  }
  if (is_middle) now[1] = now[3] = 0.0;
  return CylinderOf(now, expected.length_m);
}

}  // namespace deixis::pose_fitter
