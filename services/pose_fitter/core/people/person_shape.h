#pragma once
#include <cstdint>
#include <vector>

#include "common/config/config.h"
#include "services/pose_fitter/core/people/surface_pieces.h"

namespace deixis::pose_fitter {

struct PersonShapeConfig {
  double least_area_m2 = 0.10;  ///< Of a person that must be seen, head on.
  double largest_area_m2 = 1.5;
  double lowest_top_m = 0.5;     ///< Height of the highest part: of a child on the floor
  double highest_top_m = 2.25;   ///< and of a tall person.
  double largest_span_m = 2.2;   ///< Along the floor: both arms stretched out, or lying.
  double largest_depth_m = 1.5;  ///< Across that.
  double least_height_m = 0.3;   ///< From the lowest to the highest part.
  double flat_m = 0.012;         ///< What lies so near to a plane, noise apart, is furniture.
  double largest_step_m = 0.35;  ///< In depth between parts of one person that meet in the image.

  template <typename Visitor>
  void Visit(Visitor& v) {
    v("least_area_m2", least_area_m2);
    v("largest_area_m2", largest_area_m2);
    v("lowest_top_m", lowest_top_m);
    v("highest_top_m", highest_top_m);
    v("largest_span_m", largest_span_m);
    v("largest_depth_m", largest_depth_m);
    v("least_height_m", least_height_m);
    v("flat_m", flat_m);
    v("largest_step_m", largest_step_m);
  }
  void Validate() const;
};

/// Whether a surface, or several that belong together, may be one person.
bool MayBePerson(const PersonShapeConfig& config, const SurfaceShape& shape);

/// Whether no person may be so large; parts of people are smaller.
bool IsTooLarge(const PersonShapeConfig& config, const SurfaceShape& shape);

/// Whether it lies in a plane: a wall, a door, a table top.
bool IsFlat(const PersonShapeConfig& config, const SurfaceShape& shape);

/// Puts pieces together that may be parts of one person. Takes its memory once.
class PersonGroups {
 public:
  PersonGroups();
  /// `owners`: per piece, whose it is known to be, 0 = not known. Pieces of one owner are one group
  /// of whatever shape; those of two never are.
  void Form(const PersonShapeConfig& config, const SurfacePieces& pieces,
            const std::vector<std::uint8_t>& owners);

  int count() const { return static_cast<int>(shapes_.size()); }
  const SurfaceShape& shape(int group) const { return shapes_[static_cast<std::size_t>(group)]; }
  /// Whose a group is known to be, 0 = not known.
  int OwnerOf(int group) const { return owners_[static_cast<std::size_t>(group)]; }
  /// The group of a piece, -1 = nobody.
  int GroupOf(int piece) const { return groups_[static_cast<std::size_t>(piece)]; }
  /// Of a piece: its group where it is the largest one of that, -1 else. What hangs on tells less.
  const std::vector<int>& group_of_core() const { return group_of_core_; }
  /// The largest piece of each group.
  const std::vector<SurfaceShape>& cores() const { return cores_; }

 private:
  int Root(int piece);
  bool MayJoin(const PersonShapeConfig& config, int a, int b) const;
  void Join(int a, int b);
  void JoinOwned(const std::vector<std::uint8_t>& owners);
  void JoinPieces(const PersonShapeConfig& config, const SurfacePieces& pieces);
  void Number(const PersonShapeConfig& config, const SurfacePieces& pieces);

  struct Pair {
    float cost;
    int a, b;
  };
  std::vector<Pair> pairs_;
  std::vector<int> roots_;
  std::vector<std::uint8_t> owner_of_root_;
  std::vector<std::uint8_t> owners_;  ///< Per group.
  std::vector<int> groups_;
  std::vector<SurfaceShape> joined_;  ///< Per root.
  std::vector<SurfaceShape> shapes_;
  std::vector<SurfaceShape> cores_;
  std::vector<int> group_of_core_;
};

}  // namespace deixis::pose_fitter
