#include "services/stereo_driver/core/depth_camera/depth_registration.h"

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <opencv2/calib3d.hpp>
#include <stdexcept>
#include <utility>

#include "services/stereo_driver/core/calibration/camera_matrix.h"
#include "services/stereo_driver/core/depth_camera/depth_raster.h"

namespace deixis::stereo_driver {
namespace {

using geometry::CameraCalibration;

// Where the inverse of the distortion misses by more, the lens model folds: no ray is there.
constexpr double kLargestMiss_px = 0.5;
// Along the axis, of a ray that is none: whatever its depth, it ends behind the camera.
constexpr float kBehind = -1e6F;
// Of a ray times the target's camera matrix: times any depth, it is still a number.
constexpr double kLongestRay = 1e12;
// Of a depth pixel: patches of a slanted surface's border, each at its own distance, still meet.
constexpr float kPatchSide = 1.1F;

std::vector<cv::Point2d> GridPoints(cv::Size count, double first_px) {
  std::vector<cv::Point2d> points;
  points.reserve(static_cast<std::size_t>(count.area()));
  for (int y = 0; y < count.height; ++y) {
    for (int x = 0; x < count.width; ++x) points.emplace_back(first_px + x, first_px + y);
  }
  return points;
}

/// At z = 1, without distortion.
std::vector<cv::Point2d> Undistorted(const std::vector<cv::Point2d>& pixels,
                                     const CameraCalibration& lens) {
  const cv::TermCriteria exact(cv::TermCriteria::COUNT | cv::TermCriteria::EPS, 40, 1e-9);
  std::vector<cv::Point2d> rays;
  if (lens.distortion_model == geometry::DistortionModel::kFisheye) {
    cv::fisheye::undistortPoints(pixels, rays, CameraMatrix(lens), lens.distortion, cv::noArray(),
                                 cv::noArray(), exact);
  } else {
    cv::undistortPoints(pixels, rays, CameraMatrix(lens), lens.distortion, cv::noArray(),
                        cv::noArray(), exact);
  }
  return rays;
}

std::vector<cv::Point2d> Distorted(const std::vector<cv::Point2d>& rays,
                                   const CameraCalibration& lens) {
  std::vector<cv::Point2d> pixels;
  if (lens.distortion_model == geometry::DistortionModel::kFisheye) {
    cv::fisheye::distortPoints(rays, pixels, CameraMatrix(lens), lens.distortion);
    return pixels;
  }
  std::vector<cv::Point3d> points;
  points.reserve(rays.size());
  for (const cv::Point2d& ray : rays) points.emplace_back(ray.x, ray.y, 1.0);
  cv::projectPoints(points, cv::Vec3d(), cv::Vec3d(), CameraMatrix(lens), lens.distortion, pixels);
  return pixels;
}

Eigen::Matrix3d PinholeMatrix(const CameraCalibration& camera) {
  Eigen::Matrix3d matrix = Eigen::Matrix3d::Identity();
  matrix.diagonal().head<2>() = camera.focal_px;
  matrix.topRightCorner<2, 1>() = camera.principal_point_px;
  return matrix;
}

/// Of `count` points, the first at (first_px, first_px).
RayGrid MakeRays(const CameraCalibration& lens, cv::Size count, double first_px,
                 const Eigen::Matrix3d& pixels_from_depth) {
  const std::vector<cv::Point2d> pixels = GridPoints(count, first_px);
  const std::vector<cv::Point2d> rays = Undistorted(pixels, lens);
  const std::vector<cv::Point2d> again = Distorted(rays, lens);
  RayGrid grid;
  grid.columns = count.width;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    const Eigen::Vector3d ray = pixels_from_depth * Eigen::Vector3d(rays[i].x, rays[i].y, 1.0);
    const bool is_ray = cv::norm(again[i] - pixels[i]) <= kLargestMiss_px &&
                        (ray.array().abs() <= kLongestRay).all();
    grid.u.push_back(is_ray ? static_cast<float>(ray.x()) : 0.0F);
    grid.v.push_back(is_ray ? static_cast<float>(ray.y()) : 0.0F);
    grid.z.push_back(is_ray ? static_cast<float>(ray.z()) : kBehind);
  }
  return grid;
}

cv::Size SizeOf(const CameraCalibration& camera) {
  if (camera.width_px <= 0 || camera.height_px <= 0) {
    throw std::logic_error("DepthRegistration: a camera has no size");
  }
  return {camera.width_px, camera.height_px};
}

/// cv::Mat::setTo would allocate.
void Clear(cv::Mat& depth_mm) {
  for (int y = 0; y < depth_mm.rows; ++y) {
    auto* row = depth_mm.ptr<std::uint16_t>(y);
    std::fill(row, row + depth_mm.cols, std::uint16_t{0});
  }
}

Offset OffsetOf(const Eigen::Vector3d& pixels_mm) {
  const Eigen::Vector3f offset = pixels_mm.cast<float>();
  return {offset.x(), offset.y(), offset.z()};
}

/// The corners of one pixel where they lie in the target, all at the pixel's distance.
struct Patch {
  std::array<float, 4> u_px, v_px, z_mm;

  bool IsSeen() const { return *std::min_element(z_mm.begin(), z_mm.end()) > 0.0F; }
  DepthQuad quad() const {
    DepthQuad corners;
    for (std::size_t i = 0; i < 4; ++i) {
      corners[i] = {Enlarged(u_px, i), Enlarged(v_px, i), Enlarged(z_mm, i)};
    }
    return corners;
  }

