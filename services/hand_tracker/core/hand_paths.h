#pragma once
#include <Eigen/Core>
#include <array>
#include <limits>
#include <vector>

#include "common/config/config.h"
#include "services/hand_tracker/core/hand_likelihood.h"
#include "services/hand_tracker/core/hand_motion.h"
#include "services/hand_tracker/core/people.h"

namespace deixis::hand_tracker {

struct HandPathsConfig {
  HandLikelihoodConfig likelihood;
  HandMotionConfig motion;
  double resting_rate = 9.0;      ///< Weight of what a resting hand looks like, per second ...
  double moving_rate = 55.0;      ///< ... and of a moving one, whose looks change all the time.
  double birth_cost = 9.0;        ///< Of a hand that comes into sight, nats.
  double death_cost = 7.0;        ///< Of one that leaves.
  double unseen_rate = 10.5;      ///< Cost of a hand that is not seen, nats/s ...
  double face_unseen_rate = 2.3;  ///< ... and before the own face, where it cannot be.
  double forget_time_s = 1.5;     ///< Unseen this long: given up.
  double moving_share =
      0.45;  ///< Of its pixels must change of late for a hand to move a little ...
  double still_time_s = 10.0;  ///< ... and what did not for so long is none: people sway.
  double side_rate = 4.5;      ///< Cost of the other arm's side, nats/(s * hand length).
  double reach = 3.6;          ///< Of an arm from its shoulder, hand lengths ...
  double reach_rate = 30.0;    ///< ... and the cost beyond it, nats/(s * hand length).
  double twin_distance = 0.4;  ///< Two hands closer than this are one, hand lengths ...
  double twin_cost = 6.0;      ///< ... or cost this, nats.
  double lump_cost = 4.5;      ///< Of both hands in one lump, nats; they must have met there.
  double arm_length =
      3.4;  ///< From the shoulder to where a new hand begins, at most, hand lengths.
  double least_area = 0.08;    ///< Of a new hand, hand lengths squared.
  double largest_area = 0.75;  ///< Of a new hand, hand lengths squared.

  template <typename Visitor>
  void Visit(Visitor& v) {
    v("likelihood", likelihood);
    v("motion", motion);
    v("resting_rate", resting_rate);
    v("moving_rate", moving_rate);
    v("birth_cost", birth_cost);
    v("death_cost", death_cost);
    v("unseen_rate", unseen_rate);
    v("face_unseen_rate", face_unseen_rate);
    v("forget_time_s", forget_time_s);
    v("moving_share", moving_share);
    v("still_time_s", still_time_s);
    v("side_rate", side_rate);
    v("reach", reach);
    v("reach_rate", reach_rate);
    v("twin_distance", twin_distance);
    v("twin_cost", twin_cost);
    v("lump_cost", lump_cost);
    v("arm_length", arm_length);
    v("least_area", least_area);
    v("largest_area", largest_area);
  }
  void Validate() const;
};

/// Where one hand may be.
struct HandGuess {
  enum class Kind { kAbsent, kResting, kMoving, kUnseen };
  Kind kind = Kind::kAbsent;
  int candidate = -1;  ///< Of those given last; -1 = none.
  LastSight sight;     ///< Without meaning when absent.
  double hand_length_px = 0.0;
  double still_s = 0.0;     ///< For how long it has not moved at all.
  bool sways = false;       ///< Moved of late.
  bool may_be_new = false;  ///< A hand that was absent may come into sight there.
};

/// Finds the likeliest way of both hands of one person through the candidates of all images so far:
/// a Viterbi filter over pairs of guesses. What was ambiguous is decided in hindsight, when the
/// images that follow favour one way: a hand that went away fast from a thing of its colour is
/// found where it went. Time O(n^3) for n guesses per hand, at most 39.
class HandPaths {
 public:
  explicit HandPaths(const HandPathsConfig& config);

  /// Takes in the next image's candidates, all of this person; `person` is nullptr when no face is
  /// known.
  void Update(const std::vector<HandCandidate>& candidates, const Person* person, double elapsed_s);

  /// The likeliest pair: the right hand and the left one, as far as shoulders are known.
  const std::array<HandGuess, 2>& hands() const { return hands_; }

 private:
  using Guesses = std::vector<HandGuess>;
  /// One hand's guesses at this image, their own log likelihood, and log densities of coming from
  /// each of the last image's (row-major: last x this).
  struct Hand {
    Guesses last;
    Guesses next;
    std::vector<int> origin;  ///< Of an unseen hand: its guess at the last image; else -1.
    std::vector<double> evidence;
    std::vector<double> step;
    std::vector<double> marginal;  ///< Best score of each last guess.
  };

  void JudgeCandidates(const std::vector<HandCandidate>& candidates);
  void Propose(const std::vector<HandCandidate>& candidates, const Person* person,
               double elapsed_s);
  void ProposeSeen(const std::vector<HandCandidate>& candidates, const Person* person,
                   std::size_t side);
  void ProposeUnseen(const Person* person, double elapsed_s, Hand& hand) const;
  double PlaceCost(const HandCandidate& candidate, const Person* person, std::size_t side) const;
  void FindMarginals();
  void Connect(double elapsed_s, Hand& hand) const;
  double LogStep(const HandGuess& from, const HandGuess& to, double elapsed_s) const;
  void Advance();
  void AddEvidence(const std::vector<HandCandidate>& candidates);
  double TwinCost(const std::vector<HandCandidate>& candidates, const HandGuess& right,
                  const HandGuess& left) const;
  void Settle(double elapsed_s);
  void Choose();

  HandPathsConfig config_;
  double images_ = 0.0;  ///< Images of 1/15 s since the last one; what costs are stated for.
  std::vector<std::size_t> kept_;  ///< The candidates that look most like hands.
  std::vector<HandEvidence> looks_;
  std::array<Hand, 2> sides_;
  std::vector<double> scores_;           ///< Of pairs: right x left.
  std::vector<double> half_;             ///< After the right hand's step.
  std::vector<std::size_t> from_right_;  ///< Best last guess of the right hand: left last x right.
  std::vector<std::size_t> from_left_;   ///< Best last guess of the left hand: right x left.
  std::vector<double> next_scores_;
  std::array<HandGuess, 2> hands_;
};

}  // namespace deixis::hand_tracker
