#pragma once
#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <vector>

#include "common/body_model/tracked_body.h"
#include "services/pose_fitter/core/depth/depth_view.h"

namespace deixis::pose_fitter {

/// What may be one person in a depth image.
struct PersonRegion {
  int label = 0;  ///< Its number in PeopleRegions::labels, from 1.
  int pixel_count = 0;
  Eigen::Vector3d centroid_m = Eigen::Vector3d::Zero();  ///< In the camera's optical frame.
  double top_m = 0.0;  ///< Height of its highest part above the floor (above its own lowest part
                       ///< where there is no floor).
};

/// All of them in one depth image.
struct PeopleRegions {
  std::vector<std::uint8_t> labels;  ///< Per pixel, row by row: 0 = nobody, else a region's label.
  std::vector<PersonRegion> regions;
  std::optional<body_model::Floor> floor;  ///< In the camera's optical frame.
};

/// Placeholder.
PeopleRegions FindPeople(const DepthView& view, std::optional<body_model::Floor> floor);

}  // namespace deixis::pose_fitter
