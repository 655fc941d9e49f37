#pragma once
#include <opencv2/core/mat.hpp>
#include <vector>

#include "common/scene/box.h"
#include "common/skin/skin_classification.h"
#include "services/hand_tracker/core/background_model.h"

namespace deixis::hand_tracker {

/// How likely each working pixel (0..255, CV_8UC1) belongs to bare skin of a person, rather than to
/// something of that colour: skin-coloured, and either different from the known background or,
/// where none is known yet, near something that moves and no wider than `widest_px` (limbs are
/// narrow, walls, doors and tables are not).
cv::Mat SkinEvidence(const BackgroundModel& background, const skin::SkinTable& table,
                     int widest_px);

/// Fills holes and takes away what is thinner than about half of `size_px` (3 or 5): stripes of a
/// shirt, outlines, noise; a hand's palm stays.
cv::Mat Smooth(const cv::Mat& evidence, int size_px);

/// Sets the evidence inside faces and necks to 0. `faces` in working pixels.
void ClearFaces(const std::vector<scene::Box>& faces, cv::Mat& evidence);

}  // namespace deixis::hand_tracker
