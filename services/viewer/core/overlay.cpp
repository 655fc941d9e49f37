#include "services/viewer/core/overlay.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <map>

#include "services/viewer/core/body_overlay.h"
#include "services/viewer/core/canvas.h"

namespace deixis::viewer {
namespace {

// Blue, green, red. Told apart by brightness too, not by hue alone.
const cv::Scalar kFaceColour(255, 220, 150);
const cv::Scalar kObjectColour(90, 200, 255);
const cv::Scalar kMeantColour(110, 255, 110);
const cv::Scalar kLeftColour(255, 150, 70);
const cv::Scalar kRightColour(90, 110, 255);
const cv::Scalar kUnknownColour(200, 200, 200);
const cv::Scalar kTextColour(255, 255, 255);

constexpr double kVelocityShown_s = 0.25;  // The arrow ends where the hand will be by then.
constexpr double kCornerMargin_px = 6.0;   // At a height of 480.
constexpr double kDecisionSize = 2.0;

std::string Number(double value) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.2f", value);
  return text.data();
}

std::string NameOf(scene::Side side) {
  switch (side) {
    case scene::Side::kLeft:
      return "left";
    case scene::Side::kRight:
      return "right";
    case scene::Side::kUnknown:
      return "hand";
  }
  return "hand";
}

cv::Scalar ColourOf(scene::Side side) {
  if (side == scene::Side::kLeft) return kLeftColour;
  return side == scene::Side::kRight ? kRightColour : kUnknownColour;
}

/// The highest probability that any hypothesis gives to each object.
std::map<int, double> Probabilities(const Scene& scene) {
  std::map<int, double> probabilities;
  if (!scene.state) return probabilities;
  for (const scene::GestureHypothesis& hypothesis : scene.state->hypotheses) {
    for (const scene::Candidate& candidate : hypothesis.candidates) {
      double& best = probabilities[candidate.object_id];
      best = std::max(best, candidate.probability);
    }
  }
  return probabilities;
}

bool IsMeant(const Scene& scene, int object_id) {
  return scene.decision && scene.decision->outcome == scene::GestureOutcome::kObject &&
         scene.decision->object_id == object_id;
}

void DrawContexts(const Scene& scene, Canvas& canvas) {
  if (!scene.state) return;
  for (const scene::GestureHypothesis& hypothesis : scene.state->hypotheses) {
    if (!hypothesis.context) continue;
    const scene::ContextArea& area = *hypothesis.context;
    canvas.DrawSector(area.centre_px, area.radius_px, area.start_rad, area.end_rad,
                      ColourOf(hypothesis.side));
  }
}

struct Pen {
  cv::Scalar colour;
  double width = 1.0;
};

Pen PenFor(const scene::Object& object, const Scene& scene) {
  if (IsMeant(scene, object.id)) return {kMeantColour, 3.5};
  return {object.kind == scene::ObjectKind::kFace ? kFaceColour : kObjectColour, 1.6};
}

void DrawObject(const scene::Object& object, double probability, const Pen& pen, Canvas& canvas) {
  if (!object.box) return;
  const bool is_certain =
      object.visibility == scene::Visibility::kSeen || object.kind == scene::ObjectKind::kPlace;
  canvas.DrawBox(*object.box, pen.colour, pen.width, is_certain ? Stroke::kFull : Stroke::kBroken);
  const std::string label = object.label.empty() ? std::to_string(object.id) : object.label;
  const std::string text = probability > 0.005 ? label + " " + Number(probability) : label;
  canvas.DrawText(text, {object.box->x_px, object.box->y_px}, Anchor::kAbove, 1.0, pen.colour);
}

void DrawObjects(const Scene& scene, Canvas& canvas) {
  if (!scene.objects) return;
  const std::map<int, double> probabilities = Probabilities(scene);
  for (const scene::Object& object : scene.objects->objects) {
    const auto found = probabilities.find(object.id);
    const double probability = found == probabilities.end() ? 0.0 : found->second;
    DrawObject(object, probability, PenFor(object, scene), canvas);
  }
}

double RadiusOf(const scene::Hand& hand, const Canvas& canvas) {
  const double from_box_px = 0.5 * std::max(hand.box.width_px, hand.box.height_px);
  return std::clamp(from_box_px, 9.0 * canvas.unit_px(), 40.0 * canvas.unit_px());
}

void DrawHand(const scene::Hand& hand, Canvas& canvas) {
  const cv::Scalar colour = ColourOf(hand.side);
  const double radius_px = RadiusOf(hand, canvas);
  const bool is_measured = hand.state == scene::HandState::kMeasured;
  canvas.DrawCircle(hand.centre_px, radius_px, colour, hand.is_acting ? 3.5 : 1.8,
                    is_measured ? Stroke::kFull : Stroke::kBroken);
  if (hand.is_acting) {
    canvas.DrawCircle(hand.centre_px, radius_px + 5.0 * canvas.unit_px(), kTextColour, 1.0,
                      Stroke::kFull);
  }
  canvas.DrawArrow(hand.centre_px, hand.centre_px + kVelocityShown_s * hand.velocity_px_per_s,
                   colour, 2.2);
  if (hand.fingertip_px) canvas.DrawDot(*hand.fingertip_px, 3.0 * canvas.unit_px(), kTextColour);
  const Eigen::Vector2d below(hand.centre_px.x() - radius_px,
                              hand.centre_px.y() + radius_px + 5.0 * canvas.unit_px());
  canvas.DrawText(NameOf(hand.side) + " " + std::to_string(hand.id), below, Anchor::kBelow,
                  hand.is_acting ? 1.0 : 0.85, colour);
}

void DrawHands(const Scene& scene, Canvas& canvas) {
  if (!scene.hands) return;
  for (const scene::Hand& hand : scene.hands->hands) DrawHand(hand, canvas);
}

std::string TextOf(const scene::GestureHypothesis& hypothesis) {
  return NameOf(hypothesis.side) + " " + std::to_string(hypothesis.hand_id) + ": " +
         hypothesis.model + " " + std::to_string(static_cast<int>(100.0 * hypothesis.phase)) +
         " %, end " + Number(hypothesis.end_probability);
}

void DrawHypotheses(const Scene& scene, Canvas& canvas) {
  if (!scene.state) return;
  Eigen::Vector2d at_px = Eigen::Vector2d::Constant(kCornerMargin_px * canvas.unit_px());
  for (const scene::GestureHypothesis& hypothesis : scene.state->hypotheses) {
    if (hypothesis.model.empty()) continue;
    canvas.DrawText(TextOf(hypothesis), at_px, Anchor::kBelow, 0.9, ColourOf(hypothesis.side));
    at_px.y() += std::max(14.0, 24.0 * canvas.unit_px());
  }
}

void DrawDecision(const Scene& scene, Canvas& canvas) {
  if (!scene.decision) return;
  const bool is_object = scene.decision->outcome == scene::GestureOutcome::kObject;
  const Eigen::Vector2d at_px(0.5 * canvas.size().width,
                              canvas.size().height - 28.0 * canvas.unit_px());
  canvas.DrawText(DecisionText(*scene.decision), at_px, Anchor::kCentred, kDecisionSize,
                  is_object ? kMeantColour : kTextColour);
}

double ProbabilityOf(const scene::Gesture& gesture, int object_id) {
  for (const scene::Candidate& candidate : gesture.candidates) {
    if (candidate.object_id == object_id) return candidate.probability;
  }
  return 0.0;
}

}  // namespace

std::string DecisionText(const scene::Gesture& gesture) {
  switch (gesture.outcome) {
    case scene::GestureOutcome::kObject:
      return gesture.name + " at: " + gesture.object_label + " " +
             Number(ProbabilityOf(gesture, gesture.object_id));
    case scene::GestureOutcome::kNoObject:
      return gesture.name + " at nothing known";
    case scene::GestureOutcome::kAmbiguous:
      break;
  }
  std::string text = gesture.name + " at:";
  const std::size_t named = std::min<std::size_t>(2, gesture.candidates.size());
  for (std::size_t i = 0; i < named; ++i) {
    const scene::Candidate& candidate = gesture.candidates[i];
    text += (i > 0 ? " or " : " ") + candidate.label + " " + Number(candidate.probability);
  }
  return text + "?";
}

cv::Mat DrawOverlay(const Scene& scene) {
  Canvas canvas(scene.image.bgr);
  DrawContexts(scene, canvas);
  DrawBodies(scene, canvas);
  DrawObjects(scene, canvas);
  DrawHands(scene, canvas);
  DrawHypotheses(scene, canvas);
  DrawDecision(scene, canvas);
  return canvas.picture();
}

}  // namespace deixis::viewer
