#include "services/pose_fitter/trainer/body_training.h"

#include <algorithm>
#include <cmath>

#include "common/anthropometry/person_estimate.h"
#include "common/config/config.h"
#include "services/pose_fitter/trainer/marker_pose.h"

namespace deixis::pose_fitter {
namespace {

using anthropometry::EstimatePerson;
using body_model::BodyModel;
using body_model::BodyPlan;
using Eigen::Vector3d;

constexpr int kUprightFrame = 0;       // Sequences begin with people who stand.
constexpr int kPixelStep = 5;          // Between surface points.
constexpr double kWorstPose_m = 0.02;  // Frames whose joints are not met teach nothing.
constexpr double kNothing_m = 5e-4;
constexpr std::size_t kFewPoints = 60;
constexpr int kRounds = 6;
constexpr double kFirstReach_m = 0.08, kReach_m = 0.05;

/// A joint that lies where the limb before it ends has the length of that limb.
const std::map<std::string, std::string> kSameAs = {
    {"abdomen.origin.z", "pelvis.length"},   {"chest.origin.z", "abdomen.length"},
    {"neck_base.origin.z", "chest.length"},  {"head.origin.z", "neck.length"},
    {"skull_cap.origin.z", "head.length"},   {"upper_arm.origin.z", "clavicle.length"},
    {"deltoid.origin.z", "clavicle.length"}, {"lower_arm.origin.z", "upper_arm.length"},
    {"hand.origin.z", "lower_arm.length"},   {"shank.origin.z", "thigh.length"},
    {"foot.origin.z", "shank.length"}};

double Median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

Lengths MedianTree(const std::vector<RenderedPerson>& sequences) {
  std::map<std::string, std::vector<double>> values;
  for (const RenderedPerson& sequence : sequences) {
    for (const auto& [name, length_m] : JointTree(sequence, kUprightFrame)) {
      values[name].push_back(length_m);
    }
  }
  Lengths tree;
  for (const auto& [name, all] : values) tree[name] = Median(all);
  return tree;
}

void AddFrames(const RenderedPerson& sequence, const BodyModel& model, TrainedPerson& person,
               double& error_sum_m) {
  const auto places = PlaceMarkers(sequence, kUprightFrame, model);
  for (const int frame : sequence.depth_frames) {
    const Markers& markers = sequence.frames[static_cast<std::size_t>(frame)];
    const MarkerPose found = FindPose(model, places, markers);
    if (found.joint_error_m > kWorstPose_m) continue;
    error_sum_m += found.joint_error_m;
    person.frames.push_back({found.pose, ReadSurface(sequence, frame, kPixelStep)});
  }
}

/// The limb's plan, and of limbs on both sides whether it is the left one.
struct PlanLimb {
  const body_model::LimbPlan* plan = nullptr;
  bool is_left = false;
};

std::vector<PlanLimb> PlanLimbs(const BodyPlan& plan, const BodyModel& model) {
  std::map<std::string, PlanLimb> by_name;
  for (const body_model::LimbPlan& limb : plan.limbs) {
    by_name[limb.name] = {&limb, false};
    by_name["right_" + limb.name] = {&limb, false};
    by_name["left_" + limb.name] = {&limb, true};
  }
  std::vector<PlanLimb> limbs;
  for (const body_model::Limb& limb : model.limbs()) limbs.push_back(by_name.at(limb.name));
  return limbs;
}

void Store(const std::string& limb, const geometry::DegenerateCylinder& shape, Lengths& surface) {
  surface[limb + ".proximal.a"] = shape.a0_m;
  surface[limb + ".proximal.b"] = shape.b0_m;
  surface[limb + ".proximal.x"] = shape.centre0_m.x();
  surface[limb + ".proximal.y"] = shape.centre0_m.y();
  surface[limb + ".distal.a"] = shape.a1_m;
  surface[limb + ".distal.b"] = shape.b1_m;
  surface[limb + ".distal.x"] = shape.centre1_m.x();
  surface[limb + ".distal.y"] = shape.centre1_m.y();
}

const geometry::DegenerateCylinder& ShapeOf(const BodyModel& model,
                                            const body_model::LimbPlan& limb) {
  const std::string prefix = limb.side == body_model::Side::kBoth ? "right_" : "";
  return model.limbs()[static_cast<std::size_t>(model.Find(prefix + limb.name).value())].shape;
}

/// Points of each limb of the plan, left ones mirrored.
std::map<std::string, std::vector<Vector3d>> PointsByLimb(const BodyPlan& plan,
                                                          const BodyModel& model,
                                                          const TrainedPerson& person,
                                                          double reach_m) {
  const std::vector<PlanLimb> limbs = PlanLimbs(plan, model);
  std::map<std::string, std::vector<Vector3d>> points;
  for (const LimbPoint& point : AssignPoints(model, person.frames, reach_m)) {
    if (point.limb < 0) continue;
    const PlanLimb& limb = limbs[static_cast<std::size_t>(point.limb)];
    Vector3d place_m = point.place_m;
    if (limb.is_left) place_m.y() = -place_m.y();
    points[limb.plan->name].push_back(place_m);
  }
  return points;
}

}  // namespace

TrainedPerson ReadPerson(const std::vector<RenderedPerson>& sequences, const BodyPlan& plan,
                         const anthropometry::Populations& populations) {
  TrainedPerson person;
  const RenderedPerson& first = sequences.at(0);
  person.id = first.id;
  person.stature_m = first.stature_m;
  const std::vector<anthropometry::MeasuredLength> stature{
      {"kph", first.stature_m, kStatureSigma_m * kStatureSigma_m}};
  person.by_stature = EstimatePerson(populations, stature).Sizes_m();
  person.by_stature_and_sex = EstimatePerson(populations, stature, first.sex).Sizes_m();
  person.tree = MedianTree(sequences);
  const BodyModel model = OnOwnJoints(plan, person);
  double error_sum_m = 0.0;
  for (const RenderedPerson& sequence : sequences) AddFrames(sequence, model, person, error_sum_m);
  if (person.frames.empty()) {
    throw config::ConfigError(person.id + ": no frame whose joints the model meets");
  }
  person.joint_error_m = error_sum_m / static_cast<double>(person.frames.size());
  return person;
}

void FitSurface(const BodyPlan& plan, TrainedPerson& person) {
  const BodyModel expected = OnOwnJoints(plan, person);
  for (int round = 0; round < kRounds; ++round) {
    const BodyModel model = OnOwnJoints(WithLengths(plan, person.surface), person);
    const auto points = PointsByLimb(plan, model, person, round < 2 ? kFirstReach_m : kReach_m);
    for (const body_model::LimbPlan& limb : plan.limbs) {
      const auto seen = points.find(limb.name);
      if (seen == points.end() || seen->second.size() < kFewPoints) continue;
      const bool is_middle = limb.side == body_model::Side::kOnce;
      Store(limb.name,
            FitCylinder(ShapeOf(expected, limb), ShapeOf(model, limb), seen->second, is_middle,
                        person.stature_m),
            person.surface);
    }
  }
}

std::vector<LearnedLength> LearnShares(const std::vector<TrainedPerson>& people) {
  std::map<std::string, std::vector<LengthSample>> samples;
  for (const TrainedPerson& person : people) {
    for (const Lengths* lengths : {&person.tree, &person.surface}) {
      for (const auto& [name, length_m] : *lengths) {
        samples[name].push_back({length_m, person.by_stature, person.by_stature_and_sex});
      }
    }
  }
  std::vector<LearnedLength> learned;
  for (const auto& [name, lengths] : samples) {
    const bool is_something = std::any_of(
        lengths.begin(), lengths.end(),
        [](const LengthSample& sample) { return std::abs(sample.length_m) > kNothing_m; });
    if (!is_something || lengths.size() < 2) continue;
    const auto same = kSameAs.find(name);
    const std::string& origin = same == kSameAs.end() ? name : same->second;
    const auto dot = origin.find('.');
    learned.push_back(
        {name, ChooseShare(lengths, CandidatesFor(origin.substr(0, dot), origin.substr(dot)))});
  }
  return learned;
}

BodyPlan WithShares(const BodyPlan& plan, const std::vector<LearnedLength>& learned) {
  BodyPlan changed = plan;
  for (body_model::LimbPlan& limb : changed.limbs) {
    limb.origin = {};  // What is zero is not learned.
    body_model::ForEachLength(limb, [&](const char* key, body_model::LengthPlan& length) {
      for (const LearnedLength& one : learned) {
        if (one.name == limb.name + "." + key) length = {one.share.term};
      }
    });
  }
  return changed;
}

BodyModel OnOwnJoints(const BodyPlan& plan, const TrainedPerson& person) {
  return body_model::Build(WithLengths(plan, person.tree), person.by_stature_and_sex);
}

}  // namespace deixis::pose_fitter
