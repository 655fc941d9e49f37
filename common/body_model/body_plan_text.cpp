// A plan as the text of a file of config/body_models.
#include <cmath>
#include <cstdio>
#include <cstdlib>

#include "common/body_model/body_plan.h"

namespace deixis::body_model {
namespace {

std::string Rounded(double value, const char* format) {
  char text[32];
  std::snprintf(text, sizeof(text), format, value);
  // The shortest text of the rounded number, without "-0".
  std::string shortest(text);
  if (shortest.find('.') != std::string::npos) {
    shortest.erase(shortest.find_last_not_of('0') + 1);
    if (shortest.back() == '.') shortest.pop_back();
  }
  return shortest == "-0" ? "0" : shortest;
}

std::string Share(double value) { return Rounded(value, "%.4f"); }
std::string Degrees(double value) { return Rounded(value, "%.2f"); }

std::string TextOf(const Term& term) {
  std::string text = "{";
  if (term.of.empty()) {
    text += "metres: " + Share(term.metres);
  } else {
    text += "of: " + term.of;
    if (term.share != 1.0) text += ", share: " + Share(term.share);
  }
  if (term.spread != 0.0) text += ", spread: " + Share(term.spread);
  return text + "}";
}

std::string TextOf(const LengthPlan& plan) {
  std::string text = "[";
  for (const Term& term : plan) text += (text.size() > 1 ? ", " : "") + TextOf(term);
  return text + "]";
}

std::string TextOf(const std::vector<double>& direction) {
  std::string text = "[";
  for (const double value : direction) text += (text.size() > 1 ? ", " : "") + Share(value);
  return text + "]";
}

/// "{a: [...], b: [...]}" of the lengths that are given.
class Mapping {
 public:
  Mapping& operator()(const char* key, const LengthPlan& plan) {
    if (!plan.empty()) text_ += (text_.empty() ? "" : ", ") + (key + (": " + TextOf(plan)));
    return *this;
  }
  std::string text() const { return "{" + text_ + "}"; }

 private:
  std::string text_;
};

std::string TextOf(const EllipsePlan& plan) {
  return Mapping()("a", plan.a)("b", plan.b)("x", plan.x)("y", plan.y).text();
}

template <typename Value>
std::string NameOf(Value value) {
  for (const auto& [name, candidate] : EnumNames(value)) {
    if (candidate == value) return name;
  }
  std::abort();
}

std::string TextOf(const AnglePlan& angle) {
  return "{name: " + angle.name + ", kind: " + NameOf(angle.kind) +
         ", axis: " + TextOf(angle.axis) + ", min_deg: " + Degrees(angle.min_deg) +
         ", max_deg: " + Degrees(angle.max_deg) + "}";
}

std::string PlaceOf(const LimbPlan& limb) {
  std::string text = "    parent: " + limb.parent + "\n";
  if (limb.side == Side::kBoth) text += "    side: " + NameOf(limb.side) + "\n";
  const std::string origin =
      Mapping()("x", limb.origin.x)("y", limb.origin.y)("z", limb.origin.z).text();
  if (origin != "{}") text += "    origin: " + origin + "\n";
  text += "    rest_z: " + TextOf(limb.rest_z) + "\n";
  return text + "    rest_x: " + TextOf(limb.rest_x) + "\n";
}

std::string TextOf(const LimbPlan& limb) {
  std::string text = "  - name: " + limb.name + "\n";
  if (!limb.parent.empty()) text += PlaceOf(limb);
  text += "    length: " + TextOf(limb.length) + "\n";
  text += "    proximal: " + TextOf(limb.proximal) + "\n";
  text += "    distal: " + TextOf(limb.distal) + "\n";
  if (limb.angles.empty()) return text;
  text += "    angles:\n";
  for (const AnglePlan& angle : limb.angles) text += "      - " + TextOf(angle) + "\n";
  return text;
}

}  // namespace

std::string ToYaml(const BodyPlan& plan) {
  std::string text = "name: " + plan.name + "\nlimbs:\n";
  for (const LimbPlan& limb : plan.limbs) text += TextOf(limb);
  return text;
}

}  // namespace deixis::body_model
