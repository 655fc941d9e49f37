#pragma once
#include <opencv2/core/mat.hpp>
#include <string>

#include "common/anatomy/joint_limits.h"
#include "common/body_model/body_model.h"
#include "common/range_of_motion/range_of_motion.h"

namespace deixis::anthropometer {

/// The words of a picture: names of joints and motions in one language.
struct PictureWords {
  const anatomy::JointLimits* limits = nullptr;
  anatomy::Language language = anatomy::Language::kEnglish;
  std::string title;
};

/// Front and left side of a body beside each other, CV_8UC3, `height_px` high and at least twice as
/// wide: at each joint a translucent sector of where the limb beyond it may point at in the
/// picture's plane, the other joints as they are; beside it names and degrees. In the side view the
/// left arm and leg have sectors, the right ones where there are no left ones.
cv::Mat DrawWithRanges(const body_model::BodyModel& model, const body_model::BodyPose& pose,
                       const range_of_motion::RangeOfMotion& range, const PictureWords& words,
                       int height_px);

/// UTF-8 as the letters that OpenCV can draw: ä becomes ae; what it cannot draw, ?.
std::string DrawableText(const std::string& utf8);

}  // namespace deixis::anthropometer
