#pragma once
#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

#include "services/pose_fitter/core/depth/depth_view.h"
#include "services/pose_fitter/core/people/surface_runs.h"

namespace deixis::pose_fitter {

/// Axes of a room as seen by a camera: x to its right and y ahead, both along the floor, z up from
/// the floor.
struct RoomFrame {
  Eigen::Matrix3d room_from_camera = Eigen::Matrix3d::Identity();
  double camera_height_m = 0.0;

  Eigen::Vector3d FromCamera(const Eigen::Vector3d& point_m) const {
    return room_from_camera * point_m + Eigen::Vector3d(0.0, 0.0, camera_height_m);
  }
};

/// `up`: unit vector in the camera's frame.
RoomFrame RoomFrameOf(const Eigen::Vector3d& up, double camera_height_m);

/// What is known of some surface: sums over its points in the room's frame.
struct SurfaceShape {
  double pixels = 0.0;
  double area_m2 = 0.0;  ///< As seen head on.
  Eigen::Vector3d sum_m = Eigen::Vector3d::Zero();
  Eigen::Matrix3d square_m2 = Eigen::Matrix3d::Zero();  ///< Sum of p p^T.
  Eigen::Vector3d lowest_m = Eigen::Vector3d::Constant(1e9);
  Eigen::Vector3d highest_m = Eigen::Vector3d::Constant(-1e9);
  double sigma_m = 0.0;  ///< Noise of its depths, summed as the points are.

  void Add(const Eigen::Vector3d& point_m, double pixel_count, double pixel_area_m2,
           double depth_sigma_m);
  void Add(const SurfaceShape& other);
  Eigen::Vector3d Mean() const { return sum_m / pixels; }
  Eigen::Matrix3d Covariance() const;
  Eigen::Vector3d Extent() const { return highest_m - lowest_m; }
  double MeanSigma() const { return sigma_m / pixels; }
};

/// How two pieces meet in the image.
struct Contact {
  int count = 0;         ///< Pairs of pixels.
  float sum_step_m = 0;  ///< Of their differences in depth, without sign.
};

/// The larger surfaces of an image, what they look like and where they meet. Takes its memory once.
class SurfacePieces {
 public:
  static constexpr int kMost = 96;  ///< The largest ones; the others are left out.

  SurfacePieces();
  /// Numbers the pieces of `runs` whose area, seen head on, lies between the two; components become
  /// these numbers, -1 = left out.
  void Find(const DepthView& depth, const RoomFrame& room, double least_m2, double largest_m2,
            const std::vector<std::uint8_t>& is_level, SurfaceRuns& runs);

  int count() const { return static_cast<int>(shapes_.size()); }
  const SurfaceShape& shape(int piece) const { return shapes_[static_cast<std::size_t>(piece)]; }
  /// Whether it stands on a level surface, or goes down from one: what lies on tables, their edges
  /// and legs.
  bool IsAtTop(int piece) const { return is_at_top_[static_cast<std::size_t>(piece)] != 0; }
  const Contact& contact(int a, int b) const {
    return contacts_[static_cast<std::size_t>(a * kMost + b)];
  }

 private:
  void Choose(double least_m2, double largest_m2, SurfaceRuns& runs);
  void Measure(const DepthView& depth, const RoomFrame& room, const SurfaceRuns& runs);
  void FindAtTops(const DepthView& depth, const RoomFrame& room,
                  const std::vector<std::uint8_t>& is_level, const SurfaceRuns& runs);
  void FindContacts(const DepthView& depth, const SurfaceRuns& runs);
  void TouchLeft(const DepthView& depth, const SurfaceRuns& runs, int number);
  void TouchAbove(const DepthView& depth, const SurfaceRuns& runs, int number);
  void Touch(int a, int b, float step_m);

  std::vector<float> areas_;  ///< Per component.
  std::vector<int> order_;
  std::vector<int> numbers_;
  std::vector<SurfaceShape> shapes_;
  std::vector<std::uint8_t> is_at_top_;
  std::vector<std::array<int, 4>> ends_;  ///< Pixels of its lower end, of these on a level surface;
                                          ///< the same of its upper end and below one.
  std::vector<Contact> contacts_;
};

}  // namespace deixis::pose_fitter
