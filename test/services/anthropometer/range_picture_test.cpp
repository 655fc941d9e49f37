#include "services/anthropometer/core/range_picture.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <opencv2/core.hpp>

#include "common/body_model/joint_angles.h"
#include "services/anthropometer/core/drawing.h"
#include "services/anthropometer/core/plane_reach.h"
#include "test/services/anthropometer/person.h"

namespace deixis::anthropometer {
namespace {

using Degrees = std::map<std::string, long>;

const std::string kKinematics = DEIXIS_SOURCE_DIR "/config/kinematics/";

struct Standing {
  explicit Standing(const std::string& name)
      : model(TallMan(name)),
        pose(body_model::Standing(model)),
        limits(anatomy::JointLimits::Load(kKinematics + "joint_limits.yaml")),
        range(model, range_of_motion::LoadRangePlan(kKinematics + "range_of_motion.yaml"), limits,
              range_of_motion::Limits::kSource) {}

  /// What ends the reaches of one joint, and at how many degrees from neutral.
  Degrees BoundsOf(View view, const std::string& joint) const {
    body_model::Kinematics kinematics(model);
    kinematics.Update(pose);
    Degrees bounds;
    for (const PlaneReach& reach : ReachesIn(view, kinematics, range)) {
      if (reach.joint->Name() != joint) continue;
      for (const PlaneBound& bound : {reach.clockwise, reach.anticlockwise}) {
        bounds[bound.motion] = std::lround(bound.angle_rad * 180.0 / M_PI);
      }
    }
    return bounds;
  }

  cv::Mat Picture() const {
    return DrawWithRanges(model, pose, range, {&limits, {}, "a man"}, 300);
  }

  body_model::BodyModel model;
  body_model::BodyPose pose;
  anatomy::JointLimits limits;
  range_of_motion::RangeOfMotion range;
};

TEST(PlaneReach, EndsWhereTheTableSays) {
  const Standing man("whole_body_detailed");
  EXPECT_EQ(man.BoundsOf(View::kFront, "left_shoulder"),
            (Degrees{{"abduction", 180}, {"adduction", 40}}));
  EXPECT_EQ(man.BoundsOf(View::kFront, "right_hip"),
            (Degrees{{"abduction", 50}, {"adduction", 30}}));
  EXPECT_EQ(man.BoundsOf(View::kSide, "left_shoulder"),
            (Degrees{{"flexion", 170}, {"extension", 40}}));
  EXPECT_EQ(man.BoundsOf(View::kSide, "right_elbow"),
            (Degrees{{"flexion", 150}, {"extension", 10}}));
  EXPECT_EQ(man.BoundsOf(View::kSide, "cervical_spine"),
            (Degrees{{"ventral_flexion", 65}, {"dorsal_flexion", 40}}));
  EXPECT_EQ(man.BoundsOf(View::kFront, "cervical_spine"), (Degrees{{"lateral_flexion", 35}}));
}

TEST(PlaneReach, IsNoneWhereAHingeDoesNotTurnInThePlane) {
  const Standing man("whole_body_detailed");
  EXPECT_EQ(man.BoundsOf(View::kFront, "left_elbow"), Degrees());
  EXPECT_EQ(man.BoundsOf(View::kFront, "left_knee"), Degrees());
  EXPECT_EQ(man.BoundsOf(View::kFront, "left_ankle"), Degrees());
}

TEST(PlaneReach, FollowsTheLimbsAbove) {
  Standing man("whole_body_detailed");
  const int arm = *man.model.Find("left_upper_arm");
  body_model::PointLimb(man.model, arm, Eigen::Vector3d::UnitX(), man.pose);  // Forward.
  body_model::Kinematics kinematics(man.model);
  kinematics.Update(man.pose);
  for (const PlaneReach& reach : ReachesIn(View::kSide, kinematics, man.range)) {
    if (reach.joint->Name() != "left_wrist") continue;
    EXPECT_NEAR(std::abs(reach.neutral_rad), M_PI, 1e-6);  // The front is on the left.
    EXPECT_LE((reach.centre_m - kinematics.proximal_m(*man.model.Find("left_hand"))).norm(), 1e-9);
  }
}

TEST(RangePicture, ShowsMoreThanTheBodyAlone) {
  for (const char* name :
       {"whole_body_detailed", "clothed_body", "whole_body", "upper_body", "right_arm"}) {
    const Standing man(name);
    const cv::Mat picture = man.Picture();
    EXPECT_EQ(picture.rows, 300);
    EXPECT_GE(picture.cols, 600);
    EXPECT_EQ(cv::norm(picture, man.Picture(), cv::NORM_INF), 0.0);
  }
}

TEST(RangePicture, WidensForArmsThatAreStretchedOut) {
  Standing man("whole_body_detailed");
  EXPECT_EQ(man.Picture().cols, 600);
  man.pose = RestPose(man.model);
  EXPECT_GT(man.Picture().cols, 700);
}

TEST(DrawableText, WritesUmlautsAsTwoLetters) {
  EXPECT_EQ(DrawableText("Hüfte, Größe, Öl"), "Huefte, Groesse, Oel");
  EXPECT_EQ(DrawableText("café"), "caf??");
}

}  // namespace
}  // namespace deixis::anthropometer
