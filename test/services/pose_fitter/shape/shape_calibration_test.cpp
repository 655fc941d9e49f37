#include "services/pose_fitter/core/shape/shape_calibration.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <string>

#include "common/config/config.h"
#include "test/services/pose_fitter/shape/seen_person.h"

namespace deixis::pose_fitter {
namespace {

using body_model::BodyModel;
using Eigen::VectorXd;

constexpr double kNoise_m = 0.01;

double Length(const BodyModel& model, const std::string& limb) {
  return model.limbs()[static_cast<std::size_t>(model.Find(limb).value())].shape.length_m;
}

/// Values of parameters by name, the others 0.
VectorXd Values(const ShapeParameters& parameters, const std::map<std::string, double>& values) {
  VectorXd all = VectorXd::Zero(parameters.count());
  for (const auto& [name, value] : values) all[parameters.Find(name)] = value;
  return all;
}

std::vector<ShapeFrame> WithRoughPoses(Scene scene) {
  for (std::size_t i = 0; i < scene.frames.size(); ++i) {
    scene.frames[i].pose = scene.rough_poses[i];
  }
  return scene.frames;
}

/// Somebody whose limbs are unlike those expected, seen in 60 frames.
class UnusualPerson : public testing::Test {
 protected:
  static const std::map<std::string, double>& Truth() {
    static const std::map<std::string, double> truth = {
        {"upper_arm_length", 0.07}, {"lower_arm_length", -0.08}, {"thigh_length", 0.06},
        {"shank_length", -0.07},    {"trunk_length", 0.05},      {"shoulder_width", 0.05},
        {"leg_girth", -0.10},       {"arm_girth", 0.12},         {"trunk_depth", 0.10}};
    return truth;
  }

  UnusualPerson()
      : parameters_(ClothedPerson(1.72, 0.01)),
        truth_(parameters_.Apply(Values(parameters_, Truth()))) {
    config_.points_per_observation = 4.0;  // Here each point has its own error.
  }

