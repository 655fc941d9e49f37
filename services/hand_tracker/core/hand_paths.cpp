#include "services/hand_tracker/core/hand_paths.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace deixis::hand_tracker {
namespace {

constexpr double kImpossible = -1e9;
constexpr double kImage_s = 1.0 / 15.0;  // What costs per image are stated for.
constexpr double kMostImages = 2.0;      // One image never counts for more ...
constexpr double kLeastImages = 0.01;    // ... nor, when two have the same time, for nothing.
constexpr double kFastBirthCost = 2.0;   // Of a hand that comes into sight at full speed, nats.
constexpr double kSameCost = 100.0;      // Of one thing that is taken for both hands, nats.
constexpr std::size_t kMostCandidates = 16;
constexpr std::size_t kMostUnseen = 6;

bool IsSeen(const HandGuess& guess) {
  return guess.kind == HandGuess::Kind::kResting || guess.kind == HandGuess::Kind::kMoving;
}

HandGuess SeenAt(const HandCandidate& candidate, int index) {
  HandGuess guess;
  guess.kind = HandGuess::Kind::kResting;
  guess.candidate = index;
  guess.sight.position = candidate.centre;
  guess.hand_length_px = candidate.hand_length_px;
  return guess;
}

/// Below the face, between the shoulders: where a neckline shows skin that is no hand.
bool IsOnChest(const Person& person, const Eigen::Vector2d& point) {
  const Eigen::Vector2d offset = (point - scene::Centre(person.face)) / HandLength(person);
  return std::abs(offset.x()) < 0.8 && offset.y() > 0.0 && offset.y() < 1.9;
}

/// Whether a hand that was not there before may show up as `candidate`.
bool IsPlausibleBirth(const HandPathsConfig& config, const HandCandidate& candidate,
                      const Person* person) {
  const double unit = candidate.hand_length_px;
  const double area = candidate.area_px / (unit * unit);
  return candidate.root_distance_px <= config.arm_length * unit && area >= config.least_area &&
         area <= config.largest_area && !candidate.is_at_shoulder && !candidate.is_at_face &&
         (person == nullptr || !IsOnChest(*person, candidate.centre));
}

/// Whether a hand that was just seen at `from` may be within the same lump as the other at `to`.
bool IsNear(const HandGuess& from, const HandGuess& to) {
  constexpr double kFarthest = 1.0;  // Hand lengths.
  constexpr double kLongest_s = 0.5;
  return from.kind != HandGuess::Kind::kAbsent && from.sight.elapsed_s < kLongest_s &&
         (from.sight.position - to.sight.position).norm() < kFarthest * to.hand_length_px;
}

/// Without a shoulder nobody knows which end of a region is the hand: it is one of them.
bool AreEndsOfOne(const HandCandidate& a, const HandCandidate& b) {
  const bool is_one_region = a.region >= 0 && a.region == b.region;
  return a.shoulder < 0 && (is_one_region || scene::Overlap(a.box, b.box) > 0.0);
}

/// Where going from the guess `from`, which has `score`, is better than what is known, it becomes
/// the best way. Rows of `n` next guesses.
void StepFrom(std::size_t from, double score, const double* step, std::size_t n, double* best,
              std::size_t* best_from) {
  for (std::size_t to = 0; to < n; ++to) {
    const double sum = score + step[to];
    if (sum > best[to]) {
      best[to] = sum;
      best_from[to] = from;
    }
  }
}

/// Index of the largest of `n` values that lie `stride` apart.
std::size_t BestOf(const double* values, std::size_t n, std::size_t stride) {
  std::size_t best = 0;
  for (std::size_t i = 1; i < n; ++i) {
    if (values[i * stride] > values[best * stride]) best = i;
  }
  return best;
}

/// Whether a hand may be at `to`, where nothing moved of late: it must have been there, and not for
/// too long.
bool MayBeStill(const HandPathsConfig& config, const HandGuess& from, const HandGuess& to) {
  constexpr double kNear = 0.5;  // Hand lengths.
  const double distance = (to.sight.position - from.sight.position).norm();
  return from.still_s <= config.still_time_s && distance < kNear * to.hand_length_px;
}

/// Whether no hand could have come so far.
bool IsTooFar(const HandMotionConfig& config, const LastSight& last, const HandGuess& to) {
  const double distance = (to.sight.position - last.position).norm() / to.hand_length_px;
  return distance > config.largest_error + config.fastest * last.elapsed_s;
}

/// What a hand that was at one guess brings to the next: its speed, and how long it has been still.
void Arrive(const HandGuess& from, double elapsed_s, HandGuess& to) {
  const double time_s = from.sight.elapsed_s + elapsed_s;
  if (!IsSeen(to) || from.kind == HandGuess::Kind::kAbsent || time_s <= 0.0) return;
  to.still_s = to.sways ? 0.0 : from.still_s + time_s;
  to.sight.velocity = (to.sight.position - from.sight.position) / time_s;
}

}  // namespace

