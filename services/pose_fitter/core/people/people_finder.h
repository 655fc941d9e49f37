#pragma once
#include <Eigen/Core>
#include <cstdint>
#include <opencv2/core/types.hpp>
#include <optional>
#include <vector>

#include "common/body_model/tracked_body.h"
#include "common/config/config.h"
#include "services/pose_fitter/core/depth/depth_view.h"
#include "services/pose_fitter/core/people/gate_kernels.h"
#include "services/pose_fitter/core/people/head_region.h"
#include "services/pose_fitter/core/people/head_shapes.h"
#include "services/pose_fitter/core/people/person_evidence.h"
#include "services/pose_fitter/core/people/person_shape.h"
#include "services/pose_fitter/core/people/seed_territory.h"
#include "services/pose_fitter/core/people/surface_pieces.h"
#include "services/pose_fitter/core/people/surface_runs.h"

namespace deixis::pose_fitter {

/// What may be one person in a depth image.
struct PersonRegion {
  int label = 0;  ///< Its number in PeopleRegions::labels, from 1.
  int seed = 0;   ///< Whose seed it was found from, 0 = nobody's.
  int pixel_count = 0;
  Eigen::Vector3d centroid_m = Eigen::Vector3d::Zero();  ///< In the camera's optical frame.
  double top_m = 0.0;     ///< Height of its highest part above the floor (above its own lowest part
                          ///< where there is no floor).
  double bottom_m = 0.0;  ///< The same of its lowest part.
  double area_m2 = 0.0;   ///< That is seen, head on.
  cv::Rect box_px;
  double likeness = 0.0;  ///< 0..1: how much speaks for a person rather than furniture.
};

/// All of them in one depth image.
struct PeopleRegions {
  std::vector<std::uint8_t> labels;   ///< Per pixel, row by row: 0 = nobody, else a region's label.
  std::vector<PersonRegion> regions;  ///< The most likely first.
  std::vector<HeadShape> heads;  ///< What looks like heads above shoulders; the most likely first.
  std::optional<body_model::Floor> floor;  ///< In the camera's optical frame.
};

struct PeopleFinderConfig {
  double near_m = 0.4;     ///< Nobody is nearer
  double far_m = 6.0;      ///< or farther.
  double lowest_m = 0.02;  ///< Above the floor: below it are the floor and its noise.
  double highest_m = 2.3;
  double join_fixed_m = 0.03;     ///< Step in depth within one surface: this,
  double join_sigmas = 2.0;       ///< noise,
  double join_slope = 4.0;        ///< and how steep a surface may lie, per width of a pixel.
  double least_piece_m2 = 0.002;  ///< Smaller surfaces are no part of anybody.
  double least_top_m2 = 0.08;     ///< Level surfaces from this size on are tables, seats, beds,
  double top_thickness_m = 0.02;  ///< which are so thick at most, to either side.
  double seed_reach_m = 0.12;     ///< Around where somebody is expected, pixels are still his.
  double least_likeness = 0.3;    ///< From this on something is taken for a person.
  double least_head = 0.9;    ///< From this likeness on a head is a person without any more ado,
  double head_reach_m = 0.5;  ///< with what is connected with it as near to its vertical
  double head_depth_m = 0.4;  ///< and to its depth.
  HeadShapesConfig heads;
  PersonShapeConfig shape;

  template <typename Visitor>
  void Visit(Visitor& v) {
    v("near_m", near_m);
    v("far_m", far_m);
    v("lowest_m", lowest_m);
    v("highest_m", highest_m);
    v("join_fixed_m", join_fixed_m);
    v("join_sigmas", join_sigmas);
    v("join_slope", join_slope);
    v("least_piece_m2", least_piece_m2);
    v("least_top_m2", least_top_m2);
    v("top_thickness_m", top_thickness_m);
    v("seed_reach_m", seed_reach_m);
    v("least_likeness", least_likeness);
    v("least_head", least_head);
    v("head_reach_m", head_reach_m);
    v("head_depth_m", head_depth_m);
    v("heads", heads);
    v("shape", shape);
  }
  void Validate() const;
};

/// Finds people in single depth images, without knowledge of the room: what stands on the floor,
/// is connected, and has the size and shape of a person. Takes its memory once per size.
class PeopleFinder {
 public:
  explicit PeopleFinder(const PeopleFinderConfig& config = {});

  /// `is_sound`: see SoundDepth. Without a floor, the camera is taken to be held level and heights
  /// are told from the lowest thing seen. `seeds`: per pixel, where people who are
  /// followed are expected: 0 = nobody, else any number of his; empty = no one is. They are found
  /// whatever their shape; their pixels stay together. Valid until the next call.
  const PeopleRegions& Find(const DepthView& depth, const std::vector<std::uint8_t>& is_sound,
                            const std::optional<body_model::Floor>& floor,
                            const std::vector<std::uint8_t>& seeds = {});
  const PeopleRegions& regions() const { return regions_; }

 private:
  int SeedReach_px(const DepthView& depth, const std::vector<std::uint8_t>& seeds) const;
  void SetGate(const DepthCamera& camera);
  RowGate GateOf(const DepthCamera& camera, int row) const;
  void FindTops(const DepthView& depth);
  void ChooseTops(const DepthCamera& camera);
  void Link(const DepthView& depth, const std::vector<std::uint8_t>& is_sound);
  void Group(const DepthView& depth);
  double Ground(int group) const;
  double Likeness(int group) const;
  PersonRegion RegionOf(int group) const;
  void Rank();
  void Write(const DepthView& depth);
  void AddHeads(const DepthView& depth, const std::vector<std::uint8_t>& is_sound);
  void AddRegion(const DepthView& depth, const HeadShape& head, const std::vector<int>& pixels);

  PeopleFinderConfig config_;
  RoomFrame room_;
  bool has_floor_ = false;
  RowGate gate_;
  Tops tops_;
  std::vector<float> level_area_;        ///< Per centimetre above the floor.
  std::vector<std::uint8_t> is_level_;   ///< Per pixel.
  std::vector<std::uint8_t> is_inside_;  ///< Of two rows.
  std::vector<std::uint8_t> links_;      ///< Of one row.
  SurfaceRuns runs_;
  SurfacePieces pieces_;
  SeedTerritory territory_;
  PersonGroups groups_;
  PersonEvidences evidences_;
  HeadShapes heads_;
  HeadRegion head_region_;
  std::vector<int> ranked_;  ///< Groups, the most likely first.
  std::vector<std::uint8_t> label_of_group_;
  PeopleRegions regions_;
};

}  // namespace deixis::pose_fitter
