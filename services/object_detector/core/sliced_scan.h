#pragma once
#include <opencv2/core/types.hpp>
#include <optional>
#include <string>
#include <vector>

#include "common/config/config.h"
#include "services/object_detector/core/cascade.h"
#include "services/object_detector/core/grey_picture.h"

namespace deixis::object_detector {

struct ScanConfig {
  double min_height = 0.06;  ///< Smallest object that is looked for, share of picture height.
  double max_height = 0.75;  ///< Largest one.
  double scale_step = 1.2;   ///< From one size to the next.
  double round_s = 1.5;      ///< In this time a whole picture is looked through.
  double round_while_none_s = 0.75;  ///< The same while no object is seen.
  int pictures_at_start = 3;         ///< The first round is spread over this many pictures.

  template <typename Visitor>
  void Visit(Visitor& v) {
    v("min_height", min_height);
    v("max_height", max_height);
    v("scale_step", scale_step);
    v("round_s", round_s);
    v("round_while_none_s", round_while_none_s);
    v("pictures_at_start", pictures_at_start);
  }
  void Check(config::Faults& faults) const;
};

/// Whether some object is already seen, so that only further ones are looked for.
enum class Urgency { kForMore, kForAny };

/// Looks through pictures for new objects a slice at a time, since a whole picture takes 50 to 200
/// ms: each slice is a band of rows at one size. Large objects come first. How much is looked at
/// follows from the pictures' times, never from a clock, so that the same pictures give the same
/// answers.
class SlicedScan {
 public:
  SlicedScan(const ScanConfig& config, cv::Size window);

  /// Where the cascade answered in the next slices, pixels of `picture`; answers that agree are
  /// taken together, those with the most first. Not yet certain: to be looked at more closely.
  std::vector<CascadeHit> Next(const GreyPicture& picture, Cascade& cascade, Urgency urgency);

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
  double ShareOfRound(Timestamp time, Urgency urgency) const;
  std::vector<Slice> TakeSlices(double share);

  ScanConfig config_;
  cv::Size window_;
  cv::Size planned_for_;
  std::vector<Slice> slices_;
  double windows_per_round_ = 0.0;
  std::size_t next_ = 0;
  double credit_ =
      0.0;  ///< Windows that may be looked at; below 0 after a slice that was too large.
  std::optional<Timestamp> last_time_;
  bool is_first_round_ = true;
};

}  // namespace deixis::object_detector
