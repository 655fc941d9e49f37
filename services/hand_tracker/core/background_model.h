#pragma once
#include <opencv2/core/mat.hpp>

#include "common/config/config.h"

namespace deixis::hand_tracker {

struct BackgroundModelConfig {
  double recent_time_s = 0.6;   ///< Time constant of the running average that shows motion.
  double still_time_s = 1.5;    ///< A pixel this long without motion near it becomes background.
  double near_time_s = 3.0;     ///< The same though something moves nearby.
  double replace_time_s = 4.0;  ///< The same where another background was known.
  double follow_time_s = 8.0;   ///< Time constant with which a known background follows slow light.
  double change_threshold = 7.0;       ///< Grey levels that tell motion from noise.
  double foreground_threshold = 14.0;  ///< Grey levels that tell foreground from background.
  double moving_share = 0.5;  ///< Share of changed pixels from which the camera itself moves.

  template <typename Visitor>
  void Visit(Visitor& v) {
    v("recent_time_s", recent_time_s);
    v("still_time_s", still_time_s);
    v("near_time_s", near_time_s);
    v("replace_time_s", replace_time_s);
    v("follow_time_s", follow_time_s);
    v("change_threshold", change_threshold);
    v("foreground_threshold", foreground_threshold);
    v("moving_share", moving_share);
  }
  void Validate() const;
};

/// What each pixel of a still camera shows when nobody stands before it, learned while nothing
/// moves near the pixel. People sway all the time, furniture never does: that is what tells a hand
/// at rest from a wooden table of the same colour.
class BackgroundModel {
 public:
  enum Knowledge : unsigned char {
    kBackground = 0,  ///< Looks as it did before.
    kUnknown = 1,     ///< Never seen at rest.
    kForeground = 2   ///< Looks different from the known background.
  };

  explicit BackgroundModel(const BackgroundModelConfig& config = {});

  /// Takes in the next working image, `elapsed_s` after the last one. `held` (CV_8UC1):
  /// pixels not 0 are held to be moving, whatever they look like. `reach_px`: how far motion keeps
  /// the pixels around it awake. The light is normalised to that of the background: `normalised()`
  /// is what to look at.
  void Update(const cv::Mat& bgr, const cv::Mat& held, double elapsed_s, int reach_px);

  void Reset();  ///< Forgets everything, as before the first image.

  const cv::Mat& normalised() const { return normalised_; }  ///< CV_8UC3, light evened out.
  const cv::Mat& knowledge() const { return knowledge_; }    ///< CV_8UC1 of Knowledge.
  /// CV_8UC1: 255 where something moved nearby within `still_time_s`.
  const cv::Mat& awake() const { return awake_; }
  /// CV_8UC1: 255 where this image differs from the recent average: what moves right now.
  const cv::Mat& changed() const { return changed_; }
  bool camera_moves() const { return camera_moves_; }

 private:
  void Start(const cv::Mat& bgr);
  void NormaliseLight(const cv::Mat& bgr);
  void FindChange(double elapsed_s);
  void FindAwake(const cv::Mat& held, int reach_px);
  void Learn(const cv::Mat& held, double elapsed_s);

  BackgroundModelConfig config_;
  double gain_ = 1.0;  ///< Light now over light of the background.
  bool camera_moves_ = false;
  cv::Mat normalised_;
  cv::Mat recent_;      ///< CV_16UC3, running average times 128.
  cv::Mat background_;  ///< CV_16UC3, times 128; valid where known_.
  cv::Mat known_;       ///< CV_8UC1, 255 where a background was learned.
  cv::Mat still_ms_;    ///< CV_16UC1, time since the pixel last changed.
  cv::Mat asleep_ms_;   ///< CV_16UC1, time since anything near the pixel changed.
  cv::Mat changed_;
  cv::Mat awake_;
  cv::Mat knowledge_;
};

}  // namespace deixis::hand_tracker
