// Motions into poses of the shipped models, and back.
#include "common/retargeting/retarget.h"

#include <gmock/gmock.h>

#include <cmath>
#include <random>

#include "common/body_model/joint_angles.h"
#include "common/body_model/kinematics.h"
#include "common/config/config.h"
#include "common/range_of_motion/range_of_motion.h"
#include "common/retargeting/to_clip.h"
#include "test/common/range_of_motion/range_samples.h"

namespace deixis::retargeting {
namespace {

using body_model::BodyModel;
using body_model::BodyPose;
using body_model::Kinematics;
using Eigen::Vector3d;
using motion::ChannelKind;
using range_of_motion::kDegree;
using range_of_motion::ShippedBody;

SkeletonMap ShippedMap(const std::string& name) {
  return LoadSkeletonMap(DEIXIS_SOURCE_DIR "/config/skeletons/" + name + ".yaml");
}

/// Any angles within half the envelope, the body anywhere.
BodyPose RandomPose(const BodyModel& model, std::mt19937& random) {
  std::uniform_real_distribution<double> share(0.25, 0.75);
  BodyPose pose = RestPose(model);
  Eigen::Index angle = 0;
  for (const body_model::Limb& limb : model.limbs()) {
    for (const body_model::DegreeOfFreedom& dof : limb.dofs) {
      pose.angles_rad[angle++] =
          dof.angle_min_rad + share(random) * (dof.angle_max_rad - dof.angle_min_rad);
    }
  }
  pose.frame_from_root = {Eigen::Quaterniond(body_model::RotationFrom(
                              Vector3d(share(random), share(random), 3.0 * share(random)))),
                          Vector3d(share(random), share(random), share(random))};
  return pose;
}

class WholeBodies : public testing::TestWithParam<std::string> {};

TEST_P(WholeBodies, ComeBackFromTheClipsThatTheyAreWrittenTo) {
  std::mt19937 random(3);
  BodyMotion motion{ShippedBody(GetParam()), 30.0, {}};
  for (int i = 0; i < 40; ++i) motion.poses.push_back(RandomPose(motion.model, random));
  // The average person that is scaled is of another size.
  const Retargeted back =
      Retarget(ToClip(motion), ShippedMap("deixis"), range_of_motion::ShippedBody(GetParam()));
  EXPECT_EQ(back.motion.frame_rate_hz, 30.0);
  EXPECT_THAT(back.at_rest, testing::IsEmpty());
  ASSERT_EQ(back.motion.poses.size(), motion.poses.size());
  Kinematics wanted(motion.model), found(back.motion.model);
  for (std::size_t frame = 0; frame < motion.poses.size(); ++frame) {
    wanted.Update(motion.poses[frame]);
    found.Update(back.motion.poses[frame]);
    for (int limb = 0; limb < motion.model.limb_count(); ++limb) {
      EXPECT_LT((wanted.proximal_m(limb) - found.proximal_m(limb)).norm(), 1e-6);
      EXPECT_LT((wanted.distal_m(limb) - found.distal_m(limb)).norm(), 1e-6)
          << motion.model.limbs()[static_cast<std::size_t>(limb)].name;
      EXPECT_LT((wanted.limb(limb).linear() - found.limb(limb).linear()).norm(), 1e-6)
          << motion.model.limbs()[static_cast<std::size_t>(limb)].name;
    }
  }
}

TEST(ToClip, TurnsRightWhereTwoAnglesTurnAboutOneAxis) {
  Eigen::Matrix3d prone;  // And rolled: up becomes backward, forward becomes left.
  prone << 0, 0, -1, 1, 0, 0, 0, -1, 0;
  BodyMotion motion{ShippedBody("whole_body"), 30.0, {}};
  motion.poses.push_back(Standing(motion.model));
  motion.poses.back().frame_from_root = {Eigen::Quaterniond(prone), Vector3d::Zero()};
  const motion::Clip clip = ToClip(motion);
  const auto turned = ForwardKinematics(clip.skeleton, clip.frames.row(0).transpose());
  Eigen::Matrix3d file_from_body;
  file_from_body << 0, 1, 0, 0, 0, 1, 1, 0, 0;
  for (const auto& joint : turned) {
    EXPECT_LT((file_from_body.transpose() * joint.linear() * file_from_body - prone).norm(), 1e-9);
  }
}

INSTANTIATE_TEST_SUITE_P(OfTheShipped, WholeBodies,
                         testing::Values("whole_body", "whole_body_detailed", "upper_body",
                                         "right_arm"));

/// A person in a T pose, y up, looking along z, centimetres made metres: bones of a usual BVH.
class TPose {
 public:
  TPose() {
    Add("Hips", "", {0, 0.95, 0});
    Add("Spine", "Hips", {0, 0.10, 0});
    Add("Spine1", "Spine", {0, 0.15, 0});
    Add("Neck", "Spine1", {0, 0.25, 0});
    Add("Head", "Neck", {0, 0.10, 0});
    End({0, 0.18, 0});
    for (const double side : {1.0, -1.0}) {
      const std::string name = side > 0.0 ? "Left" : "Right";
      Add(name + "Shoulder", "Spine1", {0.03 * side, 0.22, 0});
      Add(name + "Arm", name + "Shoulder", {0.15 * side, 0, 0});
      Add(name + "ForeArm", name + "Arm", {0.29 * side, 0, 0});
      Add(name + "Hand", name + "ForeArm", {0.25 * side, 0, 0});
      End({0.18 * side, 0, 0});
      Add(name + "UpLeg", "Hips", {0.09 * side, -0.02, 0});
      Add(name + "Leg", name + "UpLeg", {0, -0.42, 0});
      Add(name + "Foot", name + "Leg", {0, -0.42, 0});
      Add(name + "ToeBase", name + "Foot", {0, -0.07, 0.14});
      End({0, 0, 0.06});
    }
    clip_.frame_rate_hz = 30.0;
  }

