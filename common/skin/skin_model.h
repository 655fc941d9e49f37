#pragma once
#include <opencv2/core/mat.hpp>

#include "common/config/config.h"
#include "common/scene/box.h"
#include "common/skin/colour_histogram.h"
#include "common/skin/skin_classification.h"

namespace deixis::skin {

struct SkinModelConfig {
  double skin_share = 0.3;    ///< Prior probability that a pixel in question is skin, 0..1.
  double face_weight = 0.85;  ///< Share of the person's own colour once a face was seen, 0..1.
  double scene_weight = 0.5;  ///< Share of the scene's own colours among what is not skin, 0..1.
  double face_time_s = 2.0;   ///< Time constant with which the face's colour is followed.
  double scene_time_s = 4.0;  ///< Time constant with which the scene's colours are followed.
  double luminance_spread = 0.45;  ///< Sigma of ln(brightness) of skin about the face's.

  template <typename Visitor>
  void Visit(Visitor& v) {
    v("skin_share", skin_share);
    v("face_weight", face_weight);
    v("scene_weight", scene_weight);
    v("face_time_s", face_time_s);
    v("scene_time_s", scene_time_s);
    v("luminance_spread", luminance_spread);
  }
  void Validate() const;
};

/// What skin looks like here and now: a histogram over chromaticity, learned from the face and set
/// against the colours of the scene (Bayes), with a generic prior that works before any face was
/// seen (Jones and Rehg 2002; Vezhnevets et al. 2003 compare such models).
class SkinModel {
 public:
  explicit SkinModel(const SkinModelConfig& config = {});

  /// Learns from the skin inside `face` (pixels of `bgr`, CV_8UC3), `elapsed_s` after the last
  /// time. Returns whether enough of it looked like skin to be believed.
  bool LearnFromFace(const cv::Mat& bgr, const scene::Box& face, double elapsed_s);

  /// Learns what is not skin from the pixels whose `weight` (CV_8UC1, size of `bgr`) is not 0.
  void LearnFromScene(const cv::Mat& bgr, const cv::Mat& weight, double elapsed_s);

  /// Probability that the pixel is skin, 0..1.
  double Probability(double blue, double green, double red) const;

  /// The same for all colours at once; rebuilt by the two Learn methods.
  const SkinTable& table() const { return table_; }
  bool knows_face() const { return !face_.is_empty(); }

 private:
  double Probability(const LogChromaticity& colour) const;
  void RebuildTable();

  SkinModelConfig config_;
  ColourHistogram face_;
  ColourHistogram scene_;
  double face_luminance_ = 0.0;  ///< Mean ln(brightness) of the face's skin.
  SkinTable table_{};
};

}  // namespace deixis::skin