 private:
  static float Enlarged(const std::array<float, 4>& corners, std::size_t i) {
    const float middle = 0.25F * (corners[0] + corners[1] + corners[2] + corners[3]);
    return middle + kPatchSide * (corners[i] - middle);
  }
};

Patch PatchOf(const Rays& above, const Rays& below, int x, const Offset& offset,
              std::uint16_t depth_mm) {
  Patch patch;
  const std::array<std::uint16_t, 2> depths = {depth_mm, depth_mm};
  ProjectRow({above.u + x, above.v + x, above.z + x}, offset, depths.data(), 2,
             {patch.u_px.data(), patch.v_px.data(), patch.z_mm.data()});
  ProjectRow({below.u + x, below.v + x, below.z + x}, offset, depths.data(), 2,
             {patch.u_px.data() + 2, patch.v_px.data() + 2, patch.z_mm.data() + 2});
  return patch;
}

}  // namespace

Rays RayGrid::Row(int row) const {
  const std::ptrdiff_t start = static_cast<std::ptrdiff_t>(row) * columns;
  return {u.data() + start, v.data() + start, z.data() + start};
}

DepthRegistration::Row::Row(int width)
    : u_px(static_cast<std::size_t>(width)), v_px(u_px.size()), z_mm(u_px.size()) {}

Projected DepthRegistration::Row::projected() { return {u_px.data(), v_px.data(), z_mm.data()}; }

DepthRegistration::DepthRegistration(const DepthView& view, const CameraCalibration& target)
    : depth_size_(SizeOf(view.lens)),
      target_size_(SizeOf(target)),
      upper_(depth_size_.width),
      lower_(depth_size_.width),
      goes_on_above_(static_cast<std::size_t>(depth_size_.width) + 1),
      goes_on_below_(goes_on_above_.size()),
      first_u_(goes_on_above_.size()),
      last_u_(first_u_),
      first_v_(first_u_),
      last_v_(first_u_) {
  const Eigen::Matrix3d camera = PinholeMatrix(target);
  const Eigen::Matrix3d pixels_from_depth =
      camera * view.colour_from_depth.rotation.toRotationMatrix();
  offset_ = OffsetOf(camera * view.colour_from_depth.translation_m * 1000.0);
  centres_ = MakeRays(view.lens, depth_size_, 0.0, pixels_from_depth);
  corners_ = MakeRays(view.lens, depth_size_ + cv::Size(1, 1), -0.5, pixels_from_depth);
}

void DepthRegistration::Register(const cv::Mat& depth_mm, cv::Mat& registered_mm) {
  if (depth_mm.size() != depth_size_ || depth_mm.type() != CV_16UC1) {
    throw std::logic_error("DepthRegistration: depth of another size or type than its lens");
  }
  registered_mm.create(target_size_, CV_16UC1);
  Clear(registered_mm);
  std::fill(goes_on_above_.begin(), goes_on_above_.end(), 0);
  Project(depth_mm, 0, lower_);
  for (int y = 0; y < depth_size_.height; ++y) {
    std::swap(upper_, lower_);
    std::fill(goes_on_below_.begin(), goes_on_below_.end(), 0);
    if (y + 1 < depth_size_.height) {
      Project(depth_mm, y + 1, lower_);
      FindSurfaceBelow();
      FillSurface(registered_mm);
    }
    FillPatches(depth_mm.ptr<std::uint16_t>(y), y, registered_mm);
    std::swap(goes_on_above_, goes_on_below_);
  }
}

void DepthRegistration::Project(const cv::Mat& depth_mm, int y, Row& row) const {
  ProjectRow(centres_.Row(y), offset_, depth_mm.ptr<std::uint16_t>(y), depth_size_.width,
             row.projected());
}

void DepthRegistration::FindSurfaceBelow() {
  std::int32_t* goes_on = goes_on_below_.data() + 1;
  FindSurface(upper_.z_mm.data(), lower_.z_mm.data(), depth_size_.width, goes_on);
  FindSpans(upper_.projected(), lower_.projected(), goes_on, depth_size_.width,
            static_cast<float>(target_size_.width - 1), static_cast<float>(target_size_.height - 1),
            {first_u_.data(), last_u_.data(), first_v_.data(), last_v_.data()});
}

void DepthRegistration::FillSurface(cv::Mat& registered_mm) const {
  DepthRaster raster(registered_mm);
  const auto vertex = [](const Row& row, std::size_t x) {
    return DepthVertex{row.u_px[x], row.v_px[x], row.z_mm[x]};
  };
  for (std::size_t x = 0; x + 1 < upper_.z_mm.size(); ++x) {
    const Span columns = {first_u_[x], last_u_[x]};
    const Span rows = {first_v_[x], last_v_[x]};
    if (columns.first > columns.last || rows.first > rows.last) continue;
    raster.Fill(
        {vertex(upper_, x), vertex(upper_, x + 1), vertex(lower_, x), vertex(lower_, x + 1)},
        columns, rows);
  }
}

void DepthRegistration::FillPatches(const std::uint16_t* depth_mm, int y,
                                    cv::Mat& registered_mm) const {
  DepthRaster raster(registered_mm);
  const Rays above = corners_.Row(y);
  const Rays below = corners_.Row(y + 1);
  for (int x = 0; x < depth_size_.width; ++x) {
    if (depth_mm[x] == 0 || IsInsideSurface(x)) continue;
    const Patch patch = PatchOf(above, below, x, offset_, depth_mm[x]);
    if (patch.IsSeen()) raster.Fill(patch.quad());
  }
}

bool DepthRegistration::IsInsideSurface(int x) const {
  const auto i = static_cast<std::size_t>(x);
  return (goes_on_above_[i] & goes_on_above_[i + 1] & goes_on_below_[i] & goes_on_below_[i + 1]) !=
         0;
}

}  // namespace deixis::stereo_driver
