#include "common/retargeting/skeleton_map.h"

#include <algorithm>
#include <cctype>
#include <set>

#include "common/config/config.h"

namespace deixis::retargeting {
namespace {

constexpr const char* kSide = "{side}";

std::string WithSide(std::string name, const std::string& side) {
  const auto at = name.find(kSide);
  if (at != std::string::npos) name.replace(at, std::string(kSide).size(), side);
  return name;
}

/// Lower case, without what stands before a colon.
std::string Plain(const std::string& name) {
  std::string plain = name.substr(name.rfind(':') + 1);
  std::transform(plain.begin(), plain.end(), plain.begin(),
                 [](unsigned char letter) { return static_cast<char>(std::tolower(letter)); });
  return plain;
}

int FindJoint(const motion::Skeleton& skeleton, const std::string& name) {
  for (std::size_t i = 0; i < skeleton.joints.size(); ++i) {
    if (Plain(skeleton.joints[i].name) == Plain(name)) return static_cast<int>(i);
  }
  return -1;
}

DrivenLimb BindOne(const LimbSource& source, const motion::Skeleton& skeleton,
                   const std::string& limb_prefix, const std::string& side) {
  const auto find = [&](const std::string& name) {
    return name.empty() ? -1 : FindJoint(skeleton, WithSide(name, side));
  };
  DrivenLimb driven;
  driven.limb = limb_prefix + source.limb;
  driven.after = source.after;
  driven.joint = find(source.joint);
  driven.starts_at = source.starts_at.empty() ? driven.joint : find(source.starts_at);
  driven.ends_at = find(source.ends_at);
  driven.stance = source.stance;
  driven.is_aimed = source.is_aimed;
  driven.is_straight = source.is_straight;
  return driven;
}

bool HasAnArmOrALeg(const std::vector<DrivenLimb>& limbs) {
  return std::any_of(limbs.begin(), limbs.end(), [](const DrivenLimb& driven) {
    const std::string& name = driven.limb;
    return name.find("_thigh") != std::string::npos || name.find("_upper_arm") != std::string::npos;
  });
}

std::string JointsOf(const motion::Skeleton& skeleton) {
  constexpr std::size_t kMost = 60;
  std::string names;
  for (std::size_t i = 0; i < std::min(skeleton.joints.size(), kMost); ++i) {
    names += (i == 0 ? "" : ", ") + skeleton.joints[i].name;
  }
  return names + (skeleton.joints.size() > kMost ? " ..." : "");
}

}  // namespace

void LimbSource::Validate() const {
  config::Faults faults;
  faults.Require(!limb.empty(), "limb", "must not be empty");
  faults.Require(!joint.empty(), "joint", "must not be empty");
  faults.Require(side == Sides::kOnce || joint.find(kSide) != std::string::npos, "joint",
                 "must hold {side} of a limb on both sides");
  faults.Require(ends_at.empty() || ends_at != (starts_at.empty() ? joint : starts_at), "ends_at",
                 "must be another joint than where the limb starts");
  faults.ThrowIfAny();
}

void SkeletonMap::Validate() const {
  config::Faults faults;
  faults.Require(!name.empty(), "name", "must not be empty");
  faults.Require(!limbs.empty(), "limbs", "must name a limb");
  const bool has_sides = std::any_of(
      limbs.begin(), limbs.end(), [](const LimbSource& limb) { return limb.side == Sides::kBoth; });
  faults.Require(!has_sides || right != left, "left", "must not be the same as 'right'");
  std::set<std::string> seen;
  for (std::size_t i = 0; i < limbs.size(); ++i) {
    const bool is_once = limbs[i].side == Sides::kOnce;
    for (const char* prefix : is_once ? std::vector{""} : std::vector{"right_", "left_"}) {
      const std::string limb = prefix + limbs[i].limb;
      faults.Require(seen.insert(limb).second, "limbs[" + std::to_string(i) + "].limb",
                     "'" + limb + "' is there already");
    }
  }
  faults.ThrowIfAny();
}

SkeletonMap LoadSkeletonMap(const std::filesystem::path& path) {
  return config::Load<SkeletonMap>(path);
}

std::vector<SkeletonMap> LoadSkeletonMaps(const std::vector<std::filesystem::path>& files) {
  std::vector<SkeletonMap> maps;
  for (const std::filesystem::path& file : files) maps.push_back(LoadSkeletonMap(file));
  return maps;
}

std::vector<DrivenLimb> Bind(const SkeletonMap& map, const motion::Skeleton& skeleton) {
  std::vector<DrivenLimb> limbs;
  const auto add = [&](const LimbSource& source, const char* prefix, const std::string& side) {
    DrivenLimb driven = BindOne(source, skeleton, prefix, side);
    if (driven.joint >= 0 && driven.starts_at >= 0) limbs.push_back(std::move(driven));
  };
  for (const LimbSource& source : map.limbs) {
    if (source.side == Sides::kOnce) {
      add(source, "", "");
    } else {
      add(source, "right_", map.right);
      add(source, "left_", map.left);
    }
  }
  return limbs;
}

const SkeletonMap& BestMap(const std::vector<SkeletonMap>& maps, const motion::Skeleton& skeleton) {
  const SkeletonMap* best = nullptr;
  std::size_t most = 0;
  for (const SkeletonMap& map : maps) {
    const auto limbs = Bind(map, skeleton);
    if (limbs.size() <= most || !HasAnArmOrALeg(limbs)) continue;
    most = limbs.size();
    best = &map;
  }
  if (best != nullptr) return *best;
  throw config::ConfigError(
      "no file of config/skeletons names a thigh or an upper arm of this skeleton; its joints: " +
      JointsOf(skeleton) + "; describe them in a file of config/skeletons");
}

}  // namespace deixis::retargeting
