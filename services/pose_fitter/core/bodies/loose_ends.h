#pragma once
#include <Eigen/Core>
#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <vector>

#include "services/pose_fitter/core/fitting/body_evidence.h"

namespace deixis::pose_fitter {

struct LooseEndsConfig {
  double least_area_m2 = 0.004;  ///< Of a surface beside the body, head on; a forearm has 0.02.
  double joined_m = 0.12;        ///< Step in depth from it to the body that it hangs on.
  double least_m = 0.10;         ///< From the joint that its limb hangs on to its end.

  template <typename Visitor>
  void Visit(Visitor& v) {
    v("least_area_m2", least_area_m2);
    v("joined_m", joined_m);
    v("least_m", least_m);
  }
  void Validate() const;  ///< Throws FaultsFound.
};

/// Finds what hangs on a body within the reach of an arm or a leg and belongs to none of its limbs:
/// it may be the one that got lost. Takes its memory once per size of the image.
class LooseEnds {
 public:
  explicit LooseEnds(const LooseEndsConfig& config) : config_(config) {}

  /// Of each such surface the point that is farthest from `joint_m`, in the camera's frame, within
  /// `reach_m` of it; largest surface first, three at most. `evidence`: gathered around the body.
  /// `context`: whose pixels are somebody else's or the room's. Holds until the next call.
  const std::vector<Eigen::Vector3d>& Find(const BodyEvidence& evidence,
                                           const Eigen::Vector3d& joint_m, double reach_m,
                                           const ImageContext& context);

 private:
  struct End {
    double area_m2 = 0.0;
    double farthest_m = 0.0;
    Eigen::Vector3d point_m = Eigen::Vector3d::Zero();
    bool is_joined = false;
  };
  void Mark(const BodyEvidence& evidence, const ImageContext& context);
  void Measure(const BodyEvidence& evidence);
  bool TouchesBody(const BodyEvidence& evidence, int u, int v) const;

  LooseEndsConfig config_;
  Eigen::Vector3d joint_m_ = Eigen::Vector3d::Zero();
  double reach_m_ = 0.0;
  cv::Rect box_;
  cv::Mat loose_, labels_;
  std::vector<End> ends_;
  std::vector<Eigen::Vector3d> points_m_;
};

}  // namespace deixis::pose_fitter
