#pragma once
#include <Eigen/Core>
#include <string>
#include <vector>

#include "common/body_model/body_model.h"
#include "services/pose_fitter/trainer/rendered_person.h"

namespace deixis::pose_fitter {

/// Where a marker sits on a body model.
struct MarkerPlace {
  std::string marker;
  int limb = 0;
  Eigen::Vector3d place_m = Eigen::Vector3d::Zero();  ///< In the limb's frame.
  double weight = 1.0;
};

/// All markers of a person on a model whose joints are the person's; those of head, hands and feet
/// as they stand in `frame`, in which the person stands upright.
std::vector<MarkerPlace> PlaceMarkers(const RenderedPerson& person, int frame,
                                      const body_model::BodyModel& model);

struct MarkerPose {
  body_model::BodyPose pose;   ///< In the camera frame.
  double joint_error_m = 0.0;  ///< Mean distance of the markers with weight 1 from their places.
};

/// The pose that brings a model's markers nearest to `markers`: damped Gauss-Newton from the
/// standing pose; angles beyond their envelope are pulled back softly.
MarkerPose FindPose(const body_model::BodyModel& model, const std::vector<MarkerPlace>& places,
                    const Markers& markers);

}  // namespace deixis::pose_fitter