void HandPathsConfig::Validate() const {
  config::Faults faults;
  const auto require = [&faults](double value, const char* key) {
    faults.Require(value >= 0.0, key, "must not be negative");
  };
  require(resting_rate, "resting_rate");
  require(moving_rate, "moving_rate");
  require(birth_cost, "birth_cost");
  require(death_cost, "death_cost");
  require(unseen_rate, "unseen_rate");
  require(face_unseen_rate, "face_unseen_rate");
  require(forget_time_s, "forget_time_s");
  require(moving_share, "moving_share");
  require(still_time_s, "still_time_s");
  require(side_rate, "side_rate");
  require(reach, "reach");
  require(reach_rate, "reach_rate");
  require(twin_distance, "twin_distance");
  require(twin_cost, "twin_cost");
  require(lump_cost, "lump_cost");
  require(arm_length, "arm_length");
  require(least_area, "least_area");
  faults.Require(largest_area > least_area, "largest_area", "must exceed least_area");
  faults.ThrowIfAny();
}

HandPaths::HandPaths(const HandPathsConfig& config) : config_(config), scores_{0.0} {
  for (Hand& hand : sides_) hand.last.resize(1);
}

void HandPaths::Update(const std::vector<HandCandidate>& candidates, const Person* person,
                       double elapsed_s) {
  images_ = std::clamp(elapsed_s / kImage_s, kLeastImages, kMostImages);
  JudgeCandidates(candidates);
  FindMarginals();
  Propose(candidates, person, elapsed_s);
  for (Hand& hand : sides_) Connect(elapsed_s, hand);
  Advance();
  AddEvidence(candidates);
  Settle(elapsed_s);
  Choose();
}

void HandPaths::JudgeCandidates(const std::vector<HandCandidate>& candidates) {
  looks_.clear();
  for (const HandCandidate& candidate : candidates) {
    looks_.push_back(Judge(config_.likelihood, candidate));
  }
  kept_.resize(candidates.size());
  std::iota(kept_.begin(), kept_.end(), std::size_t{0});
  if (kept_.size() <= kMostCandidates) return;
  std::stable_sort(kept_.begin(), kept_.end(), [this](std::size_t a, std::size_t b) {
    return std::max(looks_[a].resting, looks_[a].moving) >
           std::max(looks_[b].resting, looks_[b].moving);
  });
  kept_.resize(kMostCandidates);
}

void HandPaths::FindMarginals() {
  const std::size_t rights = sides_[0].last.size();
  const std::size_t lefts = sides_[1].last.size();
  sides_[0].marginal.assign(rights, kImpossible);
  sides_[1].marginal.assign(lefts, kImpossible);
  for (std::size_t r = 0; r < rights; ++r) {
    for (std::size_t l = 0; l < lefts; ++l) {
      const double score = scores_[r * lefts + l];
      sides_[0].marginal[r] = std::max(sides_[0].marginal[r], score);
      sides_[1].marginal[l] = std::max(sides_[1].marginal[l], score);
    }
  }
}

void HandPaths::Propose(const std::vector<HandCandidate>& candidates, const Person* person,
                        double elapsed_s) {
  for (std::size_t side = 0; side < sides_.size(); ++side) {
    Hand& hand = sides_[side];
    hand.next.assign(1, HandGuess{});
    hand.evidence.assign(1, 0.0);
    hand.origin.assign(1, -1);
    ProposeSeen(candidates, person, side);
    ProposeUnseen(person, elapsed_s, hand);
  }
}

