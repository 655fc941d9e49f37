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
  Eigen::Vector2d root = Eigen::Vector2d::Zero();    ///< Its point nearest to a shoulder.
  scene::Box box;                                    ///< Around the hand.
  double area_px = 0.0;                              ///< Of the hand.
  double hand_length_px = 0.0;                       ///< Of a hand at this distance, as assumed.
  double region_length_px = 0.0;                     ///< Along the region, from end to end.
  double moving_share = 0.0;                         ///< Of the hand's pixels that changed of late.
  double fresh_share = 0.0;       ///< ... that changed since the last image: what a hand has
                                  ///< uncovered keeps still, the hand does not.
  int shoulder = -1;              ///< Nearest one, index among those given; -1 = none was given.
  double root_distance_px = 0.0;  ///< Of the region's root from that shoulder.
  double shoulder_distance_px = 0.0;  ///< Of the centre from that shoulder.
  bool is_at_shoulder = false;        ///< So near to one that it may be the sleeve's end of an arm.
  bool is_at_face = false;            ///< Beside a face, where hair, ears and a neck show.
  bool is_by_motion_alone = false;    ///< No region's end, but what moves within one.
  int region = -1;                    ///< Index; -1 = of none that is kept.
  int person = -1;                    ///< Whose, index; -1 = nobody's.
};

/// What candidates are found in: pictures of working size.
struct SkinPicture {
  cv::Mat evidence;  ///< CV_8UC1: of skin, 0..255.
  cv::Mat changed;   ///< CV_8UC1: not 0 where something moved of late.
  cv::Mat fresh;     ///< CV_8UC1: ... since the last image; may be left out.
};

/// The hands that a region may show. With short sleeves a region is a whole forearm; the hand is
/// then the part within `hand_length_px` of its end, measured along the region. `shoulders` say
/// which end is which; without them both ends are offered alike.
std::vector<HandCandidate> FindCandidates(const SkinRegion& region, const SkinPicture& picture,
                                          double hand_length_px,
                                          const std::vector<Eigen::Vector2d>& shoulders);

/// Takes away the ends after which an arm goes on: a watch, a stripe or a shadow cuts it in pieces.
/// `shoulders` as above; candidates of one person.
std::vector<HandCandidate> WithoutArmPieces(const std::vector<HandCandidate>& candidates,
                                            double hand_length_px,
                                            const std::vector<Eigen::Vector2d>& shoulders);

/// Hand length guessed from a region alone: the palm is about the widest circle that fits into it.
double GuessHandLength(const SkinRegion& region);

}  // namespace deixis::hand_tracker
