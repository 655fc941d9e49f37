#include "services/hand_tracker/core/hand_tracker.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "services/hand_tracker/core/skin_evidence.h"

namespace deixis::hand_tracker {
namespace {

/// Hand length of whoever was seen most, working pixels; a share of the picture when nobody is
/// known.
double TypicalHandLength(const std::vector<Person>& people, const WorkingImage& working) {
  constexpr double kShareOfHeight = 0.45;
  if (people.empty()) return kShareOfHeight * working.bgr.rows;
  const auto most_seen = std::max_element(
      people.begin(), people.end(),
      [](const Person& a, const Person& b) { return a.times_seen < b.times_seen; });
  return HandLength(*most_seen) / working.scale;
}

/// Marks a region with a rim of two pixels.
void HoldRegion(const SkinRegion& region, cv::Mat& held) {
  constexpr int kRim = 2;
  for (const Run& run : region.runs) {
    const cv::Rect strip(run.first - kRim, run.row - kRim, run.last - run.first + 1 + 2 * kRim,
                         1 + 2 * kRim);
    held(strip & cv::Rect(0, 0, held.cols, held.rows)).setTo(255);
  }
}

scene::Hand ToHand(const HandTrack& track, const HandRole& role,
                   const std::vector<Person>& people) {
  scene::Hand hand;
  hand.id = track.id();
  for (const Person& person : people) {
    if (person.key == role.person) hand.person_id = person.person_id;
  }
  if (role.person >= 0 && std::abs(role.side_score) > 0.5) {
    hand.side = role.side_score > 0.0 ? scene::Side::kLeft : scene::Side::kRight;
    hand.side_probability = 1.0 / (1.0 + std::exp(-std::abs(role.side_score)));
  }
  hand.is_acting = role.is_acting;
  hand.state = track.state();
  hand.centre_px = track.centre();
  hand.velocity_px_per_s = track.velocity();
  hand.covariance = track.Covariance();
  hand.box = track.latest().box;
  const Eigen::Vector2d shift = track.centre() - track.latest().centre;
  hand.box.x_px += shift.x();
  hand.box.y_px += shift.y();
  if (track.state() == scene::HandState::kMeasured) hand.fingertip_px = track.latest().tip;
  return hand;
}

/// Where two pictures of one size differ by more than noise; nowhere when there is no earlier one.
cv::Mat ChangeBetween(const cv::Mat& earlier, const cv::Mat& later) {
  constexpr double kNoise = 10.0;  // Grey levels.
  if (earlier.size() != later.size()) return cv::Mat::zeros(later.size(), CV_8UC1);
  cv::Mat difference;
  cv::absdiff(earlier, later, difference);
  cv::cvtColor(difference, difference, cv::COLOR_BGR2GRAY);
  cv::blur(difference, difference, {3, 3}, {-1, -1}, cv::BORDER_REPLICATE);
  return difference > kNoise;
}

}  // namespace

void HandTrackerConfig::Validate() const {
  config::Faults faults;
  faults.Require(working_width_px >= 80, "working_width_px", "must be at least 80");
  faults.Require(low_threshold > 0 && low_threshold < 256, "low_threshold", "must lie in 1..255");
  faults.Require(high_threshold >= low_threshold && high_threshold < 256, "high_threshold",
                 "must lie between low_threshold and 255");
  faults.Require(thinnest >= 0.0, "thinnest", "must not be negative");
  faults.Require(largest_held_area >= 0.0, "largest_held_area", "must not be negative");
  faults.Require(report_time_s >= 0.0, "report_time_s", "must not be negative");
  faults.Require(face_memory_s > 0.0, "face_memory_s", "must be positive");
  faults.Require(learn_interval_s >= 0.0, "learn_interval_s", "must not be negative");
  faults.Require(longest_gap_s > 0.0, "longest_gap_s", "must be positive");
  faults.ThrowIfAny();
}

HandTracker::HandTracker(const HandTrackerConfig& config)
    : config_(config),
      skin_(config.skin),
      background_(config.background),
      people_(config.face_memory_s),
      tracks_(config.tracks),
      roles_(config.roles) {}

void HandTracker::UpdateFaces(const scene::Objects& objects) { people_.Update(objects); }

scene::Hands HandTracker::Track(const images::Image& image) {
  const double elapsed_s = Advance(image);
  working_ = Reduce(image.bgr, config_.working_width_px);
  people_.Forget(image.time);
  const double reach = 0.35 * TypicalHandLength(persons_, working_);
  HoldHands();
  background_.Update(working_.bgr, held_, elapsed_s, static_cast<int>(std::lround(reach)));
  fresh_ = ChangeBetween(previous_, background_.normalised());
  background_.normalised().copyTo(previous_);
  people_.NoteMotion([this](const scene::Box& box) { return MovesInside(box); }, elapsed_s);
  persons_ = people_.established();
  since_learning_s_ += elapsed_s;
  LearnColours();
  FindEvidence();
  observation_ = Observe(elapsed_s);
  tracks_.Update(observation_);
  roles_.Update(tracks_.tracks(), persons_, config_.tracks.reach, elapsed_s);
  return Report(image);
}

bool HandTracker::MovesInside(const scene::Box& box) const {
  constexpr double kLeastShare = 0.05;
  const scene::Box working = ToWorking(box, working_.scale);
  const cv::Rect area =
      cv::Rect(static_cast<int>(working.x_px), static_cast<int>(working.y_px),
               static_cast<int>(working.width_px), static_cast<int>(working.height_px)) &
      cv::Rect({0, 0}, working_.bgr.size());
  if (area.empty()) return false;
  return cv::countNonZero(background_.changed()(area)) > kLeastShare * area.area();
}

double HandTracker::Advance(const images::Image& image) {
  const double elapsed_s = time_ ? SecondsBetween(*time_, image.time) : 0.0;
  const bool is_continued =
      time_ && elapsed_s >= 0.0 && elapsed_s <= config_.longest_gap_s && image.bgr.size() == size_;
  if (!is_continued) Reset();
  time_ = image.time;
  size_ = image.bgr.size();
  return is_continued ? elapsed_s : 0.0;
}

void HandTracker::Reset() {
  previous_.release();
  background_.Reset();
  people_.Reset();
  tracks_.Reset();
  observation_ = {};
  unknown_hand_px_ = 1.0;
  regions_.clear();
  roles_.Reset();
  skin_ = skin::SkinModel(config_.skin);
  since_learning_s_ = 0.0;
}

/// The hands that are followed, and the arms that they belong to, must not become background by
/// resting.
void HandTracker::HoldHands() {
  held_ = cv::Mat::zeros(working_.bgr.size(), CV_8UC1);
  const bool fits = evidence_.size() == held_.size();
  for (const HandTrack& track : tracks_.tracks()) {
    const Eigen::Vector2d centre = ToWorking(track.centre(), working_.scale);
    const double hand_length = track.hand_length_px() / working_.scale;
    const double radius = std::min(0.6 * hand_length, static_cast<double>(held_.rows));
    cv::circle(held_, {static_cast<int>(centre.x()), static_cast<int>(centre.y())},
               static_cast<int>(radius), cv::Scalar(255), cv::FILLED);
    const auto region = static_cast<std::size_t>(track.latest().region);
    if (fits && track.state() == scene::HandState::kMeasured && region < regions_.size() &&
        regions_[region].area_px < config_.largest_held_area * hand_length * hand_length) {
      HoldRegion(regions_[region], held_);
    }
  }
}

void HandTracker::LearnColours() {
  const bool is_first = !skin_.knows_face() && !persons_.empty();
  if (since_learning_s_ < config_.learn_interval_s && !is_first) return;
  const cv::Mat& bgr = background_.normalised();
  for (const Person& person : persons_) {
    if (SecondsBetween(person.last_seen, *time_) > 0.5) continue;
    skin_.LearnFromFace(bgr, ToWorking(person.face, working_.scale), since_learning_s_);
  }
  skin_.LearnFromScene(bgr, SceneMask(), since_learning_s_);
  since_learning_s_ = 0.0;
}

/// Pixels that show what could be taken for a hand but is none: not the faces, not the hands, and
/// not the background that is known anyway.
cv::Mat HandTracker::SceneMask() const {
  cv::Mat mask = background_.knowledge() != BackgroundModel::kBackground;
  mask.setTo(0, held_);
  std::vector<scene::Box> faces;
  for (const Person& person : persons_) faces.push_back(ToWorking(person.face, working_.scale));
  ClearFaces(faces, mask);
  return mask;
}

void HandTracker::FindEvidence() {
  const double hand_length = TypicalHandLength(persons_, working_);
  evidence_ = SkinEvidence(background_, skin_.table(), static_cast<int>(std::lround(hand_length)));
  std::vector<scene::Box> faces;
  for (const Person& person : persons_) faces.push_back(ToWorking(person.face, working_.scale));
  ClearFaces(faces, evidence_);
  evidence_ = Smooth(evidence_, config_.thinnest * hand_length < 2.0 ? 3 : 5);
}

Observation HandTracker::Observe(double elapsed_s) {
  const double typical = TypicalHandLength(persons_, working_);
  const double least =
      persons_.empty() ? 0.0004 * static_cast<double>(evidence_.total()) : 0.06 * typical * typical;
  const HysteresisThresholds thresholds{config_.low_threshold, config_.high_threshold};
  const int least_px = std::max(6, static_cast<int>(least));
  const auto candidates_in = [&](const std::vector<SkinRegion>& regions, const cv::Mat& evidence) {
    return ObserveCandidates(regions, {evidence, background_.changed(), fresh_}, persons_,
                             working_.scale, unknown_hand_px_);
  };
  regions_ = FindRegions(evidence_, thresholds, least_px);
  GuessUnknownHand(typical, elapsed_s);
  Observation observation{candidates_in(regions_, evidence_), persons_, elapsed_s};
  // A moving hand before something of its colour shows only by its motion.
  cv::bitwise_and(evidence_, fresh_, moving_);
  moving_ = Smooth(moving_, 3);
  AddByMotion(candidates_in(FindRegions(moving_, thresholds, least_px), moving_),
              observation.candidates);
  return observation;
}

/// Of people whose face is not seen: the largest hand of late, as regions tell.
void HandTracker::GuessUnknownHand(double longest_px, double elapsed_s) {
  constexpr double kTime_s = 3.0;
  unknown_hand_px_ *= std::exp(-elapsed_s / kTime_s);
  for (const SkinRegion& region : regions_) {
    unknown_hand_px_ = std::max(unknown_hand_px_, std::min(longest_px, GuessHandLength(region)));
  }
}

scene::Hands HandTracker::Report(const images::Image& image) const {
  scene::Hands hands;
  hands.time = image.time;
  hands.camera = image.camera;
  for (const HandTrack& track : tracks_.tracks()) {
    if (track.unseen_s() > config_.report_time_s) continue;
    hands.hands.push_back(ToHand(track, roles_.RoleOf(track.id()), persons_));
  }
  return hands;
}

}  // namespace deixis::hand_tracker
