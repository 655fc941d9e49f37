#pragma once
#include <opencv2/core/mat.hpp>
#include <string>
#include <utility>
#include <vector>

#include "common/config/config.h"
#include "common/geometry/stereo_calibration.h"
#include "common/images/stereo_pair.h"
#include "services/stereo_driver/core/matching/depth.h"
#include "services/stereo_driver/core/matching/disparity.h"
#include "services/stereo_driver/core/matching/people/people_measurer.h"
#include "services/stereo_driver/core/matching/rectifier.h"
#include "services/stereo_driver/core/matching/refinement.h"

namespace deixis::stereo_driver {

/// At what size pictures are matched.
enum class MatchSize {
  kFull,
  kHalf,
  kPeople  ///< Half size, and full-size alignment where people can be.
};
inline auto EnumNames(MatchSize) {
  return std::vector<std::pair<std::string, MatchSize>>{
      {"full", MatchSize::kFull}, {"half", MatchSize::kHalf}, {"people", MatchSize::kPeople}};
}

/// Of the depth that comes out, as part of the pictures taken.
enum class Size { kFull, kHalf };
inline auto EnumNames(Size) {
  return std::vector<std::pair<std::string, Size>>{{"full", Size::kFull}, {"half", Size::kHalf}};
}

struct StereoMatcherConfig {
  MatchSize match_size = MatchSize::kHalf;
  Size depth_size = Size::kHalf;  ///< Of the published depth; half when match_size is.
  double nearest_m = 0.5;         ///< Nearer things have no depth; smaller costs time.
  double farthest_m = 10.0;       ///< Farther things have no depth.
  DisparityConfig disparity;
  RefinementConfig refinement;
  PeopleConfig people;  ///< With MatchSize::kPeople.

  template <typename Visitor>
  void Visit(Visitor& v) {
    v("match_size", match_size);
    v("depth_size", depth_size);
    v("nearest_m", nearest_m);
    v("farthest_m", farthest_m);
    v("disparity", disparity);
    v("refinement", refinement);
    v("people", people);
  }
  void Validate() const;  ///< Throws FaultsFound.
};

/// The left picture and what was measured of the same view.
struct RectifiedDepth {
  cv::Mat left_bgr;  ///< CV_8UC3, rectified.
  cv::Mat depth_mm;  ///< CV_16UC1, millimetres along the rectified optical axis, 0 = not measured;
                     ///< of the picture's size or half of it.
};

/// Why pictures of the calibration's size cannot be matched, with the cure; empty when they can be:
/// not below OpenCV's windows, nor so many disparities in so many pixels that nothing else would be
/// heard for seconds.
std::string MatchingFault(const StereoMatcherConfig& config,
                          const geometry::StereoCalibration& calibration);

/// From a pair as taken to rectified picture and depth. The steps can be called one by one, to
/// measure them; Measure does them all.
class StereoMatcher {
 public:
  /// For pictures of the calibration's size. Throws FaultsFound, or std::logic_error on a
  /// calibration that is none.
  StereoMatcher(const StereoMatcherConfig& config, const geometry::StereoCalibration& calibration);

  /// All steps. `people` are windows of the full-size picture where people have been said to be, as
  /// PeopleMeasurer takes them; they count with MatchSize::kPeople only. The result shares memory
  /// with this object and holds until the next call. Throws std::logic_error on pictures of another
  /// size.
  const RectifiedDepth& Measure(const images::StereoPair& pair, const Windows& people = {});

  void Rectify(const images::StereoPair& pair);  ///< First step: fills pair().
  void Match();                                  ///< Second step: fills disparity().
  void Refine();                                 ///< Third step: improves disparity().
  void MeasurePeople(const Windows& people);     ///< Fourth step: fills windows().
  void Convert();                                ///< Fifth step: fills result().

  const RectifiedPair& pair() const { return rectified_; }
  const cv::Mat& disparity() const {
    return disparity_;
  }  ///< Of the pictures that are matched, in 1/16 of their pixels.
  /// Where people were measured at full size, in its pixels.
  const Windows& windows() const { return people_.windows(); }
  const RectifiedDepth& result() const { return result_; }
  int num_disparities() const { return num_disparities_; }

 private:
  StereoMatcherConfig config_;
  Rectifier rectifier_;
  int num_disparities_;
  DisparityMatcher matcher_;
  DisparityRefiner refiner_;
  PeopleMeasurer people_;
  DepthConverter converter_;
  RectifiedPair rectified_;
  cv::Mat left_to_match_, right_to_match_;
  cv::Mat disparity_;
  cv::Mat half_depth_mm_;  ///< Before it is doubled.
  RectifiedDepth result_;
};

}  // namespace deixis::stereo_driver
