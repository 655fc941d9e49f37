#pragma once

namespace deixis::pose_fitter {

/// Points for a plane, one array per coordinate. A plane is seen as an inverse depth that is linear
/// in the ray: 1 / z = slope_x ray_x + slope_y ray_y + fixed, whose noise lies in 1 / z alone.
struct FloorSamples {
  const float* ray_x = nullptr;
  const float* ray_y = nullptr;
  const float* inverse_z = nullptr;  ///< 1/m.
  const float* sigma = nullptr;      ///< Of inverse_z.
  int count = 0;
};

struct InversePlane {
  float slope_x = 0.0F;
  float slope_y = 0.0F;
  float fixed = 0.0F;
  float height_m = 0.0F;  ///< Of the camera above it: 1 / |(slope_x, slope_y, fixed)|.
};

/// How near a sample must be to lie on the plane: sigmas of its noise and a distance in metres.
struct FloorTolerance {
  float sigmas = 3.0F;
  float distance_m = 0.02F;
};

/// Area, in units of square metres times the focal lengths, of what lies on the plane and of what
/// is seen below it.
struct FloorSupport {
  float on = 0.0F;
  float below = 0.0F;
};

FloorSupport SupportOf(const FloorSamples& samples, const InversePlane& plane,
                       const FloorTolerance& tolerance);

/// Normal equations of (slope_x, slope_y, fixed) over the samples on `plane`, each weighted by its
/// noise and by the roughness of a floor.
struct FloorEquations {
  float xx = 0.0F, xy = 0.0F, x = 0.0F, yy = 0.0F, y = 0.0F, one = 0.0F;  ///< Left side.
  float xq = 0.0F, yq = 0.0F, q = 0.0F;                                   ///< Right side.
  float count = 0.0F;                                                     ///< Samples on the plane.
};

FloorEquations EquationsOf(const FloorSamples& samples, const InversePlane& plane,
                           const FloorTolerance& tolerance);

}  // namespace deixis::pose_fitter