  ShapeParameters parameters_;
  BodyModel truth_;
  ShapeConfig config_;
};

TEST_F(UnusualPerson, HasItsLengthsFoundWithinOneCentimetre) {
  const auto result =
      CalibrateShape(parameters_, WithRoughPoses(Watch(truth_, 60, 500, kNoise_m, 1)), config_);
  ASSERT_TRUE(result.shape);
  for (const char* limb : {"right_upper_arm", "right_lower_arm", "right_thigh", "right_shank"}) {
    EXPECT_NEAR(Length(result.shape->model, limb), Length(truth_, limb), 0.01) << limb;
    EXPECT_GT(std::abs(Length(parameters_.model(), limb) - Length(truth_, limb)), 0.015) << limb;
  }
  for (const char* limb : {"right_clavicle", "abdomen", "chest"}) {
    EXPECT_NEAR(Length(result.shape->model, limb), Length(truth_, limb), 0.01) << limb;
  }
  // Points have no error across their rays, for which the fit allows.
  EXPECT_GT(result.shape->rms_sigmas, 0.6);
  EXPECT_LT(result.shape->rms_sigmas, 1.0);
}

TEST_F(UnusualPerson, KnowsHowSureItsLengthsAre) {
  const auto result =
      CalibrateShape(parameters_, WithRoughPoses(Watch(truth_, 60, 500, kNoise_m, 2)), config_);
  ASSERT_TRUE(result.shape);
  const CalibratedShape& shape = *result.shape;
  for (std::size_t i = 0; i < shape.lengths.size(); ++i) {
    const auto k = static_cast<Eigen::Index>(i);
    const bool is_paired = !truth_.Find(shape.lengths[i]);
    const double sigma_m = std::sqrt(shape.length_covariance_m2(k, k));
    const double error_m =
        shape.lengths_m[k] - Length(truth_, (is_paired ? "right_" : "") + shape.lengths[i]);
    EXPECT_LT(std::abs(error_m), 4.0 * sigma_m + 0.001) << shape.lengths[i];
    EXPECT_LT(sigma_m, 0.03) << shape.lengths[i];
  }
}

TEST_F(UnusualPerson, HasLeftAndRightAlike) {
  const auto result =
      CalibrateShape(parameters_, WithRoughPoses(Watch(truth_, 20, 300, kNoise_m, 3)), config_);
  ASSERT_TRUE(result.shape);
  const auto& limbs = result.shape->model.limbs();
  for (const body_model::Limb& limb : limbs) {
    if (limb.name.rfind("right_", 0) != 0) continue;
    const auto left = result.shape->model.Find("left_" + limb.name.substr(6)).value();
    const auto& other = limbs[static_cast<std::size_t>(left)];
    EXPECT_DOUBLE_EQ(limb.shape.length_m, other.shape.length_m) << limb.name;
    EXPECT_DOUBLE_EQ(limb.shape.a0_m, other.shape.a0_m) << limb.name;
    EXPECT_DOUBLE_EQ(limb.rest_in_parent.translation_m.y(),
                     -other.rest_in_parent.translation_m.y() + 0.0)
        << limb.name;
  }
}

TEST_F(UnusualPerson, KeepsThePriorWhereNothingIsSeen) {
  auto frames = WithRoughPoses(Watch(truth_, 40, 500, kNoise_m, 4));
  for (ShapeFrame& frame : frames) {  // Behind a table: no legs.
    std::vector<ShapePoint> seen;
    for (const ShapePoint& point : frame.points) {
      const std::string& limb = truth_.limbs()[static_cast<std::size_t>(point.limb)].name;
      const bool is_leg = limb.find("thigh") != limb.npos || limb.find("shank") != limb.npos ||
                          limb.find("foot") != limb.npos;
      if (!is_leg) seen.push_back(point);
    }
    frame.points = seen;
  }
  const auto result = CalibrateShape(parameters_, frames, config_);
  ASSERT_TRUE(result.shape);
  for (const char* name : {"thigh_length", "shank_length", "leg_girth"}) {
    const int k = parameters_.Find(name);
    const double sigma = parameters_.all()[static_cast<std::size_t>(k)].sigma;
    EXPECT_NEAR(result.shape->values[k], 0.0, 0.02 * sigma) << name;
    EXPECT_NEAR(std::sqrt(result.shape->covariance(k, k)), sigma, 0.02 * sigma) << name;
  }
  EXPECT_NEAR(Length(result.shape->model, "right_upper_arm"), Length(truth_, "right_upper_arm"),
              0.012);
}

TEST_F(UnusualPerson, IsRefusedWithTooFewFrames) {
  const auto result =
      CalibrateShape(parameters_, Watch(truth_, 5, 2000, kNoise_m, 5).frames, config_);
  EXPECT_FALSE(result.shape);
  EXPECT_EQ(result.refusal, ShapeRefusal::kTooFewFrames);
}

TEST_F(UnusualPerson, IsRefusedWithTooFewPoints) {
  const auto result =
      CalibrateShape(parameters_, Watch(truth_, 30, 20, kNoise_m, 6).frames, config_);
  EXPECT_EQ(result.refusal, ShapeRefusal::kTooFewPoints);
}

TEST_F(UnusualPerson, IsRefusedWhenThePointsSayNothing) {
  auto frames = Watch(truth_, 20, 250, kNoise_m, 7).frames;
  for (ShapeFrame& frame : frames) {
    for (ShapePoint& point : frame.points) point.sigma_m = 2.0;
  }
  const auto result = CalibrateShape(parameters_, frames, config_);
  EXPECT_EQ(result.refusal, ShapeRefusal::kNothingLearned);
}

TEST_F(UnusualPerson, DoesNotMindOnePointInTenFromElsewhere) {
  auto frames = WithRoughPoses(Watch(truth_, 40, 500, kNoise_m, 8));
  for (ShapeFrame& frame : frames) {
    for (std::size_t i = 0; i < frame.points.size(); i += 10) {
      frame.points[i].point_m *= 1.04;  // Some 9 cm behind.
    }
  }
  const auto result = CalibrateShape(parameters_, frames, config_);
  ASSERT_TRUE(result.shape);
  EXPECT_NEAR(Length(result.shape->model, "right_thigh"), Length(truth_, "right_thigh"), 0.012);
  EXPECT_NEAR(Length(result.shape->model, "right_lower_arm"), Length(truth_, "right_lower_arm"),
              0.012);
}

TEST_F(UnusualPerson, GivesTheSameBytesTwice) {
  const auto frames = WithRoughPoses(Watch(truth_, 20, 250, kNoise_m, 9));
  const auto first = CalibrateShape(parameters_, frames, config_);
  const auto second = CalibrateShape(parameters_, frames, config_);
  ASSERT_TRUE(first.shape && second.shape);
  EXPECT_EQ(first.shape->model.id(), second.shape->model.id());
}

TEST_F(UnusualPerson, IsTheSameLearnedLittleByLittle) {
  const auto frames = WithRoughPoses(Watch(truth_, 20, 250, kNoise_m, 9));
  const auto at_once = CalibrateShape(parameters_, frames, config_);
  ShapeCalibration calibration(parameters_, frames, config_);
  int parts = 0;
  for (; !calibration.IsOver(); ++parts) calibration.Advance(3);
  EXPECT_GT(parts, 20);
  ASSERT_TRUE(at_once.shape && calibration.result().shape);
  EXPECT_EQ(calibration.result().shape->model.id(), at_once.shape->model.id());
}

TEST_F(UnusualPerson, CannotHavePosesOrLimbsOfAnotherModel) {
  auto frames = Watch(truth_, 20, 250, kNoise_m, 10).frames;
  frames[3].points[0].limb = truth_.limb_count();
  EXPECT_THROW(CalibrateShape(parameters_, frames, config_), std::logic_error);
  frames[3].points[0].limb = 0;
  frames[3].pose.angles_rad.resize(3);
  EXPECT_THROW(CalibrateShape(parameters_, frames, config_), std::logic_error);
}

TEST(ShapeConfig, RefusesWhatMakesNoSense) {
  ShapeConfig config;
  EXPECT_NO_THROW(config.Validate());
  config.points_per_observation = 0.5;
  EXPECT_THROW(config.Validate(), config::ConfigError);
  config = {};
  config.max_remaining_sigma = 1.5;
  EXPECT_THROW(config.Validate(), config::ConfigError);
  config = {};
  config.lateral_sigma_m = 0.0;
  EXPECT_THROW(config.Validate(), config::ConfigError);
}

}  // namespace
}  // namespace deixis::pose_fitter
