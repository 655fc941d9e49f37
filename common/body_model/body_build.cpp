// A model from a plan and the sizes of a person.
#include <Eigen/Geometry>
#include <cmath>
#include <map>
#include <set>
#include <utility>

#include "common/body_model/body_plan.h"
#include "common/config/config.h"

namespace deixis::body_model {
namespace {

using Eigen::Vector3d;

constexpr double kRadiansPerDegree = M_PI / 180.0;

Vector3d Direction(const std::vector<double>& values) {
  return Vector3d(values[0], values[1], values[2]).normalized();
}

[[noreturn]] void Fail(const std::string& limb, const std::string& key, const std::string& fault) {
  throw LimbFault(limb, key, fault);
}

/// One limb of the body: of a plan for both sides there are two.
struct Member {
  const LimbPlan* plan = nullptr;
  std::string name;
  std::string parent;
  bool is_left = false;
};

std::vector<Member> Members(const BodyPlan& plan) {
  std::set<std::string> sided;
  for (const LimbPlan& limb : plan.limbs) {
    if (limb.side == Side::kBoth) sided.insert(limb.name);
  }
  std::vector<Member> members;
  for (const LimbPlan& limb : plan.limbs) {
    if (limb.side == Side::kOnce) {
      members.push_back({&limb, limb.name, limb.parent, false});
      continue;
    }
    for (const bool is_left : {false, true}) {
      const std::string prefix = is_left ? "left_" : "right_";
      const std::string parent = sided.count(limb.parent) != 0 ? prefix + limb.parent : limb.parent;
      members.push_back({&limb, prefix + limb.name, parent, is_left});
    }
  }
  return members;
}

void RequireParents(const std::vector<Member>& members) {
  std::set<std::string> names;
  for (const Member& member : members) names.insert(member.name);
  std::string base;
  for (const Member& member : members) {
    if (!member.parent.empty()) {
      if (names.count(member.parent) == 0) {
        Fail(member.name, "parent", "parent '" + member.parent + "' is no limb of this body");
      }
    } else if (!base.empty()) {
      Fail(member.name, "", "has no parent, but '" + base + "' is the base limb; name a parent");
    } else {
      base = member.name;
    }
  }
  if (base.empty()) {
    throw config::ConfigError("every limb has a parent; one must be the base limb, without");
  }
}

/// Parents before their children, else in the plan's order.
std::vector<Member> InOrder(std::vector<Member> members) {
  RequireParents(members);
  std::vector<Member> ordered;
  std::set<std::string> placed{""};
  while (!members.empty()) {
    std::vector<Member> waiting;
    for (Member& member : members) {
      if (placed.count(member.parent) != 0) {
        placed.insert(member.name);
        ordered.push_back(std::move(member));
      } else {
        waiting.push_back(std::move(member));
      }
    }
    if (waiting.size() == members.size()) {
      Fail(waiting.front().name, "parent",
           "is its own ancestor, by '" + waiting.front().parent + "'");
    }
    members = std::move(waiting);
  }
  return ordered;
}

/// Lengths of one limb of one person.
class Lengths {
 public:
  Lengths(const Member& member, const Sizes& sizes) : member_(member), sizes_(sizes) {}

  double operator()(const LengthPlan& plan) const {
    double sum_m = 0.0;
    for (const Term& term : plan) sum_m += term.of.empty() ? term.metres : term.share * Of(term.of);
    return sum_m;
  }
  /// Along y, which points to the same side of the body in both limbs of a pair.
  double Sideways(const LengthPlan& plan) const {
    return member_.is_left ? -(*this)(plan) : (*this)(plan);
  }

 private:
  double Of(const std::string& measure) const {
    const auto size = sizes_.find(measure);
    if (size != sizes_.end()) return size->second;
    Fail(member_.name, "", "measure '" + measure + "' is not known of this person");
  }

  const Member& member_;
  const Sizes& sizes_;
};

Vector3d Mirrored(Vector3d direction, bool is_left) {
  if (is_left) direction.y() = -direction.y();
  return direction;
}

Eigen::Quaterniond RestOf(const Member& member) {
  const Vector3d z = Mirrored(Direction(member.plan->rest_z), member.is_left);
  const Vector3d hint = Mirrored(Direction(member.plan->rest_x), member.is_left);
  const Vector3d across = hint - hint.dot(z) * z;
  if (across.norm() < 1e-3) Fail(member.name, "rest_x", "rest_x must not be parallel to rest_z");
  Eigen::Matrix3d axes;
  axes.col(0) = across.normalized();
  axes.col(2) = z;
  axes.col(1) = z.cross(axes.col(0));
  return Eigen::Quaterniond(axes);
}

DegreeOfFreedom DofOf(const AnglePlan& plan, bool is_left) {
  DegreeOfFreedom dof;
  dof.name = plan.name;
  dof.kind = plan.kind;
  dof.axis = Direction(plan.axis);
  // A mirror turns rotations about x and z round, not those about y.
  if (is_left) dof.axis = Vector3d(-dof.axis.x(), dof.axis.y(), -dof.axis.z());
  dof.angle_min_rad = plan.min_deg * kRadiansPerDegree;
  dof.angle_max_rad = plan.max_deg * kRadiansPerDegree;
  return dof;
}

Limb LimbOf(const Member& member, int parent, const Sizes& sizes) {
  const LimbPlan& plan = *member.plan;
  const Lengths length(member, sizes);
  Limb limb;
  limb.name = member.name;
  limb.parent = parent;
  if (parent >= 0) {
    limb.rest_in_parent = {
        RestOf(member),
        {length(plan.origin.x), length.Sideways(plan.origin.y), length(plan.origin.z)}};
  }
  limb.shape = {length(plan.proximal.a),
                length(plan.proximal.b),
                length(plan.distal.a),
                length(plan.distal.b),
                length(plan.length),
                {length(plan.proximal.x), length.Sideways(plan.proximal.y)},
                {length(plan.distal.x), length.Sideways(plan.distal.y)}};
  for (const AnglePlan& angle : plan.angles) limb.dofs.push_back(DofOf(angle, member.is_left));
  return limb;
}

/// limbs[8].length
std::string KeyOf(const BodyPlan& plan, const LimbFault& fault) {
  for (const Member& member : Members(plan)) {
    if (member.name != fault.limb()) continue;
    const auto index = member.plan - plan.limbs.data();
    return "limbs[" + std::to_string(index) + "]" + (fault.key().empty() ? "" : "." + fault.key());
  }
  return "limbs";
}

}  // namespace

BodyModel Build(const BodyPlan& plan, const Sizes& sizes) {
  std::map<std::string, int> places;
  std::vector<Limb> limbs;
  for (const Member& member : InOrder(Members(plan))) {
    const int parent = member.parent.empty() ? -1 : places.at(member.parent);
    places[member.name] = static_cast<int>(limbs.size());
    limbs.push_back(LimbOf(member, parent, sizes));
  }
  return {plan.name, std::move(limbs)};
}

BodyModel LoadBody(const std::filesystem::path& path, const Sizes& sizes) {
  const BodyPlan plan = LoadBodyPlan(path);
  try {
    return Build(plan, sizes);
  } catch (const LimbFault& fault) {
    throw config::ConfigError(config::PlaceOf(path, KeyOf(plan, fault)) + ": " + fault.what());
  } catch (const config::ConfigError& error) {
    throw config::ConfigError(config::PlaceOf(path, "limbs") + ": " + error.what());
  }
}

}  // namespace deixis::body_model