void HandPaths::ProposeSeen(const std::vector<HandCandidate>& candidates, const Person* person,
                            std::size_t side) {
  Hand& hand = sides_[side];
  for (const std::size_t i : kept_) {
    const double place = images_ * kImage_s * PlaceCost(candidates[i], person, side);
    const double resting = images_ * kImage_s * config_.resting_rate * looks_[i].resting;
    const double moving = images_ * kImage_s * config_.moving_rate * looks_[i].moving;
    HandGuess guess = SeenAt(candidates[i], static_cast<int>(i));
    guess.sways = candidates[i].moving_share > config_.moving_share;
    guess.may_be_new = guess.sways && IsPlausibleBirth(config_, candidates[i], person);
    hand.next.push_back(guess);
    hand.evidence.push_back(resting - place);
    guess.kind = HandGuess::Kind::kMoving;
    guess.sight.is_moving = true;
    hand.next.push_back(guess);
    hand.evidence.push_back(moving - place);
    hand.origin.insert(hand.origin.end(), 2, -1);
  }
}

/// Nats per second: hands are rather found on their own side, and within reach of their shoulder.
double HandPaths::PlaceCost(const HandCandidate& candidate, const Person* person,
                            std::size_t side) const {
  if (person == nullptr) return 0.0;
  const auto shoulders = Shoulders(*person);
  const double unit = HandLength(*person);
  const double own = (candidate.centre - shoulders[side]).norm() / unit;
  const double other = (candidate.centre - shoulders[1 - side]).norm() / unit;
  return config_.side_rate * std::clamp(own - other, -1.0, 1.0) +
         config_.reach_rate * std::max(0.0, own - config_.reach);
}

void HandPaths::ProposeUnseen(const Person* person, double elapsed_s, Hand& hand) const {
  std::vector<std::size_t> likely;
  for (std::size_t i = 0; i < hand.last.size(); ++i) {
    const bool is_known = hand.last[i].kind != HandGuess::Kind::kAbsent;
    if (is_known && hand.last[i].sight.elapsed_s + elapsed_s < config_.forget_time_s)
      likely.push_back(i);
  }
  std::stable_sort(likely.begin(), likely.end(), [&hand](std::size_t a, std::size_t b) {
    return hand.marginal[a] > hand.marginal[b];
  });
  likely.resize(std::min(likely.size(), kMostUnseen));
  for (const std::size_t i : likely) {
    HandGuess guess = hand.last[i];
    guess.kind = HandGuess::Kind::kUnseen;
    guess.candidate = -1;
    guess.sight.elapsed_s += elapsed_s;
    const bool is_on_face = person != nullptr && IsOnFace(*person, guess.sight.position);
    const double rate = is_on_face ? config_.face_unseen_rate : config_.unseen_rate;
    hand.next.push_back(guess);
    hand.evidence.push_back(-images_ * kImage_s * rate);
    hand.origin.push_back(static_cast<int>(i));
  }
}

void HandPaths::Connect(double elapsed_s, Hand& hand) const {
  const std::size_t n = hand.next.size();
  hand.step.assign(hand.last.size() * n, kImpossible);
  for (std::size_t from = 0; from < hand.last.size(); ++from) {
    for (std::size_t to = 0; to < n; ++to) {
      if (hand.next[to].kind != HandGuess::Kind::kUnseen) {
        hand.step[from * n + to] = LogStep(hand.last[from], hand.next[to], elapsed_s);
      } else if (hand.origin[to] == static_cast<int>(from)) {
        hand.step[from * n + to] = 0.0;
      }
    }
  }
}

/// Log density of going from one guess to a hand that is seen, or absent.
double HandPaths::LogStep(const HandGuess& from, const HandGuess& to, double elapsed_s) const {
  const bool was_absent = from.kind == HandGuess::Kind::kAbsent;
  if (to.kind == HandGuess::Kind::kAbsent) return was_absent ? 0.0 : -config_.death_cost;
  const bool moves = to.kind == HandGuess::Kind::kMoving;
  if (was_absent) {
    const double cost = config_.birth_cost + (moves ? kFastBirthCost : 0.0);
    return to.may_be_new ? -cost : kImpossible;
  }
  if (!to.sways && !MayBeStill(config_, from, to)) return kImpossible;
  LastSight sight = from.sight;
  sight.elapsed_s += elapsed_s;
  if (IsTooFar(config_.motion, sight, to)) return kImpossible;
  const NextPlace place = JudgeNextPlace(config_.motion, sight, to.sight.position,
                                         images_ * kImage_s, to.hand_length_px);
  return moves ? place.moving : place.resting;
}

