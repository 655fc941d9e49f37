#pragma once
#include <Eigen/Core>
#include <opencv2/core/mat.hpp>
#include <vector>

#include "common/scene/box.h"
#include "services/hand_tracker/core/skin_regions.h"

namespace deixis::hand_tracker {

/// A place where a hand may be: one end of a skin region. Working pixels.
struct HandCandidate {
  Eigen::Vector2d centre = Eigen::Vector2d::Zero();  ///< Of the hand, not of the whole region.
  Eigen::Vector2d tip = Eigen::Vector2d::Zero();     ///< The region's outermost point.
  scene::Box box;                                    ///< Around the hand.
  double area_px = 0.0;                              ///< Of the hand.
  double region_area_px = 0.0;
  double region_length_px = 0.0;                     ///< Along the region, from end to end.
  double moving_share = 0.0;                         ///< Of the hand's pixels that change right now.
  bool is_at_shoulder = false;  ///< So near to one that it may be the sleeve's end of an arm.
  bool is_at_face = false;      ///< Beside a face, where hair, ears and a neck show.
  int region = -1;
};

/// What candidates are found in: two CV_8UC1 pictures of working size.
struct SkinPicture {
  cv::Mat evidence;  ///< Of skin, 0..255.
  cv::Mat changed;   ///< Not 0 where something moves right now.
};

/// The hands that a region may show. With short sleeves a region is a whole forearm; the hand is then
/// the part within `hand_length_px` of its end, measured along the region. `shoulders` say which end
/// is which; without them both ends are offered alike.
std::vector<HandCandidate> FindCandidates(const SkinRegion& region, const SkinPicture& picture,
                                          double hand_length_px,
                                          const std::vector<Eigen::Vector2d>& shoulders);

/// Hand length guessed from a region alone: the palm is about the widest circle that fits into it.
double GuessHandLength(const SkinRegion& region);

}  // namespace deixis::hand_tracker
