#pragma once
#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "common/config/config.h"
#include "services/pose_fitter/core/depth/depth_view.h"

namespace deixis::pose_fitter {

struct HeadShapesConfig {
  double radius_m = 0.085;  ///< Of a head that is seen.
  double clear_m = 0.17;    ///< At this distance from its middle, beside and above, is none of it,
  double behind_m = 0.15;   ///< but what is this much farther, or nothing measured.
  double same_m = 0.1;      ///< Depths of one head differ by less, noise apart.
  double shoulders_below_m = 0.3;  ///< Below its middle is the trunk,
  double shoulders_m = 0.09;       ///< this far to either side at least,
  double trunk_m = 0.25;           ///< whose depth differs by less.
  double least_share = 0.75;       ///< Of the samples that must be as said.
  double apart_m = 0.25;           ///< Two heads are no nearer to each other.
  int most = 12;                   ///< The best ones.

  template <typename Visitor>
  void Visit(Visitor& v) {
    v("radius_m", radius_m);
    v("clear_m", clear_m);
    v("behind_m", behind_m);
    v("same_m", same_m);
    v("shoulders_below_m", shoulders_below_m);
    v("shoulders_m", shoulders_m);
    v("trunk_m", trunk_m);
    v("least_share", least_share);
    v("apart_m", apart_m);
    v("most", most);
  }
  void Validate() const;  ///< Throws FaultsFound.
};

/// What looks like a head above shoulders.
struct HeadShape {
  int u_px = 0, v_px = 0;                              ///< Its middle.
  Eigen::Vector3d middle_m = Eigen::Vector3d::Zero();  ///< On the surface that is seen.
  Eigen::Vector3d top_m = Eigen::Vector3d::Zero();     ///< Above the middle, as high as the head.
  double likeness = 0.0;                               ///< 0..1.
};

/// Finds heads above shoulders in a depth image by their outline and depth alone, whatever the
/// body is connected with: a seat, a wall it leans at, what a camera blurs it into.
class HeadShapes {
 public:
  explicit HeadShapes(const HeadShapesConfig& config = {});
  /// `up`: against gravity, in the camera's frame. The most likely first. Valid until the next
  /// call.
  const std::vector<HeadShape>& Find(const DepthView& depth,
                                     const std::vector<std::uint8_t>& is_sound,
                                     const Eigen::Vector3d& up, double near_m, double far_m);

  const std::vector<HeadShape>& found() const { return heads_; }

 private:
  struct Probe;
  float ClearShare(const Probe& probe) const;
  float HeadShare(const Probe& probe) const;
  float Roundness(const Probe& probe) const;
  float TrunkShare(const Probe& probe) const;
  double LikenessAt(const DepthView& depth, int u, int v, const Eigen::Vector2d& up_px) const;

  HeadShapesConfig config_;
  std::vector<Eigen::Vector2f> outer_m_, inner_m_, trunk_m_;  ///< Offsets to the right and up.
  std::vector<HeadShape> candidates_, heads_;
};

}  // namespace deixis::pose_fitter
