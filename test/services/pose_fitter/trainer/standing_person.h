#pragma once
#include "common/body_model/body_plan.h"
#include "services/pose_fitter/trainer/rendered_person.h"

namespace deixis::pose_fitter {

/// Sizes of a man of 1.8 m, and the plan whose learning begins.
body_model::Sizes TallSizes();
body_model::BodyPlan StartPlan();

/// Where the markers are when that model is in that pose.
Markers MarkersOf(const body_model::BodyModel& model, const body_model::BodyPose& pose);

/// A model that stands 2.5 m before a camera that looks at it level: one frame.
RenderedPerson StandingPerson(const body_model::BodyModel& model);

/// Facing the camera; to where the model's standing pose is put there.
geometry::RigidTransform CameraFromRoot();

}  // namespace deixis::pose_fitter
