#include "common/anatomy/joint_limits.h"

#include <algorithm>
#include <iterator>
#include <set>
#include <stdexcept>
#include <tuple>

#include "common/config/config.h"

namespace deixis::anatomy {
namespace {

struct LimitEntry : JointLimit {
  template <typename Visitor>
  void Visit(Visitor& v) {
    v("joint", joint);
    v("posture", posture);
    v("motion", motion);
    v("low_deg", low_deg);
    v("high_deg", high_deg);
    v("is_to_both_sides", is_to_both_sides);
    v("printed", printed);
    v("why", why);
  }
  void Validate() const {
    config::Faults faults;
    faults.Require(low_deg > 0.0 && low_deg <= 360.0, "low_deg", "must lie in 0..360");
    faults.Require(high_deg >= low_deg && high_deg <= 360.0, "high_deg",
                   "must lie between low_deg and 360");
    faults.ThrowIfAny();
  }
};

bool IsNamed(const std::vector<NamedTerm>& names, const std::string& name) {
  return std::any_of(names.begin(), names.end(),
                     [&name](const NamedTerm& entry) { return entry.name == name; });
}

struct LimitsFile {
  std::vector<NamedTerm> joints, motions;
  std::vector<LimitEntry> limits;

  template <typename Visitor>
  void Visit(Visitor& v) {
    v("joints", joints);
    v("motions", motions);
    v("limits", limits);
  }
  void Validate() const {
    config::Faults faults;
    faults.Require(!joints.empty(), "joints", "must name a joint");
    faults.Require(!limits.empty(), "limits", "must have a row");
    RequireOnce(joints, "joints", faults);
    RequireOnce(motions, "motions", faults);
    std::set<std::tuple<std::string, Posture, std::string>> rows;
    for (std::size_t i = 0; i < limits.size(); ++i) {
      const LimitEntry& row = limits[i];
      const std::string key = "limits[" + std::to_string(i) + "]";
      faults.Require(IsNamed(joints, row.joint), key + ".joint", "is not among the joints");
      faults.Require(IsNamed(motions, row.motion), key + ".motion", "is not among the motions");
      faults.Require(rows.emplace(row.joint, row.posture, row.motion).second, key,
                     "is there already: " + row.joint + " " + row.motion);
    }
    faults.ThrowIfAny();
  }

 private:
  static void RequireOnce(const std::vector<NamedTerm>& names, const std::string& key,
                          config::Faults& faults) {
    std::set<std::string> seen;
    for (std::size_t i = 0; i < names.size(); ++i) {
      faults.Require(seen.insert(names[i].name).second, key + "[" + std::to_string(i) + "].name",
                     "'" + names[i].name + "' is there already");
    }
  }
};

}  // namespace

JointLimits JointLimits::Load(const std::filesystem::path& path) {
  const auto file = config::Load<LimitsFile>(path);
  JointLimits limits;
  limits.joints_ = file.joints;
  limits.motions_ = file.motions;
  limits.rows_.assign(file.limits.begin(), file.limits.end());
  return limits;
}

std::vector<JointLimit> JointLimits::Of(const std::string& name) const {
  std::vector<JointLimit> found;
  for (const NamedTerm& joint : joints_) {
    if (joint.name != name && !joint.names.Match(name)) continue;
    std::copy_if(rows_.begin(), rows_.end(), std::back_inserter(found),
                 [&joint](const JointLimit& row) { return row.joint == joint.name; });
  }
  return found;
}

const JointLimit& JointLimits::At(const std::string& joint, Posture posture,
                                  const std::string& motion) const {
  for (const JointLimit& row : rows_) {
    if (row.joint == joint && row.posture == posture && row.motion == motion) return row;
  }
  throw std::logic_error("JointLimits: no row for " + joint + " " + motion);
}

}  // namespace deixis::anatomy
