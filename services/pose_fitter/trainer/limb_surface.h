#pragma once
#include <Eigen/Core>
#include <vector>

#include "common/body_model/body_model.h"
#include "common/body_model/kinematics.h"
#include "services/pose_fitter/trainer/rendered_person.h"

namespace deixis::pose_fitter {

/// A frame of a person: where the model is, and what is seen of the surface.
struct PosedSurface {
  body_model::BodyPose pose;
  std::vector<SurfacePoint> points;
};

/// A point of the surface and the limb that it belongs to.
struct LimbPoint {
  int limb = -1;                                      ///< -1 = none is near enough.
  Eigen::Vector3d place_m = Eigen::Vector3d::Zero();  ///< In the limb's frame.
  double distance_m = 0.0;                            ///< Signed, from the limb's surface.
};

/// Gives each point to the limb whose surface is nearest, no farther than `reach_m`, faces the same
/// way and may carry the label of the mask.
std::vector<LimbPoint> AssignPoints(const body_model::BodyModel& model,
                                    const std::vector<PosedSurface>& frames, double reach_m);

/// How well a model explains surfaces.
struct SurfaceError {
  double rms_m = 0.0;      ///< Of the points that a limb explains within 5 cm.
  double explained = 0.0;  ///< Their share of all points.
  std::size_t points = 0;
};
SurfaceError MeasureSurface(const body_model::BodyModel& model,
                            const std::vector<PosedSurface>& frames);

/// The cylinder of the same length that explains points in its limb's frame: robust least squares
/// of semi-axes and centres around `expected`. `is_middle`: mirror symmetric, centres at y = 0.
/// Points beside an end, on a disc, do not count. `stature_m` scales how far it may differ.
geometry::DegenerateCylinder FitCylinder(const geometry::DegenerateCylinder& expected,
                                         const geometry::DegenerateCylinder& start,
                                         const std::vector<Eigen::Vector3d>& points_m,
                                         bool is_middle, double stature_m);

}  // namespace deixis::pose_fitter
