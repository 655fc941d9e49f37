#pragma once
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "common/body_model/body_model.h"

namespace deixis::body_model {

/// Sizes of one person by the measures' abbreviations (kph = stature, oal = upper arm length ...),
/// metres.
using Sizes = std::map<std::string, double>;

/// Part of a length: metres, or a share of a measure.
struct Term {
  std::string of;      ///< Abbreviation of a measure; empty = `metres` counts.
  double share = 1.0;  ///< Of that measure.
  double metres = 0.0;
  /// How people of the same measure differ, one standard deviation, in the unit of what counts of
  /// the two above; 0 = not known.
  double spread = 0.0;

  template <typename Visitor>
  void Visit(Visitor& v) {
    v("of", of);
    v("share", share);
    v("metres", metres);
    v("spread", spread);
  }
  void Validate() const;  ///< Throws FaultsFound.
};

/// The sum of its terms; none = 0.
using LengthPlan = std::vector<Term>;

struct EllipsePlan {
  LengthPlan a;  ///< Semi-axis along the limb's x.
  LengthPlan b;  ///< Along y.
  LengthPlan x;  ///< Of the centre, beside the bone.
  LengthPlan y;

  template <typename Visitor>
  void Visit(Visitor& v) {
    v("a", a);
    v("b", b);
    v("x", x);
    v("y", y);
  }
};

struct PointPlan {
  LengthPlan x, y, z;

  template <typename Visitor>
  void Visit(Visitor& v) {
    v("x", x);
    v("y", y);
    v("z", z);
  }
};

struct AnglePlan {
  std::string name;
  DofKind kind = DofKind::kHinge;
  std::vector<double> axis;  ///< In the limb's rest frame, of any length.
  double min_deg = 0.0;
  double max_deg = 0.0;

  template <typename Visitor>
  void Visit(Visitor& v) {
    v("name", name);
    v("kind", kind);
    v("axis", axis);
    v("min_deg", min_deg);
    v("max_deg", max_deg);
  }
  void Validate() const;  ///< Throws FaultsFound.
};

/// Whether a limb occurs once or on either side of the body.
enum class Side {
  kOnce,
  kBoth  ///< Described as the right one; `right_` and `left_` go before its name.
};

inline auto EnumNames(DofKind) {
  return std::vector<std::pair<std::string, DofKind>>{
      {"hinge", DofKind::kHinge}, {"swing", DofKind::kSwing}, {"twist", DofKind::kTwist}};
}
inline auto EnumNames(Side) {
  return std::vector<std::pair<std::string, Side>>{{"once", Side::kOnce}, {"both", Side::kBoth}};
}

struct LimbPlan {
  std::string name;
  std::string parent;  ///< Empty = the base limb. Of a limb on both sides, that of the same side.
  Side side = Side::kOnce;
  PointPlan origin;            ///< The proximal joint in the parent's frame.
  std::vector<double> rest_z;  ///< Direction of the limb at zero angles, in the parent's frame.
  std::vector<double> rest_x;  ///< Its x axis, likewise; made perpendicular to rest_z.
  LengthPlan length;
  EllipsePlan proximal;
  EllipsePlan distal;
  std::vector<AnglePlan> angles;

  template <typename Visitor>
  void Visit(Visitor& v) {
    v("name", name);
    v("parent", parent);
    v("side", side);
    v("origin", origin);
    v("rest_z", rest_z);
    v("rest_x", rest_x);
    v("length", length);
    v("proximal", proximal);
    v("distal", distal);
    v("angles", angles);
  }
  void Validate() const;  ///< Throws FaultsFound.
};

/// Calls `function(key, length)` for all lengths of a limb's plan, by their keys in the file.
template <typename Plan, typename Function>
void ForEachLength(Plan& limb, Function&& function) {
  function("origin.x", limb.origin.x);
  function("origin.y", limb.origin.y);
  function("origin.z", limb.origin.z);
  function("length", limb.length);
  function("proximal.a", limb.proximal.a);
  function("proximal.b", limb.proximal.b);
  function("proximal.x", limb.proximal.x);
  function("proximal.y", limb.proximal.y);
  function("distal.a", limb.distal.a);
  function("distal.b", limb.distal.b);
  function("distal.x", limb.distal.x);
  function("distal.y", limb.distal.y);
}

/// A tree of limbs whose sizes follow from a person's measures: a file of config/body_models.
struct BodyPlan {
  std::string name;
  std::vector<LimbPlan> limbs;  ///< In any order.

  template <typename Visitor>
  void Visit(Visitor& v) {
    v("name", name);
    v("limbs", limbs);
  }
  void Validate() const;  ///< Throws FaultsFound.
};

/// Reads a file of config/body_models. Throws ConfigError naming file, line and key.
BodyPlan LoadBodyPlan(const std::filesystem::path& path);

/// The text of such a file, shares rounded to 0.0001, metres to 0.1 mm, degrees to 0.01.
std::string ToYaml(const BodyPlan& plan);

/// Measures that the plan's lengths are shares of.
std::vector<std::string> MeasuresOf(const BodyPlan& plan);

/// The model of a person of these sizes. Throws ConfigError naming the limb when a parent is not
/// known, limbs form a circle, there are two base limbs or none, a measure is missing in `sizes`,
/// and as BodyModel does.
BodyModel Build(const BodyPlan& plan, const Sizes& sizes);

/// Both at once; what is wrong is told by file, line and key.
BodyModel LoadBody(const std::filesystem::path& path, const Sizes& sizes);

}  // namespace deixis::body_model
