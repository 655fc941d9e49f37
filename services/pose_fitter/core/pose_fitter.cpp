#include "services/pose_fitter/core/pose_fitter.h"

#include <algorithm>
#include <cmath>

#include "common/config/config.h"

namespace deixis::pose_fitter {
namespace {

constexpr std::size_t kMostPeople = 32;
constexpr int kAlone = 6;  // While nobody is followed, there is so much more effort to find people.
constexpr int kEdge_px = 2;  // Regions that are nearer to the picture's edge are cut.
constexpr double kOtherStature = 1.3, kOtherBuild = 1.3;  // Standard deviations.
constexpr double kMoved_m = 0.04, kMovedSigmas = 3.0;     // From here on a pixel has moved.
constexpr double kHopeless = 1.3;    // Times the worst score: no other body mends it.
constexpr double kSameHead_m = 0.3;  // Between the head of a body and one that is seen.
constexpr double kShortest_m = 1.4, kTallest_m = 2.05;  // Statures that a head's height may tell.

}  // namespace

void PoseFitterConfig::Validate() const {
  config::Faults faults;
  faults.Require(stature_m == 0.0 || (stature_m > 0.5 && stature_m < 2.6), "stature_m",
                 "must be 0 (not known) or 0.5..2.6");
  faults.Require(stature_sigma_m > 0.0, "stature_sigma_m", "must be positive");
  faults.Require(guessed_sigma_m > 0.0, "guessed_sigma_m", "must be positive");
  faults.Require(search_s >= 0.0, "search_s", "must not be negative");
  faults.Require(most_taken >= 0.0 && most_taken <= 1.0, "most_taken", "must be 0..1");
  faults.ThrowIfAny();
}

PoseFitter::PoseFitter(const PoseFitterConfig& config)
    : config_(config),
      maker_(config.body_model),
      sound_(config.sound),
      floor_tracker_(config.floor),
      background_(config.background),
      finder_(config.people),
      starter_(config.start, config.evidence, config.fit),
      tracks_(config.tracks),
      parts_(config.cues),
      searched_(config.search_s) {}

const body_model::BodyPoses& PoseFitter::Track(const images::DepthImage& image,
                                               const geometry::StereoCalibration& calibration) {
  view_.Update(DepthCameraOf(calibration, image.depth_mm.size()), image.depth_mm);
  const double time_s = 1e-6 * static_cast<double>(image.time.microseconds);
  const double seconds = last_time_ ? SecondsBetween(*last_time_, image.time) : 0.0;
  if (seconds <= 0.0 || seconds > config_.tracks.hidden_time_s) Forget();
  last_time_ = image.time;
  const auto& is_sound = sound_.Find(view_);
  floor_ = floor_tracker_.Update(view_, is_sound, time_s);
  const auto& published = calibration.rectified;
  ShareCues(parts_.At(image.time, image.camera,
                      Eigen::Vector2d(published.width_px, published.height_px), view_));
  const auto& foreground = background_.Foreground(view_, is_sound);
  FollowAll(foreground, seconds, time_s);
  FindNew(foreground, time_s);
  LearnRoom(is_sound, seconds);
  Number(time_s);
  Report(image);
  return poses_;
}

// Each goes to the person who is nearest to it in reaches, if anybody can have it: at the distance
// that is measured there, or, when that is of something before or behind, at any.
void PoseFitter::ShareCues(const std::vector<PartCue>& cues) {
  own_cues_.resize(people_.size());
  for (auto& own : own_cues_) own.clear();
  for (PartCue cue : cues) {
    auto* owner = OwnerOf(cue);
    if (owner == nullptr && cue.distance_m) {
      cue.distance_m.reset();
      cue.trust = std::min(cue.trust, config_.cues.elsewhere_trust);
      owner = OwnerOf(cue);
    }
    if (owner != nullptr) owner->push_back(cue);
  }
}

std::vector<PartCue>* PoseFitter::OwnerOf(const PartCue& cue) {
  std::vector<PartCue>* owner = nullptr;
  double least = 1.0;
  for (std::size_t i = 0; i < people_.size(); ++i) {
    const double reaches = people_[i]->Reaches(cue);
    if (reaches > least) continue;
    least = reaches;
    owner = &own_cues_[i];
  }
  return owner;
}

// What limbs are on is no room, however long they stay there.
void PoseFitter::LearnRoom(const std::vector<std::uint8_t>& is_sound, double seconds) {
  occupied_.assign(view_.z_m().size(), 0);
  for (const auto& person : people_) person->MarkLimbs(occupied_);
  background_.Learn(view_, is_sound, occupied_, seconds);
}

void PoseFitter::FollowAll(const std::vector<std::uint8_t>& foreground, double seconds,
                           double time_s) {
  const auto is_forgotten = [&](const GonePerson& one) {
    return time_s < one.time_s || time_s - one.time_s > config_.tracks.hidden_time_s;
  };
  gone_.erase(std::remove_if(gone_.begin(), gone_.end(), is_forgotten), gone_.end());
  taken_.assign(view_.z_m().size(), 0);
  for (std::size_t i = 0; i < people_.size(); ++i) {
    people_[i]->Follow(view_, floor_, {&taken_, &foreground, &own_cues_[i]}, seconds);
    Take(i);
  }
  const auto gone = [this](const auto& person) {
    return person->unseen_s() > config_.tracks.hidden_time_s || person->IsNobody();
  };
  for (const auto& person : people_) {
    if (gone(person)) gone_.push_back({person->best().pose, time_s});
  }
  const auto kept = std::remove_if(people_.begin(), people_.end(), gone);
  if (kept == people_.end()) return;
  people_.erase(kept, people_.end());
  taken_.assign(taken_.size(), 0);  // Places have changed.
  for (std::size_t i = 0; i < people_.size(); ++i) Take(i);
}

void PoseFitter::Take(std::size_t person) {
  const cv::Mat& body = people_[person]->evidence().body();
  const auto mark = static_cast<std::uint8_t>(1 + person);
  for (int v = 0; v < body.rows; ++v) {
    const auto* row = body.ptr<std::uint8_t>(v);
    auto* out = taken_.data() + static_cast<std::ptrdiff_t>(v) * body.cols;
    for (int u = 0; u < body.cols; ++u) {
      if (row[u] != 0) out[u] = mark;
    }
  }
}

// What there is to do is spread over images: the search goes on in the next one until all regions
// had their turn, and then begins anew some time later.
void PoseFitter::FindNew(const std::vector<std::uint8_t>& is_sound, double time_s) {
  const bool is_due =
      !last_search_s_ || time_s < *last_search_s_ || time_s - *last_search_s_ >= config_.search_s;
  if (!is_due && !quest_) return;
  finder_.Find(view_, is_sound, floor_);
  SeeHeads();
  NoteDepth(time_s);
  Effort effort{people_.empty() ? kAlone * config_.start.effort : config_.start.effort};
  if (quest_) Search(time_s, effort);
  for (const PersonRegion& region : finder_.regions().regions) {
    if (effort.left <= 0) return;
    Meet(region, time_s, effort);
  }
  if (!quest_) last_search_s_ = time_s;
}

// A region that nobody has yet may be somebody new; one of a person who is badly explained may tell
// of another pose.
void PoseFitter::Meet(const PersonRegion& region, double time_s, Effort& effort) {
  if (!searched_.IsDue(region.centroid_m, time_s)) return;
  std::vector<int> by_person(kMostPeople + 1, 0);
  const int taken = TakenPixels(region, by_person);
  const PeopleRegions& regions = finder_.regions();
  if (taken > config_.most_taken * region.pixel_count) {
    const auto most = std::max_element(by_person.begin() + 1, by_person.end());
    const FollowedPerson& owner = *people_[static_cast<std::size_t>(most - by_person.begin() - 1)];
    if (owner.id < 0 || !(owner.IsDoubtful() || HasStrayHead(region))) return;
    quest_ = {region.centroid_m, {}, owner.id, false};
    starter_.Begin(view_, regions, region, owner.model(), Sought::kOtherPoses);
  } else {
    if (people_.size() >= kMostPeople) return;
    quest_ = {region.centroid_m, BodiesOf(region), -1, MovedShare(region) >= config_.least_moved};
    starter_.Begin(view_, regions, region, quest_->bodies.front().model);
  }
  Search(time_s, effort);
}

void PoseFitter::Search(double time_s, Effort& effort) {
  starter_.Advance(view_, finder_.regions(), effort);
  if (starter_.IsBusy()) return;
  Conclude(time_s);
  quest_.reset();
}

void PoseFitter::Conclude(double time_s) {
  auto starts = starter_.TakeFound();
  if (quest_->bodies.empty()) {
    DropNobodies(starts);
    for (const auto& person : people_) {
      if (person->id == quest_->owner) person->AddRivals(std::move(starts));
    }
    searched_.NoteFound(quest_->centre_m, time_s);
    return;
  }
  const std::size_t body = Dress(starts);
  if (!starts.empty()) Recall(starts);
  std::optional<FollowedPerson> somebody;
  if (!starts.empty()) {
    somebody.emplace(FollowSettings{config_.follow,
                                    config_.start,
                                    config_.limbs,
                                    config_.evidence,
                                    {config_.method, config_.fit, config_.limb_icp},
                                    config_.shape},
                     quest_->bodies[body], maker_.plan(), std::move(starts));
  }
  if (!somebody || IsOfSomebody(*somebody)) {
    searched_.NoteInVain(quest_->centre_m, time_s);
    return;
  }
  searched_.NoteFound(quest_->centre_m, time_s);
  people_.push_back(std::make_unique<FollowedPerson>(std::move(*somebody)));
  people_.back()->Look(view_, floor_);
  Take(people_.size() - 1);
}

void PoseFitter::Forget() {
  people_.clear();
  gone_.clear();
  noted_time_s_.reset();
  noted_m_.clear();
  moved_from_m_.clear();
  quest_.reset();
  searched_.Clear();
  last_search_s_.reset();
}

/// For what has moved since about the last search.
void PoseFitter::NoteDepth(double time_s) {
  if (noted_time_s_ && time_s >= *noted_time_s_ && time_s - *noted_time_s_ < config_.search_s) {
    return;
  }
  noted_time_s_ = time_s;
  moved_from_m_.swap(noted_m_);
  noted_m_ = view_.z_m();
}

void PoseFitter::SeeHeads() {
  const auto& heads = finder_.regions().heads;
  for (const auto& person : people_) {
    const auto own_m = person->HeadMiddle_m();
    person->SeeHead(own_m && std::any_of(heads.begin(), heads.end(), [&](const HeadShape& head) {
                      return head.likeness >= config_.start.least_head &&
                             (*own_m - head.middle_m).norm() < kSameHead_m;
                    }));
  }
}

/// Who was lost here and is found again looks where he looked: front and back are much alike.
void PoseFitter::Recall(std::vector<Hypothesis>& starts) const {
  for (const GonePerson& gone : gone_) {
    for (Hypothesis& start : starts) {
      const Eigen::Vector3d apart_m =
          start.pose.frame_from_root.translation_m - gone.pose.frame_from_root.translation_m;
      if (apart_m.norm() > config_.tracks.largest_gate_m || !IsTurnedAbout(start.pose, gone.pose)) {
        continue;
      }
      start.handicap = config_.follow.turned_about;
      start.mean_score += start.handicap;
    }
  }
}

/// Of the pixels of a region; 0 where nothing is known of before.
double PoseFitter::MovedShare(const PersonRegion& region) const {
  const auto& labels = finder_.regions().labels;
  if (moved_from_m_.size() != labels.size()) return 0.0;
  int moved = 0, known = 0;
  for (std::size_t i = 0; i < labels.size(); ++i) {
    if (labels[i] != region.label || moved_from_m_[i] <= 0.0F) continue;
    const auto now_m = static_cast<double>(view_.z_m()[i]);
    const double moved_m = std::abs(now_m - static_cast<double>(moved_from_m_[i]));
    ++known;
    moved += moved_m > kMoved_m + kMovedSigmas * view_.camera().noise.Sigma_m(now_m) ? 1 : 0;
  }
  return known > 0 ? static_cast<double>(moved) / known : 0.0;
}

/// Tries the start poses in the other bodies that the person may have; the one that suits best, and
/// its poses in `starts`, none of which is left where nobody is there. Who is explained badly, but
/// for the head, is somebody only if he moves.
std::size_t PoseFitter::Dress(std::vector<Hypothesis>& starts) {
  const auto best_of = [](const std::vector<Hypothesis>& poses) {
    double best = 1e9;
    for (const Hypothesis& pose : poses) best = std::min(best, pose.mean_score);
    return best;
  };
  std::size_t body = 0;
  const std::vector<Hypothesis> first = starts;
  const bool is_hopeless = best_of(first) > kHopeless * config_.start.worst_with_head;
  for (std::size_t i = 1; i < quest_->bodies.size() && !is_hopeless; ++i) {
    auto poses = starter_.Wear(view_, finder_.regions(), first, quest_->bodies.front().model,
                               quest_->bodies[i].model);
    if (best_of(poses) > best_of(starts) - config_.start.better_body) continue;
    starts = std::move(poses);
    body = i;
  }
  DropNobodies(starts);
  if (quest_->moves) return body;
  const auto is_still = [this](const Hypothesis& start) {
    return start.mean_score > config_.start.worst_score;
  };
  starts.erase(std::remove_if(starts.begin(), starts.end(), is_still), starts.end());
  return body;
}

/// Whether it is a part of somebody who is followed already: its head would be below his.
bool PoseFitter::IsOfSomebody(FollowedPerson& other) const {
  const auto other_m = other.HeadMiddle_m();
  const Eigen::Vector3d up = floor_ ? floor_->normal : Eigen::Vector3d(-Eigen::Vector3d::UnitY());
  return other_m && std::any_of(people_.begin(), people_.end(), [&](const auto& person) {
           const auto head_m = person->HeadMiddle_m();
           return head_m && IsBelowHead(*other_m, *head_m, up);
         });
}

/// Whether there is a head in it that is nobody's.
bool PoseFitter::HasStrayHead(const PersonRegion& region) const {
  const PeopleRegions& regions = finder_.regions();
  return std::any_of(regions.heads.begin(), regions.heads.end(), [&](const HeadShape& head) {
    const auto middle = static_cast<std::size_t>(head.v_px * view_.width_px() + head.u_px);
    if (head.likeness < config_.people.least_head || regions.labels[middle] != region.label) {
      return false;
    }
    return std::none_of(people_.begin(), people_.end(), [&head](const auto& person) {
      const auto own_m = person->HeadMiddle_m();
      return own_m && (*own_m - head.middle_m).norm() < kSameHead_m;
    });
  });
}

/// Bodies that somebody may have, the likeliest first. Whose stature nobody said may be tall or
/// short, unless it is seen how high his head is, and slim or stout.
std::vector<PersonBody> PoseFitter::BodiesOf(const PersonRegion& region) const {
  if (config_.stature_m > 0.0) {
    return {maker_.Make(config_.stature_m, config_.stature_sigma_m)};
  }
  const int below_px = view_.height_px() - (region.box_px.y + region.box_px.height);
  const bool is_whole = floor_ || (region.box_px.y > kEdge_px && below_px > kEdge_px);
  const bool tells = is_whole && region.top_m > kShortest_m && region.top_m < kTallest_m;
  const PersonBody anybody = maker_.Make(std::nullopt, 0.0);
  const double mean_m = anybody.estimate.Length_m("kph");
  const double spread_m = anybody.estimate.Spread_m("kph");
  std::vector<PersonBody> bodies{tells ? maker_.Make(region.top_m, config_.guessed_sigma_m)
                                       : anybody};
  for (const double build : {-kOtherBuild, kOtherBuild}) {
    bodies.push_back(tells ? maker_.Make(region.top_m, config_.guessed_sigma_m, build)
                           : maker_.Make(std::nullopt, 0.0, build));
  }
  if (tells && floor_) return bodies;
  for (const double stature : {-kOtherStature, kOtherStature}) {
    for (const double build : {-kOtherBuild, 0.0}) {
      bodies.push_back(maker_.Make(mean_m + stature * spread_m, config_.guessed_sigma_m, build));
    }
  }
  return bodies;
}

int PoseFitter::TakenPixels(const PersonRegion& region, std::vector<int>& by_person) const {
  const auto& labels = finder_.regions().labels;
  int taken = 0;
  for (std::size_t i = 0; i < labels.size(); ++i) {
    if (labels[i] != region.label || taken_[i] == 0) continue;
    ++by_person[taken_[i]];
    ++taken;
  }
  return taken;
}

void PoseFitter::Number(double time_s) {
  std::vector<PersonSighting> sightings;
  for (const auto& person : people_) {
    sightings.push_back({person->best().pose.frame_from_root.translation_m, person->id, true});
  }
  const auto& ids = tracks_.Update(sightings, time_s);
  for (std::size_t i = 0; i < people_.size(); ++i) people_[i]->id = ids[i];
}

std::vector<body_model::PersonModel> PoseFitter::Models() const {
  std::vector<body_model::PersonModel> models;
  for (const auto& person : people_) {
    if (person->id >= 0) models.push_back(person->DescribeModel(*last_time_));
  }
  return models;
}

void PoseFitter::Report(const images::DepthImage& image) {
  poses_.time = image.time;
  poses_.camera = image.camera;
  poses_.frame = image.camera;
  poses_.source = "pose_fitter";
  poses_.floor = floor_;
  poses_.bodies.clear();
  for (const auto& person : people_) {
    if (person->id >= 0) poses_.bodies.push_back(person->Describe());
  }
  std::sort(poses_.bodies.begin(), poses_.bodies.end(),
            [](const auto& a, const auto& b) { return a.person_id < b.person_id; });
}

}  // namespace deixis::pose_fitter
