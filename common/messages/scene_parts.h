#pragma once
// For the .cpp files of this folder only: parts that several messages share.
#include <deixis/candidate_t.hpp>
#include <vector>

#include "common/messages/wire.h"
#include "common/scene/box.h"
#include "common/scene/gesture.h"

namespace deixis::messages {

inline scene::Box ToBox(const double (&values)[4]) {
  const auto box = ToPixels<4>(values);
  if (box[2] < 0.0 || box[3] < 0.0) throw Rejected("out_of_range");
  return {box[0], box[1], box[2], box[3]};
}

inline void FromBox(const scene::Box& box, double (&values)[4]) {
  FromVector(Eigen::Vector4d(box.x_px, box.y_px, box.width_px, box.height_px), values);
}

inline std::vector<scene::Candidate> ToCandidates(const std::vector<candidate_t>& messages) {
  RequireCount(static_cast<std::int64_t>(messages.size()), kMostCandidates);
  std::vector<scene::Candidate> candidates;
  for (const candidate_t& message : messages) {
    candidates.push_back(
        {message.object_id, Text(message.label), Probability(message.probability)});
  }
  return candidates;
}

inline std::vector<candidate_t> FromCandidates(const std::vector<scene::Candidate>& candidates) {
  std::vector<candidate_t> messages;
  for (const scene::Candidate& candidate : candidates) {
    candidate_t message{};
    message.object_id = candidate.object_id;
    message.label = candidate.label;
    message.probability = Outgoing(candidate.probability);
    messages.push_back(message);
  }
  return messages;
}

}  // namespace deixis::messages
