#pragma once
#include <random>
#include <string>
#include <vector>

#include "common/anthropometry/body_measures.h"
#include "common/body_model/body_model.h"

namespace deixis::body_model {

/// A limb 0.3 m long, at the distal end of one like it.
Limb PlainLimb(const std::string& name, int parent);

DegreeOfFreedom Dof(const std::string& name, DofKind kind, const Eigen::Vector3d& axis,
                    double min_rad, double max_rad);

/// A trunk, an arm of three limbs (ball joint at rest to the side, elbow with twist, wrist of two
/// swings) and a head that is fixed.
std::vector<Limb> ArmAndHead();

struct Person {
  anthropometry::Sex sex;
  double stature_m;
};

/// Women and men, small and tall.
std::vector<Person> FourPeople();

/// A file of config/body_models, without its ending, with the usual sizes of that person.
BodyModel Shipped(const std::string& name, const Person& person);

/// Names of all files of config/body_models, without their ending, in their order.
std::vector<std::string> ShippedNames();

/// Any root, any angles within the envelope.
BodyPose RandomPose(const BodyModel& model, std::mt19937& random);

/// Expects PointJacobian to agree with finite differences, for a point of every limb.
void ExpectDerivatives(const BodyModel& model, const BodyPose& pose);

}  // namespace deixis::body_model
