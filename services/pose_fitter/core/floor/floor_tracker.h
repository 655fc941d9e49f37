#pragma once
#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <vector>

#include "common/body_model/tracked_body.h"
#include "common/config/config.h"
#include "services/pose_fitter/core/depth/depth_view.h"
#include "services/pose_fitter/core/floor/floor_kernels.h"

namespace deixis::pose_fitter {

struct FloorTrackerConfig {
  double largest_roll_deg = 30.0;   ///< Of the camera about its optical axis.
  double largest_pitch_deg = 60.0;  ///< Of the camera, up or down.
  double lowest_camera_m = 0.15;    ///< Of the camera above the floor.
  double highest_camera_m = 2.5;
  double farthest_m = 8.0;       ///< What lies farther tells nothing about the floor.
  double least_area_m2 = 0.4;    ///< Of the floor that must be seen.
  double hold_time_s = 1.0;      ///< A floor no longer seen stays known for so long.
  double search_time_s = 0.5;    ///< How often a better one is looked for.
  double smooth_time_s = 0.5;    ///< Time constant of the memory while the camera is still.
  double known_tilt_deg = 3.0;   ///< Of a floor known from the mount: largest error of its normal
  double known_height_m = 0.05;  ///< and of its height at the camera.

  template <typename Visitor>
  void Visit(Visitor& v) {
    v("largest_roll_deg", largest_roll_deg);
    v("largest_pitch_deg", largest_pitch_deg);
    v("lowest_camera_m", lowest_camera_m);
    v("highest_camera_m", highest_camera_m);
    v("farthest_m", farthest_m);
    v("least_area_m2", least_area_m2);
    v("hold_time_s", hold_time_s);
    v("search_time_s", search_time_s);
    v("smooth_time_s", smooth_time_s);
    v("known_tilt_deg", known_tilt_deg);
    v("known_height_m", known_height_m);
  }
  void Validate() const;
};

/// Finds the floor in depth images and follows it: the largest plane that an upright camera can
/// stand above and below which nothing is seen. A table top, a bed have the floor below them, the
/// ceiling lies above the camera.
class FloorTracker {
 public:
  explicit FloorTracker(const FloorTrackerConfig& config = {});

  /// `time_s`: of the image, increasing; a step back starts anew. `is_sound`: see SoundDepth.
  /// `known`: where mount or calibration says that the floor is, in the camera's frame: what is
  /// seen there is heeded, and where nothing is, it is the floor. The floor is in the camera's
  /// optical frame; nothing when none was seen lately.
  const std::optional<body_model::Floor>& Update(
      const DepthView& depth, const std::vector<std::uint8_t>& is_sound, double time_s,
      const std::optional<body_model::Floor>& known = {});
  const std::optional<body_model::Floor>& floor() const { return floor_; }
  void Reset();

 private:
  /// Normal equations in double, which a memory can be made of.
  struct Equations {
    Eigen::Matrix3d left = Eigen::Matrix3d::Zero();
    Eigen::Vector3d right = Eigen::Vector3d::Zero();
  };
  using Slopes = Eigen::Vector3d;  ///< slope_x, slope_y, fixed of an InversePlane.

  void TakeSamples(const DepthView& depth, const std::vector<std::uint8_t>& is_sound);
  void TakeBetter(std::optional<Slopes>& seen, Equations& equations) const;
  std::optional<Slopes> Search() const;
  std::optional<Slopes> Hypothesis(std::uint64_t number) const;
  int SampleAt(int column, int row) const;  ///< -1 = none.
  std::optional<Slopes> Refined(Slopes slopes, Equations& equations) const;
  bool MayBeFloor(const Slopes& slopes) const;
  bool HasSupport(const Slopes& slopes) const;
  double Score(const Slopes& slopes) const;
  void Remember(const Slopes& seen, const Equations& equations, double elapsed_s);
  FloorSamples samples() const;

  FloorTrackerConfig config_;
  std::optional<body_model::Floor> known_;
  std::optional<body_model::Floor> floor_;
  std::optional<Slopes> slopes_;
  Equations memory_;
  double time_s_ = 0.0;
  double seen_time_s_ = 0.0;
  double search_time_s_ = 0.0;
  bool has_time_ = false;
  double sample_area_ = 0.0;  ///< Square metres of one sample at 1 m.
  std::vector<float> ray_x_, ray_y_, inverse_z_, sigma_;
  std::vector<int> grid_;  ///< Per node of the grid: its sample, -1 = none.
  int grid_columns_ = 0, grid_rows_ = 0;
};

}  // namespace deixis::pose_fitter
