// What a fitter does with every pose: forward kinematics, Jacobians, limits; 19 limbs.
#include <benchmark/benchmark.h>

#include <random>

#include "common/range_of_motion/range_of_motion.h"
#include "test/common/range_of_motion/range_samples.h"

namespace deixis::body_model {
namespace {

BodyPose RandomPose(const BodyModel& model) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> share(0.2, 0.8);
  BodyPose pose = RestPose(model);
  Eigen::Index angle = 0;
  for (const Limb& limb : model.limbs()) {
    for (const DegreeOfFreedom& dof : limb.dofs) {
      pose.angles_rad[angle++] =
          dof.angle_min_rad + share(random) * (dof.angle_max_rad - dof.angle_min_rad);
    }
  }
  return pose;
}

struct Subject {
  BodyModel model = range_of_motion::ShippedBody("whole_body_detailed");
  BodyPose pose = RandomPose(model);
  Kinematics kinematics{model};
  Eigen::Matrix3Xd jacobian{Eigen::Matrix3Xd::Zero(3, 6 + model.angle_count())};
};

void ForwardKinematics(benchmark::State& state) {
  Subject subject;
  for (auto _ : state) {
    subject.kinematics.Update(subject.pose);
    benchmark::DoNotOptimize(subject.kinematics.limb(18));
  }
}
BENCHMARK(ForwardKinematics);

/// How the distal end of each limb moves with root and angles.
void Jacobians(benchmark::State& state) {
  Subject subject;
  for (auto _ : state) {
    subject.kinematics.Update(subject.pose);
    for (int limb = 0; limb < subject.model.limb_count(); ++limb) {
      PointJacobian(subject.kinematics, limb, subject.kinematics.distal_m(limb), subject.jacobian);
      benchmark::DoNotOptimize(subject.jacobian.data());
    }
  }
}
BENCHMARK(Jacobians);

/// The same by central differences, which need no derivation: the baseline. Angles only.
void JacobiansByDifferences(benchmark::State& state) {
  constexpr double kStep_rad = 1e-6;
  Subject subject;
  std::vector<Eigen::Vector3d> ends(subject.model.limbs().size());
  for (auto _ : state) {
    for (Eigen::Index angle = 0; angle < subject.pose.angles_rad.size(); ++angle) {
      for (const double step_rad : {kStep_rad, -2.0 * kStep_rad}) {
        subject.pose.angles_rad[angle] += step_rad;
        subject.kinematics.Update(subject.pose);
        for (int limb = 0; limb < subject.model.limb_count(); ++limb) {
          ends[static_cast<std::size_t>(limb)] = subject.kinematics.distal_m(limb);
        }
        benchmark::DoNotOptimize(ends.data());
      }
      subject.pose.angles_rad[angle] += kStep_rad;
    }
  }
}
BENCHMARK(JacobiansByDifferences);

/// Anatomical angles and margins of all 14 joints.
void CheckLimits(benchmark::State& state) {
  Subject subject;
  const range_of_motion::RangeOfMotion ranges(subject.model, range_of_motion::ShippedRanges(),
                                              range_of_motion::ShippedRows());
  std::vector<range_of_motion::JointState> states;
  subject.kinematics.Update(subject.pose);
  for (auto _ : state) {
    ranges.Check(subject.kinematics, states);
    benchmark::DoNotOptimize(states.data());
  }
}
BENCHMARK(CheckLimits);

}  // namespace
}  // namespace deixis::body_model
