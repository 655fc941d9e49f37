#include "services/viewer/core/body_overlay.h"

#include <algorithm>
#include <array>
#include <string_view>

#include "services/viewer/core/limb_outline.h"

namespace deixis::viewer {
namespace {

using body_model::BodyState;
using body_model::LimbPose;
using body_model::LimbState;
using body_model::PersonModel;
using body_model::TrackedBody;

// Blue, green, red; neighbours are told apart by brightness, too.
const std::array<cv::Scalar, 8> kPeopleColours{
    cv::Scalar(255, 200, 60), cv::Scalar(70, 140, 255), cv::Scalar(120, 255, 180),
    cv::Scalar(230, 90, 230), cv::Scalar(80, 230, 255), cv::Scalar(255, 120, 120),
    cv::Scalar(180, 255, 90), cv::Scalar(170, 170, 255)};
const cv::Scalar kLostColour(170, 170, 170);
const cv::Scalar kSpreadColour(255, 255, 255);

constexpr double kFilled = 0.22;  // Opacity of a limb that is measured.
constexpr double kRod_m = 0.012;  // Radius of a limb of which no shape is known.
constexpr double kShortest_m = 1e-3;
constexpr double kLabelSize = 0.85;
constexpr std::string_view kLowerArm = "lower_arm";  // Its distal end is the wrist.

const PersonModel* ModelOf(const TrackedBody& body, const Scene& scene) {
  for (const PersonModel& model : scene.models) {
    const bool fits = model.body.limbs().size() == body.limbs.size();
    if (fits && model.body.id() == body.model_id) return &model;
  }
  return nullptr;
}

geometry::DegenerateCylinder RodOf(const LimbPose& limb) {
  const double length_m = std::max(kShortest_m, (limb.distal_m - limb.proximal_m).norm());
  return {kRod_m, kRod_m, kRod_m, kRod_m, length_m};
}

cv::Scalar ColourOf(const TrackedBody& body) {
  const auto number = static_cast<std::size_t>(std::max(0, body.person_id));
  return kPeopleColours[number % kPeopleColours.size()];
}

/// Draws one person's limbs, and remembers where the highest of them is.
class BodyPen {
 public:
  BodyPen(const TrackedBody& body, const PersonModel* model,
          const geometry::CameraCalibration& camera, Canvas& canvas)
      : body_(body), model_(model), camera_(camera), canvas_(canvas) {}

  void DrawLimbs() {
    for (std::size_t i = 0; i < body_.limbs.size(); ++i) DrawLimb(i);
  }

  void DrawWrists() {
    if (model_ == nullptr || body_.state == BodyState::kLost) return;
    for (std::size_t i = 0; i < body_.limbs.size(); ++i) {
      const LimbPose& limb = body_.limbs[i];
      const std::string_view name = model_->body.limbs()[i].name;
      if (name.find(kLowerArm) == name.npos || limb.state == LimbState::kLost) continue;
      canvas_.DrawOutline(SpreadOf(limb.distal_m, limb.distal_covariance_m2, camera_),
                          kSpreadColour, 1.2, Stroke::kFull);
    }
  }

  void DrawName() {
    if (!top_px_) return;
    std::string text = "person " + std::to_string(body_.person_id);
    if (body_.state == BodyState::kLost) text += ", lost";
    canvas_.DrawText(text, *top_px_, Anchor::kAbove, kLabelSize, ColourOf(body_));
  }

 private:
  bool IsLost(const LimbPose& limb) const {
    return body_.state == BodyState::kLost || limb.state == LimbState::kLost;
  }

  void DrawLimb(std::size_t index) {
    const LimbPose& limb = body_.limbs[index];
    const bool has_shape = model_ != nullptr && !IsLost(limb);
    const auto outline = OutlineOf(has_shape ? model_->body.limbs()[index].shape : RodOf(limb),
                                   limb.frame_from_limb, camera_);
    for (const Eigen::Vector2d& corner : outline) {
      if (!top_px_ || corner.y() < top_px_->y()) top_px_ = corner;
    }
    DrawAs(limb, outline);
  }

  void DrawAs(const LimbPose& limb, const std::vector<Eigen::Vector2d>& outline) {
    if (IsLost(limb)) {
      canvas_.DrawOutline(outline, kLostColour, 1.0, Stroke::kBroken);
    } else if (limb.state == LimbState::kMeasured) {
      canvas_.Tint(outline, ColourOf(body_), kFilled);
      canvas_.DrawOutline(outline, ColourOf(body_), 1.3, Stroke::kFull);
    } else {
      canvas_.DrawOutline(outline, ColourOf(body_), 1.1, Stroke::kBroken);
    }
  }

  const TrackedBody& body_;
  const PersonModel* model_;
  const geometry::CameraCalibration& camera_;
  Canvas& canvas_;
  std::optional<Eigen::Vector2d> top_px_;
};

std::vector<const TrackedBody*> FarFirst(const std::vector<TrackedBody>& bodies) {
  std::vector<const TrackedBody*> ordered;
  for (const TrackedBody& body : bodies) ordered.push_back(&body);
  const auto distance_m = [](const TrackedBody* body) {
    return body->pose.frame_from_root.translation_m.z();
  };
  std::stable_sort(ordered.begin(), ordered.end(), [&](const auto* one, const auto* other) {
    return distance_m(one) > distance_m(other);
  });
  return ordered;
}

}  // namespace

void DrawBodies(const Scene& scene, Canvas& canvas) {
  if (!scene.bodies || !scene.camera) return;
  for (const TrackedBody* body : FarFirst(scene.bodies->bodies)) {
    BodyPen pen(*body, ModelOf(*body, scene), *scene.camera, canvas);
    pen.DrawLimbs();
    pen.DrawWrists();
    pen.DrawName();
  }
}

}  // namespace deixis::viewer
