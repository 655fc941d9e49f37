#pragma once
#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <vector>

#include "common/body_model/tracked_body.h"
#include "common/config/config.h"
#include "services/pose_fitter/core/depth/depth_view.h"
#include "services/pose_fitter/core/people/people_finder.h"

namespace deixis::pose_fitter {

struct HeadTopsConfig {
  double height_m = 0.25;  ///< Of a head with its neck.
  double reach_m = 0.3;    ///< Within this to either side ...
  double drop_m = 0.12;    ///< ... the outline falls as far from a head.
  int most = 3;            ///< Tried in one region, the highest ones.

  template <typename Visitor>
  void Visit(Visitor& v) {
    v("height_m", height_m);
    v("reach_m", reach_m);
    v("drop_m", drop_m);
    v("most", most);
  }
  void Validate() const;  ///< Throws FaultsFound.
};

/// Where the upper outline of a region may be a head: its peaks, from which it falls on either
/// side. Each is the point above the middle of the peak's surface, as high as the peak, in the
/// camera's optical frame; the highest first. Furniture in the same region may have its own.
std::vector<Eigen::Vector3d> HeadTops(const DepthView& view, const PeopleRegions& regions,
                                      const PersonRegion& region, const HeadTopsConfig& config);

}  // namespace deixis::pose_fitter
