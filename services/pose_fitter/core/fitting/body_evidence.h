#pragma once
#include <Eigen/Core>
#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <vector>

#include "common/body_model/kinematics.h"
#include "common/body_model/tracked_body.h"
#include "services/pose_fitter/core/cues/part_cue.h"
#include "services/pose_fitter/core/depth/depth_view.h"
#include "services/pose_fitter/core/fitting/body_points.h"

namespace deixis::pose_fitter {

struct BodyEvidenceConfig {
  double gate_m = 0.12;         ///< Pixels this near to the predicted body may belong to it.
  double above_floor_m = 0.04;  ///< Lower ones are the floor's.
  int points = 1500;      ///< That the fit uses at most, about, spread over the body's pixels.
  double behind_m = 0.3;  ///< Background is what lies no further than this before the root.

  template <typename Visitor>
  void Visit(Visitor& v) {
    v("gate_m", gate_m);
    v("above_floor_m", above_floor_m);
    v("points", points);
    v("behind_m", behind_m);
  }
  void Validate() const;  ///< Throws FaultsFound.
};

/// What else is known of the image.
struct ImageContext {
  /// Per pixel: not 0 = somebody else's; of the view's size.
  const std::vector<std::uint8_t>* taken = nullptr;
  /// Per pixel: 0 = the room's.
  const std::vector<std::uint8_t>* foreground = nullptr;
  /// Hands and faces that may be this person's.
  const std::vector<PartCue>* cues = nullptr;

  bool MayBeBody(const DepthView& view, int u_px, int v_px) const {
    const auto pixel = static_cast<std::size_t>(v_px * view.width_px() + u_px);
    return (taken == nullptr || (*taken)[pixel] == 0) &&
           (foreground == nullptr || (*foreground)[pixel] != 0);
  }
};

/// What one depth image says of one person whose pose is about known. Takes its memory once per
/// size of the image.
class BodyEvidence {
 public:
  explicit BodyEvidence(const BodyEvidenceConfig& config) : config_(config) {}

  /// Gathers it around all `poses`, of which there is at least one, by the model of `kinematics`.
  /// `view` and what `context` points to must outlive what is gathered.
  void Gather(const DepthView& view, body_model::Kinematics& kinematics,
              const std::vector<const body_model::BodyPose*>& poses,
              const std::optional<body_model::Floor>& floor, const ImageContext& context,
              double gate_m);

  /// Sets the pixels whose points are within `reach_m` of the limbs of `kinematics`.
  void MarkNear(const body_model::Kinematics& kinematics, double reach_m,
                std::vector<std::uint8_t>& pixels) const;

  const DepthView& view() const { return *view_; }
  const BodyPoints& points() const { return points_; }
  const std::vector<PartCue>& cues() const { return cues_; }
  int pixel_count() const { return pixel_count_; }
  /// Whether the pixel is the body's.
  bool IsBody(int u_px, int v_px) const { return body_.at<std::uint8_t>(v_px, u_px) != 0; }
  bool IsAboveFloor(const Eigen::Vector3d& point_m) const;
  /// Whether the pixel is known to show the room.
  bool IsRoom(int u_px, int v_px) const {
    return foreground_ != nullptr &&
           (*foreground_)[static_cast<std::size_t>(v_px * view_->width_px() + u_px)] == 0;
  }
  /// How far a pixel that shows background is from the nearest one that may hide the body, pixels;
  /// 0 where the body may be. Far from the body it is endless.
  float Clearance_px(int u_px, int v_px) const { return clearance_px_.at<float>(v_px, u_px); }
  const cv::Mat& body() const { return body_; }  ///< CV_8UC1, 1 = the body's.

 private:
  void MarkBody(const body_model::Kinematics& kinematics, double gate_m);
  /// Takes out the pixels whose mark is set, or is not; nullptr = none.
  void TakeOut(const std::vector<std::uint8_t>* pixels, bool where_set);
  void RemoveIslands();
  void MeasureClearance(double root_z_m);
  void TakePoints();
  /// Which of the body's pixels become points.
  struct Sampling {
    int step_px = 1;     ///< Every so many columns and rows,
    double share = 1.0;  ///< and this share of them.
  };
  /// `due`: what is left of a point before and after.
  double TakeRow(int begin, int end, int v, const Sampling& sampling, double due);

  BodyEvidenceConfig config_;
  const DepthView* view_ = nullptr;
  std::optional<body_model::Floor> floor_;
  cv::Mat body_, may_hide_, clearance_px_, labels_, stats_, centroids_;
  cv::Rect box_;  ///< Of the body's pixels.
  BodyPoints points_;
  std::vector<PartCue> cues_;
  const std::vector<std::uint8_t>* foreground_ = nullptr;
  int pixel_count_ = 0;
};

}  // namespace deixis::pose_fitter
