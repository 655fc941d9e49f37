#include "services/pose_fitter/trainer/share_choice.h"

#include <cmath>
#include <map>
#include <stdexcept>

namespace deixis::pose_fitter {
namespace {

using body_model::Sizes;

constexpr double kWorthwhile = 0.9;  // Of the error by the stature.

double ShareOf(const std::vector<LengthSample>& people, const std::string& measure,
               std::size_t left_out) {
  double product = 0.0, square = 0.0;
  for (std::size_t i = 0; i < people.size(); ++i) {
    if (i == left_out) continue;
    for (const Sizes* sizes : {&people[i].by_stature, &people[i].by_stature_and_sex}) {
      const double size_m = sizes->at(measure);
      product += size_m * people[i].length_m;
      square += size_m * size_m;
    }
  }
  return product / square;
}

double Spread(const std::vector<LengthSample>& people, const std::string& measure, double share) {
  double square = 0.0;
  for (const LengthSample& person : people) {
    const double own = person.length_m / person.by_stature_and_sex.at(measure);
    square += (own - share) * (own - share);
  }
  return std::sqrt(square / static_cast<double>(people.size() - 1));
}

double Combined(const LengthShare& share) {
  return std::hypot(share.error_by_stature_m, share.error_by_stature_and_sex_m);
}

}  // namespace

LengthShare FitShare(const std::vector<LengthSample>& people, const std::string& measure) {
  if (people.size() < 2) throw std::invalid_argument("FitShare: needs two people");
  LengthShare fitted;
  double square = 0.0, square_with_sex = 0.0;
  for (std::size_t i = 0; i < people.size(); ++i) {
    const double share = ShareOf(people, measure, i);
    const LengthSample& person = people[i];
    square += std::pow(share * person.by_stature.at(measure) - person.length_m, 2);
    square_with_sex += std::pow(share * person.by_stature_and_sex.at(measure) - person.length_m, 2);
  }
  const auto count = static_cast<double>(people.size());
  fitted.error_by_stature_m = std::sqrt(square / count);
  fitted.error_by_stature_and_sex_m = std::sqrt(square_with_sex / count);
  const double share = ShareOf(people, measure, people.size());
  fitted.term = {measure, share, 0.0, Spread(people, measure, share)};
  return fitted;
}

LengthShare ChooseShare(const std::vector<LengthSample>& people,
                        const std::vector<std::string>& candidates) {
  LengthShare best = FitShare(people, candidates.front());
  const double enough_m = kWorthwhile * Combined(best);
  for (const std::string& measure : candidates) {
    const LengthShare other = FitShare(people, measure);
    if (Combined(other) < enough_m && Combined(other) < Combined(best)) best = other;
  }
  return best;
}

std::vector<std::string> CandidatesFor(const std::string& limb, const std::string& key) {
  using Names = std::vector<std::string>;
  const bool is_across = key.find(".a") != std::string::npos || key.find(".b") != std::string::npos;
  static const std::map<std::string, Names> kGirths = {
      {"pelvis", {"hueb", "buttock_depth", "waist_breadth", "waist_depth"}},
      {"abdomen", {"waist_breadth", "waist_depth", "chest_breadth", "chest_depth"}},
      {"chest", {"chest_breadth", "chest_depth", "biacromial_breadth"}},
      {"neck_base", {"chest_breadth", "neck_girth", "biacromial_breadth"}},
      {"neck", {"neck_girth"}},
      {"clavicle", {"chest_depth", "upper_arm_girth"}},
      {"deltoid", {"chest_depth", "upper_arm_girth"}},
      {"upper_arm", {"upper_arm_girth", "forearm_girth"}},
      {"lower_arm", {"forearm_girth", "wrist_girth"}},
      {"hand", {"hdb", "wrist_girth"}},
      {"thigh", {"thigh_girth", "lower_thigh_girth"}},
      {"shank", {"calf_girth", "ankle_girth"}},
      {"foot", {"fh", "foot_breadth"}}};
  static const std::map<std::string, Names> kLengths = {
      {"pelvis", {"stl", "hueb"}},
      {"abdomen", {"stl", "shas"}},
      {"chest", {"stl", "shas"}},
      {"clavicle", {"stl", "shas", "biacromial_breadth"}},
      {"upper_arm", {"oal", "ala", "biacromial_breadth"}},
      {"lower_arm", {"ual", "oal", "ala"}},
      {"hand", {"hdl", "ual"}},
      {"thigh", {"trochanter_height", "hueb"}},
      {"shank", {"knh", "usl", "trochanter_height"}},
      {"foot", {"fl", "knh", "usl"}}};
  Names names{"kph"};
  const auto& table = is_across ? kGirths : kLengths;
  const auto found = table.find(limb);
  if (found != table.end()) names.insert(names.end(), found->second.begin(), found->second.end());
  return names;
}

}  // namespace deixis::pose_fitter