/// One step of the Viterbi recursion over pairs, one hand after the other.
void HandPaths::Advance() {
  const auto& [right, left] = sides_;
  const std::size_t rights = right.next.size();
  const std::size_t lefts = left.next.size();
  half_.assign(left.last.size() * rights, 2.0 * kImpossible);
  from_right_.assign(half_.size(), 0);
  for (std::size_t from = 0; from < right.last.size(); ++from) {
    for (std::size_t l = 0; l < left.last.size(); ++l) {
      StepFrom(from, scores_[from * left.last.size() + l], &right.step[from * rights], rights,
               &half_[l * rights], &from_right_[l * rights]);
    }
  }
  next_scores_.assign(rights * lefts, 4.0 * kImpossible);
  from_left_.assign(next_scores_.size(), 0);
  for (std::size_t from = 0; from < left.last.size(); ++from) {
    for (std::size_t r = 0; r < rights; ++r) {
      StepFrom(from, half_[from * rights + r], &left.step[from * lefts], lefts,
               &next_scores_[r * lefts], &from_left_[r * lefts]);
    }
  }
}

void HandPaths::AddEvidence(const std::vector<HandCandidate>& candidates) {
  const auto& [right, left] = sides_;
  const std::size_t rights = right.next.size();
  const std::size_t lefts = left.next.size();
  for (std::size_t r = 0; r < rights; ++r) {
    for (std::size_t l = 0; l < lefts; ++l) {
      double& score = next_scores_[r * lefts + l];
      score += right.evidence[r] + left.evidence[l];
      if (!IsSeen(right.next[r]) || !IsSeen(left.next[l])) continue;
      if (right.next[r].candidate != left.next[l].candidate) {
        score -= TwinCost(candidates, right.next[r], left.next[l]);
        continue;
      }
      const HandGuess& left_before = left.last[from_left_[r * lefts + l]];
      const HandGuess& right_before =
          right.last[from_right_[from_left_[r * lefts + l] * rights + r]];
      // What shows both hands is evidence for one only.
      score -= std::max(0.0, std::min(right.evidence[r], left.evidence[l])) + config_.lump_cost;
      if (candidates[static_cast<std::size_t>(right.next[r].candidate)].shoulder < 0 ||
          !IsNear(right_before, right.next[r]) || !IsNear(left_before, left.next[l])) {
        score -= kSameCost;
      }
    }
  }
}

double HandPaths::TwinCost(const std::vector<HandCandidate>& candidates, const HandGuess& right,
                           const HandGuess& left) const {
  const HandCandidate& one = candidates[static_cast<std::size_t>(right.candidate)];
  const HandCandidate& other = candidates[static_cast<std::size_t>(left.candidate)];
  if (AreEndsOfOne(one, other)) return kSameCost;
  const double distance = (one.centre - other.centre).norm();
  return distance < config_.twin_distance * one.hand_length_px ? config_.twin_cost : 0.0;
}

/// Gives each guess that is seen the speed with which it was reached, and makes this image the last
/// one.
void HandPaths::Settle(double elapsed_s) {
  auto& [right, left] = sides_;
  const std::size_t rights = right.next.size();
  const std::size_t lefts = left.next.size();
  for (std::size_t r = 0; r < rights; ++r) {
    const std::size_t l = BestOf(&next_scores_[r * lefts], lefts, 1);
    const std::size_t from = from_right_[from_left_[r * lefts + l] * rights + r];
    Arrive(right.last[from], elapsed_s, right.next[r]);
  }
  for (std::size_t l = 0; l < lefts; ++l) {
    const std::size_t r = BestOf(&next_scores_[l], rights, lefts);
    Arrive(left.last[from_left_[r * lefts + l]], elapsed_s, left.next[l]);
  }
  for (Hand& hand : sides_) std::swap(hand.last, hand.next);
}

void HandPaths::Choose() {
  const auto best = std::max_element(next_scores_.begin(), next_scores_.end());
  const double largest = *best;
  const auto pair = static_cast<std::size_t>(best - next_scores_.begin());
  const std::size_t lefts = sides_[1].last.size();
  hands_ = {sides_[0].last[pair / lefts], sides_[1].last[pair % lefts]};
  for (double& score : next_scores_) score -= largest;
  std::swap(scores_, next_scores_);
}

}  // namespace deixis::hand_tracker
