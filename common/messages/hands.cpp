#include "common/messages/hands.h"

#include <deixis/hand_tracks_t.hpp>

#include "common/messages/scene_parts.h"

namespace deixis::messages {
namespace {

using scene::Hand;
using scene::HandPosition;
using scene::Hands;
using scene::HandState;
using scene::Side;

Hand ToHand(const hand_t& message) {
  Hand hand;
  hand.id = message.id;
  hand.person_id = message.person_id;
  hand.side = Enumeration(message.side, Side::kRight);
  hand.side_probability = Probability(message.side_probability);
  hand.is_acting = message.is_acting != 0;
  hand.state = Enumeration(message.state, HandState::kOccluded);
  hand.centre_px = ToPixels<2>(message.centre_px);
  hand.velocity_px_per_s = ToPixels<2>(message.velocity_px_per_s);
  hand.covariance = ToCovariance<4>(message.covariance, kFarthest_px);
  hand.box = ToBox(message.box_px);
  if (message.has_fingertip) hand.fingertip_px = ToPixels<2>(message.fingertip_px);
  if (message.has_position) {
    hand.position =
        HandPosition{ToMetres<3>(message.position_m), ToMetres<3>(message.velocity_m_per_s),
                     ToCovariance<3>(message.position_covariance_m2, kFarthest_m)};
  }
  return hand;
}

hand_t FromHand(const Hand& hand) {
  hand_t message{};
  message.id = hand.id;
  message.person_id = hand.person_id;
  message.side = Number(hand.side);
  message.side_probability = Outgoing(hand.side_probability);
  message.is_acting = hand.is_acting;
  message.state = Number(hand.state);
  FromVector(hand.centre_px, message.centre_px);
  FromVector(hand.velocity_px_per_s, message.velocity_px_per_s);
  FromSymmetric(hand.covariance, message.covariance);
  FromBox(hand.box, message.box_px);
  message.has_fingertip = hand.fingertip_px.has_value();
  if (hand.fingertip_px) FromVector(*hand.fingertip_px, message.fingertip_px);
  message.has_position = hand.position.has_value();
  if (hand.position) {
    FromVector(hand.position->position_m, message.position_m);
    FromVector(hand.position->velocity_m_per_s, message.velocity_m_per_s);
    FromSymmetric(hand.position->covariance_m2, message.position_covariance_m2);
  }
  return message;
}

}  // namespace

Decoded<Hands> Codec<Hands>::Decode(Bytes bytes) {
  const auto message = DecodeWire<hand_tracks_t>(bytes);
  RequireCount(message.n_hands, kMostHands);
  Hands hands{ToTimestamp(message.utime), Text(message.camera), Text(message.frame), {}};
  for (const hand_t& hand : message.hands) hands.hands.push_back(ToHand(hand));
  return {std::move(hands), Count(message.sequence)};
}

std::vector<std::uint8_t> Codec<Hands>::Encode(const Hands& hands, std::int64_t sequence) {
  hand_tracks_t message{};
  message.utime = hands.time.microseconds;
  message.sequence = sequence;
  message.camera = hands.camera;
  message.frame = hands.frame;
  for (const Hand& hand : hands.hands) message.hands.push_back(FromHand(hand));
  message.n_hands = static_cast<std::int32_t>(message.hands.size());
  return EncodeWire(message);
}

}  // namespace deixis::messages
