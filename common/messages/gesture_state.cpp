#include "common/messages/gesture_state.h"

#include <deixis/gesture_state_t.hpp>

#include "common/messages/scene_parts.h"

namespace deixis::messages {
namespace {

using scene::ContextArea;
using scene::GestureHypothesis;
using scene::GestureState;
using scene::Side;

double Angle(double value_rad) {
  constexpr double kLargest_rad = 100.0;  // Directions need not lie within one turn.
  return Within(value_rad, kLargest_rad);
}

GestureHypothesis ToHypothesis(const gesture_hypothesis_t& message) {
  GestureHypothesis hypothesis;
  hypothesis.hand_id = message.hand_id;
  hypothesis.person_id = message.person_id;
  hypothesis.side = Enumeration(message.side, Side::kRight);
  hypothesis.model = Text(message.model);
  hypothesis.phase = Probability(message.phase);
  hypothesis.end_probability = Probability(message.end_probability);
  if (message.has_context) {
    hypothesis.context =
        ContextArea{ToPixels<2>(message.context_centre_px), Pixels(message.context_radius_px),
                    Angle(message.context_start_rad), Angle(message.context_end_rad)};
  }
  hypothesis.candidates = ToCandidates(message.candidates);
  hypothesis.none_probability = Probability(message.none_probability);
  return hypothesis;
}

gesture_hypothesis_t FromHypothesis(const GestureHypothesis& hypothesis) {
  gesture_hypothesis_t message{};
  message.hand_id = hypothesis.hand_id;
  message.person_id = hypothesis.person_id;
  message.side = Number(hypothesis.side);
  message.model = hypothesis.model;
  message.phase = Outgoing(hypothesis.phase);
  message.end_probability = Outgoing(hypothesis.end_probability);
  message.has_context = hypothesis.context.has_value();
  if (hypothesis.context) {
    FromVector(hypothesis.context->centre_px, message.context_centre_px);
    message.context_radius_px = Outgoing(hypothesis.context->radius_px);
    message.context_start_rad = Outgoing(hypothesis.context->start_rad);
    message.context_end_rad = Outgoing(hypothesis.context->end_rad);
  }
  message.candidates = FromCandidates(hypothesis.candidates);
  message.n_candidates = static_cast<std::int32_t>(message.candidates.size());
  message.none_probability = Outgoing(hypothesis.none_probability);
  return message;
}

}  // namespace

Decoded<GestureState> Codec<GestureState>::Decode(Bytes bytes) {
  const auto message = DecodeWire<gesture_state_t>(bytes);
  RequireCount(message.n_hypotheses, kMostHands);
  GestureState state{ToTimestamp(message.utime), Text(message.camera), Text(message.frame), {}};
  for (const auto& hypothesis : message.hypotheses) {
    state.hypotheses.push_back(ToHypothesis(hypothesis));
  }
  return {std::move(state), Count(message.sequence)};
}

std::vector<std::uint8_t> Codec<GestureState>::Encode(const GestureState& state,
                                                      std::int64_t sequence) {
  gesture_state_t message{};
  message.utime = state.time.microseconds;
  message.sequence = sequence;
  message.camera = state.camera;
  message.frame = state.frame;
  for (const auto& hypothesis : state.hypotheses) {
    message.hypotheses.push_back(FromHypothesis(hypothesis));
  }
  message.n_hypotheses = static_cast<std::int32_t>(message.hypotheses.size());
  return EncodeWire(message);
}

}  // namespace deixis::messages
