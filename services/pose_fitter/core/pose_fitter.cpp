#include "services/pose_fitter/core/pose_fitter.h"

#include <algorithm>

#include "common/config/config.h"

namespace deixis::pose_fitter {
namespace {

constexpr std::size_t kMostPeople = 32;
constexpr int kAlone = 6;  // While nobody is followed, there is so much more effort to find people.
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
  FollowAll(foreground, seconds);
  FindNew(foreground, time_s);
  LearnRoom(is_sound, seconds);
  Number(time_s);
  Report(image);
  return poses_;
}

// Each goes to the person who is nearest to it in reaches, if anybody can have it: at the distance
// that is measured there, or, when that is of something before or behind, at any.
void PoseFitter::ShareCues(const std::vector<PartCue>& cues) {
  free_cues_.clear();
  own_cues_.resize(people_.size());
  for (auto& own : own_cues_) own.clear();
  for (PartCue cue : cues) {
    auto* owner = OwnerOf(cue);
    if (owner == nullptr && cue.distance_m) {
      cue.distance_m.reset();
      cue.trust = std::min(cue.trust, config_.cues.elsewhere_trust);
      owner = OwnerOf(cue);
    }
    (owner == nullptr ? free_cues_ : *owner).push_back(cue);
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

void PoseFitter::FollowAll(const std::vector<std::uint8_t>& foreground, double seconds) {
  taken_.assign(view_.z_m().size(), 0);
  for (std::size_t i = 0; i < people_.size(); ++i) {
    people_[i]->Follow(view_, floor_, {&taken_, &foreground, &own_cues_[i]}, seconds);
    Take(i);
  }
  const auto gone = [this](const auto& person) {
    return person->unseen_s() > config_.tracks.hidden_time_s || person->IsNobody();
  };
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
    if (!owner.IsDoubtful() || owner.id < 0) return;
    quest_ = {region.centroid_m, std::nullopt, owner.id};
    starter_.Begin(view_, regions, region, owner.model());
  } else {
    if (people_.size() >= kMostPeople) return;
    quest_ = {region.centroid_m, BodyOf(region), -1};
    starter_.Begin(view_, regions, region, quest_->body->model);
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
  if (!quest_->body) {
    for (const auto& person : people_) {
      if (person->id == quest_->owner) person->AddRivals(std::move(starts));
    }
    searched_.NoteFound(quest_->centre_m, time_s);
    return;
  }
  if (starts.empty()) {
    searched_.NoteInVain(quest_->centre_m, time_s);
    return;
  }
  searched_.NoteFound(quest_->centre_m, time_s);
  people_.push_back(std::make_unique<FollowedPerson>(
      FollowSettings{config_.follow,
                     config_.start,
                     config_.limbs,
                     config_.evidence,
                     {config_.method, config_.fit, config_.limb_icp},
                     config_.shape},
      *quest_->body, maker_.plan(), std::move(starts)));
  people_.back()->Look(view_, floor_);
  Take(people_.size() - 1);
}

void PoseFitter::Forget() {
  people_.clear();
  quest_.reset();
  searched_.Clear();
  last_search_s_.reset();
}

PersonBody PoseFitter::BodyOf(const PersonRegion& region) const {
  if (config_.stature_m > 0.0) return maker_.Make(config_.stature_m, config_.stature_sigma_m);
  const bool tells = floor_ && region.top_m > kShortest_m && region.top_m < kTallest_m;
  if (!tells) return maker_.Make(std::nullopt, 0.0);
  return maker_.Make(region.top_m, config_.guessed_sigma_m);
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
