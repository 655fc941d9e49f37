#include "common/geometry/transform_chain.h"

#include <gmock/gmock.h>

#include <cmath>

namespace deixis::geometry {
namespace {

using Eigen::Vector3d;
using testing::HasSubstr;

FrameTransform Moved(const std::string& parent, const std::string& child, const Vector3d& by_m,
                     std::int64_t time_us = 0) {
  return {{time_us}, parent, child, {Eigen::Quaterniond::Identity(), by_m}};
}

/// base -> neck (up by 1 m, turned to the left by a quarter) -> camera (0.1 m ahead of the neck).
FrameTransforms Head() {
  FrameTransform neck = Moved("base", "neck", {0, 0, 1}, 5);
  neck.parent_from_child.rotation = Eigen::AngleAxisd(M_PI / 2, Vector3d::UnitZ());
  return {neck, Moved("neck", "camera", {0.1, 0, 0}, 3)};
}

TransformChain BaseToCamera() {
  TransformChain chain("base");
  chain.SetCameraFrame("camera");
  return chain;
}

void ExpectAt(const std::optional<CameraPose>& pose, const Vector3d& place_m) {
  ASSERT_TRUE(pose);
  EXPECT_NEAR((pose->parent_from_camera.translation_m - place_m).norm(), 0.0, 1e-12)
      << pose->parent_from_camera.translation_m.transpose();
}

void Flood(TransformChain& chain, int count) {
  for (int i = 0; i < count; ++i) {
    chain.Take({Moved("flood" + std::to_string(i), "child" + std::to_string(i), {1, 1, 1})});
  }
}

TEST(TransformChain, ComposesFromParentToCamera) {
  TransformChain chain = BaseToCamera();
  const auto pose = chain.Take(Head());
  ExpectAt(pose, {0.0, 0.1, 1.0});
  const Vector3d ahead_of_camera = pose->parent_from_camera * Vector3d(1, 0, 0);
  EXPECT_NEAR((ahead_of_camera - Vector3d(0.0, 1.1, 1.0)).norm(), 0.0, 1e-12);
  EXPECT_EQ(chain.WhatLacks(), "");
}

TEST(TransformChain, HasTheNewestTimeOfItsTransforms) {
  TransformChain chain = BaseToCamera();
  EXPECT_EQ(chain.Take(Head())->time.microseconds, 5);
  EXPECT_EQ(chain.Take({Moved("neck", "camera", {0.1, 0, 0}, 9)})->time.microseconds, 9);
}

TEST(TransformChain, TransformsMayPointEitherWay) {
  TransformChain chain = BaseToCamera();
  const FrameTransforms head = Head();
  const auto pose =
      chain.Take({{head[0].time, "neck", "base", Inverse(head[0].parent_from_child)}, head[1]});
  ExpectAt(pose, {0.0, 0.1, 1.0});
  chain = BaseToCamera();
  ExpectAt(chain.Take({Moved("camera", "neck", {1, 0, 0}), Moved("neck", "base", {0, 2, 0})}),
           {-1.0, -2.0, 0.0});
}

TEST(TransformChain, GoesUpToWhatBothHangFromAndDownAgain) {
  TransformChain chain = BaseToCamera();
  ExpectAt(chain.Take({Moved("world", "base", {5, 0, 0}), Moved("world", "arm", {7, 0, 0}),
                       Moved("arm", "camera", {0, 0, 1})}),
           {2.0, 0.0, 1.0});
}

TEST(TransformChain, OfTwoFramesTheLastTransformHolds) {
  TransformChain chain = BaseToCamera();
  chain.Take({Moved("base", "camera", {1, 0, 0})});
  ExpectAt(chain.Take({Moved("base", "camera", {2, 0, 0})}), {2.0, 0.0, 0.0});
  ExpectAt(chain.Take({Moved("camera", "base", {3, 0, 0})}), {-3.0, 0.0, 0.0});
}

TEST(TransformChain, GivesAPoseOnlyWhenATransformOfItsOwnCame) {
  TransformChain chain = BaseToCamera();
  chain.Take(Head());
  EXPECT_FALSE(chain.Take({Moved("base", "wheel", {1, 0, 0})}));
  EXPECT_FALSE(chain.Take({}));
  EXPECT_TRUE(chain.Take({Head()[0]}));
}

TEST(TransformChain, CompletesWhenTheCameraIsNamed) {
  TransformChain chain("base");
  EXPECT_FALSE(chain.Take(Head()));
  EXPECT_THAT(chain.WhatLacks(), HasSubstr("camera's frame is not known"));
  chain.SetCameraFrame("camera");
  EXPECT_EQ(chain.WhatLacks(), "");
  EXPECT_TRUE(chain.Take(Head()));
}

TEST(TransformChain, SaysWhichFrameNobodyNames) {
  TransformChain chain = BaseToCamera();
  EXPECT_EQ(chain.WhatLacks(), "no transform names 'base'");
  chain.Take({Moved("base", "wheel", {1, 0, 0})});
  EXPECT_EQ(chain.WhatLacks(), "no transform names 'camera'");
}

TEST(TransformChain, SaysWhereTheChainIsBroken) {
  TransformChain chain = BaseToCamera();
  EXPECT_FALSE(chain.Take({Moved("world", "base", {1, 0, 0}), Moved("neck", "camera", {1, 0, 0})}));
  EXPECT_EQ(chain.WhatLacks(),
            "no transform leads from 'world' (above 'base') to 'neck' (above 'camera')");
  EXPECT_TRUE(chain.Take({Moved("world", "neck", {0, 0, 0})}));
}

TEST(TransformChain, ACircleHoldsNobodyUp) {
  TransformChain chain = BaseToCamera();
  EXPECT_FALSE(chain.Take({Moved("a", "b", {1, 0, 0}), Moved("b", "base", {1, 0, 0}),
                           Moved("base", "a", {1, 0, 0}), Moved("camera", "c", {1, 0, 0}),
                           Moved("c", "d", {1, 0, 0}), Moved("d", "camera", {1, 0, 0})}));
  EXPECT_THAT(chain.WhatLacks(), HasSubstr("no transform leads from"));
  ExpectAt(chain.Take({Moved("base", "camera", {4, 0, 0})}), {4.0, 0.0, 0.0});
}

TEST(TransformChain, TakesTheShortestOfTwoWays) {
  TransformChain chain = BaseToCamera();
  ExpectAt(chain.Take({Moved("base", "neck", {1, 0, 0}), Moved("neck", "camera", {1, 0, 0}),
                       Moved("base", "camera", {9, 0, 0})}),
           {9.0, 0.0, 0.0});
}

TEST(TransformChain, AFloodOfFramesDoesNotBreakAChain) {
  TransformChain chain = BaseToCamera();
  chain.Take(Head());
  Flood(chain, 2000);
  EXPECT_EQ(chain.WhatLacks(), "");
  ExpectAt(chain.Take({Head()[0]}), {0.0, 0.1, 1.0});
}

TEST(TransformChain, CompletesAfterAFloodOfFrames) {
  TransformChain chain = BaseToCamera();
  Flood(chain, 2000);
  EXPECT_EQ(chain.WhatLacks(), "no transform names 'base'");
  EXPECT_TRUE(chain.Take(Head()));
}

TEST(TransformChain, AChainLongerThanAllThatIsKeptIsNeverComplete) {
  TransformChain chain("f0");
  chain.SetCameraFrame("f" + std::to_string(TransformChain::kMostTransforms + 1));
  FrameTransforms transforms;
  for (std::size_t i = 0; i <= TransformChain::kMostTransforms; ++i) {
    transforms.push_back(Moved("f" + std::to_string(i), "f" + std::to_string(i + 1), {0.01, 0, 0}));
  }
  EXPECT_FALSE(chain.Take(transforms));
  EXPECT_NE(chain.WhatLacks(), "");
}

TEST(TransformChain, AChainOfAllThatIsKeptIsComplete) {
  TransformChain chain("f0");
  chain.SetCameraFrame("f" + std::to_string(TransformChain::kMostTransforms));
  FrameTransforms transforms;
  for (std::size_t i = 0; i < TransformChain::kMostTransforms; ++i) {
    transforms.push_back(Moved("f" + std::to_string(i), "f" + std::to_string(i + 1), {0.5, 0, 0}));
  }
  ExpectAt(chain.Take(transforms), {128.0, 0.0, 0.0});
  // One more takes the place of a link, since there is no other place.
  EXPECT_FALSE(chain.Take({Moved("x", "y", {1, 0, 0})}));
  EXPECT_NE(chain.WhatLacks(), "");
}

}  // namespace
}  // namespace deixis::geometry
