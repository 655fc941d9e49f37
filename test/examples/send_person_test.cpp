// A person made of the files of config/, a pose of it, its joints and both on the bus: to copy
// from.
#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

#include "common/anatomy/joint_limits.h"
#include "common/anthropometry/person_estimate.h"
#include "common/body_model/body_plan.h"
#include "common/body_model/joint_angles.h"
#include "common/body_model/tracked_body.h"
#include "common/config/config.h"
#include "common/messages/body_poses.h"
#include "common/messages/person_model.h"
#include "common/range_of_motion/range_of_motion.h"
#include "common/transport/bus.h"

namespace deixis {
namespace {

/// A woman of 1.65 m.
body_model::BodyModel MakePerson() {
  const auto populations =
      anthropometry::Populations::Load(config::FindConfig("kinematics/population.yaml"));
  const auto sizes = SizesOf(populations, anthropometry::Sex::kFemale, 1.65);
  return body_model::LoadBody(config::FindConfig("body_models/whole_body.yaml"), sizes);
}

/// Upright, the right forearm pointing forward.
body_model::TrackedBody MakePose(const body_model::BodyModel& model) {
  body_model::TrackedBody body;
  body.state = body_model::BodyState::kTracked;
  body.pose = body_model::Standing(model);
  PointLimb(model, model.Find("right_lower_arm").value(), Eigen::Vector3d::UnitX(), body.pose);
  body_model::Kinematics kinematics(model);
  PlaceLimbs(kinematics, body);  // Fills in model_id and where each limb is.
  return body;
}

/// How bent a joint of the person is, degrees.
double FlexionOf(const std::string& name, const body_model::BodyModel& model,
                 const body_model::BodyPose& pose) {
  const auto rows = anatomy::JointLimits::Load(config::FindConfig("kinematics/joint_limits.yaml"));
  const auto plan =
      range_of_motion::LoadRangePlan(config::FindConfig("kinematics/range_of_motion.yaml"), rows);
  const range_of_motion::RangeOfMotion ranges(model, plan, rows);
  body_model::Kinematics kinematics(model);
  kinematics.Update(pose);
  std::vector<range_of_motion::JointState> states;
  ranges.Check(kinematics, states);
  for (std::size_t i = 0; i < states.size(); ++i) {
    if (ranges.joints()[i].Name() == name) return states[i].angles[0] * 180.0 / M_PI;
  }
  throw std::logic_error("no joint " + name);
}

TEST(ExampleOfAPerson, BendsTheElbowAndArrivesOverTheBus) {
  const body_model::BodyModel model = MakePerson();
  const body_model::TrackedBody body = MakePose(model);
  EXPECT_NEAR(FlexionOf("right_elbow", model, body.pose), 90.0, 10.0);

  transport::BusOptions options;
  options.url = "memq://";  // Within this program; without a URL, the one of all services.
  transport::Bus bus(options);
  std::int64_t model_id = 0;
  body_model::BodyPoses received;
  bus.Subscribe<body_model::PersonModel>(
      "BODY_MODEL", transport::Delivery::kEvery,
      [&](const body_model::PersonModel& person) { model_id = person.body.id(); });
  bus.Subscribe<body_model::BodyPoses>(
      "BODY_POSES", transport::Delivery::kEvery,
      [&](const body_model::BodyPoses& poses) { received = poses; });

  const Timestamp now{1'000'000};  // Microseconds: the time of the image.
  bus.Publish("BODY_MODEL", body_model::PersonModel{now, model});
  bus.Publish("BODY_POSES", body_model::BodyPoses{now, "camera", "camera", "example", {}, {body}});
  for (int i = 0; i < 50 && received.bodies.empty(); ++i) {
    bus.Handle(std::chrono::milliseconds(100));
  }

  ASSERT_EQ(received.bodies.size(), 1u);
  EXPECT_EQ(received.bodies[0].model_id, model_id);
  EXPECT_NO_THROW(messages::CheckAgainst(received.bodies[0], model));
}

}  // namespace
}  // namespace deixis