  int Find(const std::string& name) const {
    for (std::size_t i = 0; i < clip_.skeleton.joints.size(); ++i) {
      if (clip_.skeleton.joints[i].name == name) return static_cast<int>(i);
    }
    return -1;
  }
  /// Degrees about z, x, y of the file.
  using Turns = std::vector<std::pair<std::string, Vector3d>>;
  void AddFrame(const Turns& turns) {
    Eigen::VectorXd frame = Eigen::VectorXd::Zero(clip_.skeleton.ChannelCount());
    for (const auto& [joint, degrees] : turns) {
      frame.segment<3>(3 * Find(joint)) = degrees * kDegree;
    }
    clip_.frames.conservativeResize(clip_.frames.rows() + 1, frame.size());
    clip_.frames.bottomRows(1) = frame.transpose();
  }
  const motion::Clip& clip() const { return clip_; }

 private:
  void Add(const std::string& name, const std::string& parent, const Vector3d& offset_m) {
    motion::Joint joint;
    joint.name = name;
    joint.parent = Find(parent);
    joint.offset_m = offset_m;
    joint.channels = {ChannelKind::kZRotation, ChannelKind::kXRotation, ChannelKind::kYRotation};
    clip_.skeleton.joints.push_back(joint);
  }
  void End(const Vector3d& site_m) { clip_.skeleton.joints.back().end_sites_m = {site_m}; }

  motion::Clip clip_;
};

/// Anatomical angles of each frame, degrees.
class Angles {
 public:
  explicit Angles(const motion::Clip& clip)
      : made_(Retarget(clip, ShippedMap("biovision"), ShippedBody("whole_body_detailed"))),
        ranges_(made_.motion.model, range_of_motion::ShippedRanges(),
                range_of_motion::ShippedRows()) {}
  range_of_motion::AnatomicalAngles Of(const std::string& joint, std::size_t frame) const {
    Kinematics kinematics(made_.motion.model);
    kinematics.Update(made_.motion.poses[frame]);
    for (const auto& each : ranges_.joints()) {
      if (each.Name() == joint) return ranges_.Measure(kinematics, each) / kDegree;
    }
    throw std::logic_error("no joint " + joint);
  }
  const Retargeted& made() const { return made_; }

