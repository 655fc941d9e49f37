#include "services/pose_fitter/trainer/calibration_score.h"

#include <algorithm>

#include "common/anthropometry/person_estimate.h"
#include "services/pose_fitter/core/shape/shape_calibration.h"

namespace deixis::pose_fitter {
namespace {

using body_model::BodyModel;

constexpr std::size_t kMostFrames = 60;
constexpr std::size_t kMostPoints = 500;  // Of a frame.
constexpr double kReach_m = 0.08;
constexpr int kRounds = 2;
constexpr double kSigma_m = 0.01;  // True depth, but limbs are no cylinders.
constexpr const char* kLimbs[] = {"upper_arm", "lower_arm", "thigh", "shank", "clavicle"};

/// At most `most` of them, evenly.
template <typename T>
std::vector<T> Thinned(const std::vector<T>& all, std::size_t most) {
  const std::size_t step = (all.size() + most - 1) / most;
  std::vector<T> some;
  for (std::size_t i = 0; i < all.size(); i += std::max<std::size_t>(step, 1)) {
    some.push_back(all[i]);
  }
  return some;
}

std::vector<ShapeFrame> ShapeFrames(const BodyModel& model,
                                    const std::vector<PosedSurface>& surfaces) {
  std::vector<ShapeFrame> frames;
  for (const PosedSurface& surface : surfaces) {
    ShapeFrame frame{surface.pose, {}};
    const auto limbs = AssignPoints(model, {surface}, kReach_m);
    for (std::size_t i = 0; i < limbs.size(); ++i) {
      if (limbs[i].limb < 0) continue;
      frame.points.push_back({surface.points[i].point_m, kSigma_m, limbs[i].limb});
    }
    frames.push_back(std::move(frame));
  }
  return frames;
}

std::map<std::string, double> LengthErrors(const BodyModel& model, const Lengths& tree) {
  std::map<std::string, double> errors_m;
  for (const std::string limb : kLimbs) {
    const auto index = static_cast<std::size_t>(model.Find("right_" + limb).value());
    errors_m[limb] = model.limbs()[index].shape.length_m - tree.at(limb + ".length");
  }
  return errors_m;
}

}  // namespace

CalibrationScore ScoreCalibration(const body_model::BodyPlan& plan_of_others,
                                  const TrainedPerson& person,
                                  const anthropometry::Populations& populations) {
  const auto estimate = anthropometry::EstimatePerson(
      populations, {{"kph", person.stature_m, kStatureSigma_m * kStatureSigma_m}});
  const BodyModel expected = body_model::Build(plan_of_others, estimate.Sizes_m());
  std::vector<PosedSurface> surfaces = Thinned(person.frames, kMostFrames);
  for (PosedSurface& surface : surfaces) surface.points = Thinned(surface.points, kMostPoints);
  CalibrationScore score;
  score.frames = static_cast<int>(surfaces.size());
  score.expected_error_m = LengthErrors(expected, person.tree);
  score.expected_rms_m = MeasureSurface(expected, surfaces).rms_m;
  const ShapeParameters parameters(expected, plan_of_others, estimate);
  // Which limb a point belongs to follows from the shape, too.
  BodyModel model = expected;
  ShapeResult result;
  for (int round = 0; round < kRounds; ++round) {
    result = CalibrateShape(parameters, ShapeFrames(model, surfaces), {});
    score.is_refused = !result.shape;
    if (score.is_refused) return score;
    model = result.shape->model;
    for (std::size_t i = 0; i < surfaces.size(); ++i) surfaces[i].pose = result.shape->poses[i];
  }
  score.calibrated_error_m = LengthErrors(result.shape->model, person.tree);
  score.calibrated_rms_m = MeasureSurface(result.shape->model, surfaces).rms_m;
  return score;
}

}  // namespace deixis::pose_fitter
