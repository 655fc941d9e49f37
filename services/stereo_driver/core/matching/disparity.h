#pragma once
#include <opencv2/calib3d.hpp>
#include <opencv2/core/mat.hpp>
#include <string>
#include <utility>
#include <vector>

#include "common/config/config.h"

namespace deixis::stereo_driver {

/// How pixels of the two pictures are matched.
enum class Method {
  kSgbm3way,  ///< cv::StereoSGBM, MODE_SGBM_3WAY: dense, also on clothes of one colour.
  kBm         ///< cv::StereoBM: faster, leaves out what has no texture.
};
inline auto EnumNames(Method) {
  return std::vector<std::pair<std::string, Method>>{{"sgbm_3way", Method::kSgbm3way},
                                                     {"bm", Method::kBm}};
}

struct DisparityConfig {
  Method method = Method::kSgbm3way;
  int num_disparities = 0;    ///< Searched pixels, a multiple of 16; 0 = from the nearest distance.
  int block_px = 0;           ///< Side of the compared blocks, odd; 0 = 5 (sgbm_3way), 15 (bm).
  int smoothness_small = 8;   ///< sgbm_3way: price of a step of 1 px, per pixel of a block (P1).
  int smoothness_large = 32;  ///< sgbm_3way: price of any larger step (P2); more than the small
                              ///< one. Times block_px^2 at most 32767.
  int uniqueness_percent = 10;  ///< By how much the best match must beat the next.
  int texture_threshold = 10;   ///< bm: blocks with less texture are left out.
  int prefilter_cap = 31;       ///< Largest horizontal gradient that counts, 1..63.
  int left_right_px = 1;      ///< Largest difference of left-to-right and right-to-left; -1 = any.
  int speckle_area_px = 100;  ///< Smaller islands are taken out; 0 = none are.
  int speckle_range_px = 2;   ///< Larger steps end an island.

  template <typename Visitor>
  void Visit(Visitor& v) {
    v("method", method);
    v("num_disparities", num_disparities);
    v("block_px", block_px);
    v("smoothness_small", smoothness_small);
    v("smoothness_large", smoothness_large);
    v("uniqueness_percent", uniqueness_percent);
    v("texture_threshold", texture_threshold);
    v("prefilter_cap", prefilter_cap);
    v("left_right_px", left_right_px);
    v("speckle_area_px", speckle_area_px);
    v("speckle_range_px", speckle_range_px);
  }
  void Validate() const;  ///< Throws FaultsFound.
};

/// Disparities are whole numbers of 1/16 px, as OpenCV's.
constexpr int kDisparityScale = 16;
/// Stands where there is none. Valid ones are positive.
constexpr int kNoDisparity = -kDisparityScale;

/// Disparities to search so that `nearest_px` (that of the nearest distance) is among them: a
/// multiple of 16, at most the pictures' width. `config` may state another number.
int SearchedDisparities(const DisparityConfig& config, double nearest_px, int width_px);

/// Side of the compared blocks: smaller pictures cannot be matched.
int BlockSide_px(const DisparityConfig& config);

/// OpenCV's matcher with the values of `config`, searching `num_disparities`.
cv::Ptr<cv::StereoMatcher> MakeMatcher(const DisparityConfig& config, int num_disparities);

/// Where each pixel of the left picture lies in the right one. Unlike OpenCV's matchers alone, it
/// also matches the left border of the picture, as far as the right camera sees it.
class DisparityMatcher {
 public:
  /// See SearchedDisparities for `num_disparities`. Throws FaultsFound.
  DisparityMatcher(const DisparityConfig& config, int num_disparities);

  /// Of rectified pictures, CV_8UC1, of one size: CV_16SC1 of that size, the left picture's column
  /// minus the right one's in 1/16 px, kNoDisparity where unknown. Writes into `disparity`, whose
  /// memory is used again.
  void Match(const cv::Mat& left_grey, const cv::Mat& right_grey, cv::Mat& disparity);

 private:
  int num_disparities_;
  cv::Ptr<cv::StereoMatcher> matcher_;
  cv::Mat wide_left_, wide_right_, wide_disparity_;
};

}  // namespace deixis::stereo_driver
