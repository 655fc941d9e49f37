#pragma once
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "common/motion/skeleton.h"

namespace deixis::retargeting {

/// How a limb stands in the zero pose of a file.
enum class Stance {
  kBone,    ///< Along its bone, its front where the person's is.
  kNeutral  ///< As the model's standing limb does on its parent: trunk, head, feet.
};

enum class Sides { kOnce, kBoth };

inline auto EnumNames(Stance) {
  return std::vector<std::pair<std::string, Stance>>{{"bone", Stance::kBone},
                                                     {"neutral", Stance::kNeutral}};
}
inline auto EnumNames(Sides) {
  return std::vector<std::pair<std::string, Sides>>{{"once", Sides::kOnce}, {"both", Sides::kBoth}};
}

struct LimbSource {
  std::string limb;
  Sides side = Sides::kOnce;
  std::string joint;      ///< Turns the limb.
  std::string starts_at;  ///< Empty = `joint`.
  std::string ends_at;    ///< Empty = the end of `joint`'s last bone.
  std::string after;      ///< Limb where it starts when the model lacks that one.
  Stance stance = Stance::kBone;
  bool is_aimed = false;
  bool is_straight = false;  ///< Without twist against its parent in the zero pose.

  template <typename Visitor>
  void Visit(Visitor& v) {
    v("limb", limb);
    v("side", side);
    v("joint", joint);
    v("starts_at", starts_at);
    v("ends_at", ends_at);
    v("after", after);
    v("stance", stance);
    v("is_aimed", is_aimed);
    v("is_straight", is_straight);
  }
  void Validate() const;  ///< Throws FaultsFound.
};

/// A file of config/skeletons: which limb turns with which joint of a motion file.
struct SkeletonMap {
  std::string name;
  std::string right, left;  ///< In place of {side}.
  std::vector<LimbSource> limbs;

  template <typename Visitor>
  void Visit(Visitor& v) {
    v("name", name);
    v("right", right);
    v("left", left);
    v("limbs", limbs);
  }
  void Validate() const;  ///< Throws FaultsFound.
};

/// Reads a file of config/skeletons. Throws ConfigError naming file, line and key.
SkeletonMap LoadSkeletonMap(const std::filesystem::path& path);

/// All files *.yaml of a folder, by name. Throws ConfigError, also when there are none.
std::vector<SkeletonMap> LoadSkeletonMaps(const std::filesystem::path& folder);

/// One limb of a model and the joints of a skeleton, -1 = none.
struct DrivenLimb {
  std::string limb;  ///< With its side.
  std::string after;
  int joint = -1, starts_at = -1, ends_at = -1;
  Stance stance = Stance::kBone;
  bool is_aimed = false;
  bool is_straight = false;
};

/// The limbs of the map whose joints the skeleton has.
std::vector<DrivenLimb> Bind(const SkeletonMap& map, const motion::Skeleton& skeleton);

/// Of several maps the one that binds most limbs. Throws ConfigError listing the skeleton's joints
/// when none binds both thighs or both upper arms.
const SkeletonMap& BestMap(const std::vector<SkeletonMap>& maps, const motion::Skeleton& skeleton);

}  // namespace deixis::retargeting
