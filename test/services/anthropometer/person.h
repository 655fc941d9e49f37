#pragma once
#include <string>

#include "common/anthropometry/person_estimate.h"
#include "common/body_model/body_plan.h"

namespace deixis::anthropometer {

/// The model of a man of 1.8 m, from a file of config/body_models.
inline body_model::BodyModel TallMan(const std::string& name) {
  const std::string config = DEIXIS_SOURCE_DIR "/config/";
  return Build(body_model::LoadBodyPlan(config + "body_models/" + name + ".yaml"),
               SizesOf(anthropometry::Populations::Load(config + "kinematics/population.yaml"),
                       anthropometry::Sex::kMale, 1.8));
}

}  // namespace deixis::anthropometer
