#pragma once
#include "common/body_model/kinematics.h"
#include "services/pose_fitter/core/fitting/body_points.h"

namespace deixis::pose_fitter {

/// The articulated fit as one would write it with Ceres: in each round the points' nearest places
/// on the limbs (by the same kernels as LimbIcp), then one step of Levenberg and Marquardt on their
/// distances along the normals, derivatives by automatic differentiation of the chain of joints.
/// Robust weights and reach are narrowed as BodyFitter does. One thread.
void FitByCeres(const body_model::BodyModel& model, const BodyPoints& points, int rounds,
                body_model::BodyPose& pose);

}  // namespace deixis::pose_fitter
