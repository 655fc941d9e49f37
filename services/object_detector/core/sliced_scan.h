#pragma once
#include <opencv2/core/mat.hpp>
#include <string>
#include <vector>

#include "common/config/config.h"
#include "services/object_detector/core/cascade.h"

namespace deixis::object_detector {

struct ScanConfig {
  double min_height = 0.06;        ///< Smallest object that is looked for, share of picture height.
  double max_height = 0.75;        ///< Largest one.
  double scale_step = 1.2;         ///< From one size to the next.
  int windows_per_image = 6000;    ///< Places looked at per picture; about 0.5 us each.
  int windows_while_none = 12000;  ///< The same while no object is seen.
  int windows_at_start = 40000;    ///< The same until a whole picture was looked through once.

  template <typename Visitor>
  void Visit(Visitor& v) {
    v("min_height", min_height);
    v("max_height", max_height);
    v("scale_step", scale_step);
    v("windows_per_image", windows_per_image);
    v("windows_while_none", windows_while_none);
    v("windows_at_start", windows_at_start);
  }
  void Check(config::Faults& faults) const;
};

/// Whether some object is already seen, so that only further ones are looked for.
enum class Urgency { kForMore, kForAny };

/// Looks through pictures for new objects a slice at a time, since a whole picture takes 50 to 200
/// ms: each slice is a band of rows at one size. Large objects come first. Its amount of work is
/// counted in windows, never in time, so that the same pictures give the same answers.
class SlicedScan {
 public:
  SlicedScan(const ScanConfig& config, cv::Size window);

  /// Where the cascade answered in the next slices, pixels of `grey`; answers that agree are taken
  /// together, those with the most first. Not yet certain: to be looked at more closely.
  std::vector<CascadeHit> Next(const cv::Mat& grey, Cascade& cascade, Urgency urgency);

  void Reset();

 private:
  struct Slice {
    double scale = 1.0;  ///< Of the level, relative to the picture.
    cv::Size level;      ///< Size of the picture at that scale.
    int first_row = 0;   ///< Of the level.
    int rows = 0;        ///< Window included.
    int windows = 0;
  };
  void Plan(cv::Size picture);
  void PlanLevel(double scale, cv::Size picture);
  int Budget(Urgency urgency) const;
  std::vector<Slice> TakeSlices(int budget);

  ScanConfig config_;
  cv::Size window_;
  cv::Size planned_for_;
  std::vector<Slice> slices_;
  std::size_t next_ = 0;
  bool is_first_round_ = true;
};

}  // namespace deixis::object_detector