 private:
  Retargeted made_;
  range_of_motion::RangeOfMotion ranges_;
};

TEST(Retarget, ReadsATPoseAsArmsThatAreSpread) {
  TPose person;
  person.AddFrame({});
  const Angles angles(person.clip());
  for (const char* side : {"right_", "left_"}) {
    const auto shoulder = angles.Of(side + std::string("shoulder"), 0);
    EXPECT_NEAR(shoulder[0], 90.0, 1e-6);
    EXPECT_NEAR(shoulder[1], 90.0, 1e-6);
    EXPECT_NEAR(angles.Of(side + std::string("elbow"), 0)[0], 0.0, 1e-6);
    EXPECT_NEAR(angles.Of(side + std::string("hip"), 0).norm(), 0.0, 1e-6);
    EXPECT_NEAR(angles.Of(side + std::string("knee"), 0).norm(), 0.0, 1e-6);
    EXPECT_NEAR(angles.Of(side + std::string("ankle"), 0).norm(), 0.0, 1e-6);
  }
  EXPECT_NEAR(angles.Of("thoracolumbar_spine", 0).norm(), 0.0, 1e-6);
}

TEST(Retarget, GivesMotionsTheirAnatomicalNamesAndSigns) {
  TPose person;
  person.AddFrame({{"LeftArm", {-90, 0, 0}},  // Down to the side.
                   {"RightArm", {90, 0, 0}},
                   {"LeftForeArm", {0, 0, -70}},  // Bends forward.
                   {"RightForeArm", {0, 0, 70}},
                   {"LeftUpLeg", {0, -80, 0}},  // Knee lifted.
                   {"LeftLeg", {0, 60, 0}},
                   {"RightUpLeg", {-25, 0, 0}},  // Spread.
                   {"RightFoot", {0, -15, 0}},   // Toes up.
                   {"Spine", {0, 20, 0}},        // Bows.
                   {"Neck", {0, 0, 30}}});       // Looks to the left.
  const Angles angles(person.clip());
  for (const char* side : {"right_", "left_"}) {
    EXPECT_NEAR(angles.Of(side + std::string("shoulder"), 0)[0], 0.0, 1e-5) << side;
    EXPECT_NEAR(angles.Of(side + std::string("elbow"), 0)[0], 70.0, 1e-6) << side;
    EXPECT_NEAR(angles.Of(side + std::string("elbow"), 0)[1], 0.0, 1e-6) << side;
  }
  EXPECT_NEAR(angles.Of("left_hip", 0)[0], 80.0, 1e-6);
  EXPECT_NEAR(angles.Of("left_knee", 0)[0], 60.0, 1e-6);
  EXPECT_NEAR(angles.Of("right_hip", 0)[1], 25.0, 1e-6);
  EXPECT_NEAR(angles.Of("right_ankle", 0)[0], 15.0, 1e-6);
  EXPECT_NEAR(angles.Of("thoracolumbar_spine", 0)[0], 20.0, 1e-6);
  EXPECT_NEAR(angles.Of("cervical_spine", 0)[2], 30.0, 1e-6);
}

TEST(Retarget, MeetsTheFilesOwnJoints) {
  TPose person;
  std::mt19937 random(2);
  std::uniform_real_distribution<double> turn(-25.0, 25.0);
  for (int frame = 0; frame < 30; ++frame) {
    TPose::Turns turns;
    for (const char* joint : {"Hips", "Spine", "Spine1", "Neck", "LeftShoulder", "LeftArm",
                              "RightArm", "LeftUpLeg", "RightUpLeg", "Head"}) {
      turns.push_back({joint, Vector3d(turn(random), turn(random), turn(random))});
    }
    turns.push_back({"LeftForeArm", Vector3d(0, 0, -40.0 + turn(random))});
    turns.push_back({"RightLeg", Vector3d(0, 40.0 + turn(random), 0)});
    person.AddFrame(turns);
  }
  const Angles angles(person.clip());
  for (const JointError& error : angles.made().errors) {
    EXPECT_LT(error.largest_m, 1e-6) << error.limb;
  }
}

TEST(Retarget, FindsTheAxisOfAHingeThatAFileTilts) {
  TPose person;
  const Eigen::AngleAxisd tilt(30 * kDegree, Vector3d::UnitX());
  for (int i = 0; i < 10; ++i) {
    const Eigen::Matrix3d bend =
        (tilt * Eigen::AngleAxisd(-10.0 * i * kDegree, Vector3d::UnitY()) * tilt.inverse())
            .toRotationMatrix();
    const Vector3d zxy(std::atan2(-bend(0, 1), bend(1, 1)), std::asin(bend(2, 1)),
                       std::atan2(-bend(2, 0), bend(2, 2)));
    person.AddFrame({{"LeftForeArm", zxy / kDegree}});
  }
  const Angles angles(person.clip());
  for (std::size_t i = 0; i < 10; ++i) {
    EXPECT_NEAR(angles.Of("left_elbow", i)[0], 10.0 * static_cast<double>(i), 1e-6);
  }
  for (const JointError& error : angles.made().errors) {
    EXPECT_LT(error.largest_m, 1e-6) << error.limb;
  }
}

TEST(Retarget, ScalesTheBodyToThePerson) {
  TPose person;
  person.AddFrame({});
  const Angles angles(person.clip());
  const BodyModel& model = angles.made().motion.model;
  const auto length_m = [&model](const char* limb) {
    return model.limbs()[static_cast<std::size_t>(*model.Find(limb))].shape.length_m;
  };
  EXPECT_NEAR(length_m("right_upper_arm"), 0.29, 1e-9);
  EXPECT_NEAR(length_m("left_shank"), 0.42, 1e-9);
  EXPECT_NEAR(length_m("chest"), 0.25, 1e-9);  // Of a limb that stands as the model's does.
  EXPECT_NEAR(length_m("right_foot"), 0.14, 1e-9);
  EXPECT_GT(angles.made().scale, 0.8);
  EXPECT_LT(angles.made().scale, 1.3);
}

TEST(Retarget, TakesAnyUpAxisAndPlace) {
  TPose person;
  person.AddFrame({{"LeftArm", {-60, 10, 0}}});
  motion::Clip lying = person.clip();
  // The same person in a file with z up.
  const Eigen::Quaterniond stand(Eigen::AngleAxisd(M_PI / 2.0, Vector3d::UnitX()));
  for (motion::Joint& joint : lying.skeleton.joints) {
    joint.offset_m = stand * joint.offset_m;
    for (Vector3d& site : joint.end_sites_m) site = stand * site;
    joint.pre_rotation = stand;
  }
  const Angles upright(person.clip()), turned(lying);
  EXPECT_LT((upright.Of("left_shoulder", 0) - turned.Of("left_shoulder", 0)).norm(), 1e-6);
  EXPECT_LT(
      (upright.made().motion.poses[0].angles_rad - turned.made().motion.poses[0].angles_rad).norm(),
      1e-6);
}

std::string RefusalOf(const motion::Clip& clip) {
  try {
    Retarget(clip, ShippedMap("biovision"), ShippedBody("whole_body"));
  } catch (const config::ConfigError& error) {
    return error.what();
  }
  return "";
}

TEST(Retarget, RefusesPeopleOfAnotherUnitAndBodiesThatDoNotStand) {
  TPose person;
  person.AddFrame({});
  EXPECT_EQ(RefusalOf(person.clip()), "");
  for (const double scale : {0.01, 0.4, 2.54, 100.0}) {
    motion::Clip scaled = person.clip();
    for (motion::Joint& joint : scaled.skeleton.joints) {
      joint.offset_m *= scale;
      for (Vector3d& site : joint.end_sites_m) site *= scale;
    }
    EXPECT_THAT(RefusalOf(scaled), testing::HasSubstr("unit")) << scale;
  }
  motion::Clip exchanged = person.clip(), lifted = person.clip();
  for (motion::Joint& joint : exchanged.skeleton.joints) {
    if (joint.name.rfind("Left", 0) == 0) {
      joint.name = "Right" + joint.name.substr(4);
    } else if (joint.name.rfind("Right", 0) == 0) {
      joint.name = "Left" + joint.name.substr(5);
    }
  }
  EXPECT_THAT(RefusalOf(exchanged), testing::HasSubstr("left and right exchanged"));
  lifted.skeleton.joints[static_cast<std::size_t>(person.Find("LeftFoot"))].offset_m =
      Vector3d(0, 0.42, 0);
  EXPECT_THAT(RefusalOf(lifted), testing::HasSubstr("left_shank does not hang"));
}

TEST(Retarget, RefusesWhatIsNoStandingPerson) {
  TPose person;
  person.AddFrame({});
  motion::Clip flat = person.clip();
  for (motion::Joint& joint : flat.skeleton.joints) joint.offset_m.setZero();
  EXPECT_THROW(Retarget(flat, ShippedMap("biovision"), ShippedBody("whole_body")),
               config::ConfigError);
  motion::Clip empty = person.clip();
  empty.frames.resize(0, empty.skeleton.ChannelCount());
  EXPECT_THROW(Retarget(empty, ShippedMap("biovision"), ShippedBody("whole_body")),
               config::ConfigError);
}

}  // namespace
}  // namespace deixis::retargeting
