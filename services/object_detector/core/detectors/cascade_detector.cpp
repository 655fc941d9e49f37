#include "services/object_detector/core/detectors/cascade_detector.h"

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>
#include <optional>
#include <utility>

#include "common/config/plain_text.h"

namespace deixis::object_detector {
namespace {

using scene::Box;

constexpr double kSearchMargin = 0.5;   // Share of the box on each side where it is looked for.
constexpr double kSmallerLimit = 0.75;  // Band of sizes around the known one.
constexpr double kLargerLimit = 1.34;
constexpr double kFineScaleStep = 1.1;
constexpr std::size_t kMaxChecks = 3;  // New places looked at closely per picture.
constexpr double kTaken = 0.3;         // Overlap from which a place belongs to another track.

cv::Rect SearchArea(const Box& box, cv::Size picture) {
  const double margin_x = kSearchMargin * box.width_px;
  const double margin_y = kSearchMargin * box.height_px;
  const cv::Rect area(static_cast<int>(std::floor(box.x_px - margin_x)),
                      static_cast<int>(std::floor(box.y_px - margin_y)),
                      static_cast<int>(std::ceil(box.width_px + 2.0 * margin_x)),
                      static_cast<int>(std::ceil(box.height_px + 2.0 * margin_y)));
  return area & cv::Rect({0, 0}, picture);
}

/// Which way an object looks, against the pictures that its cascade was trained on.
enum class Facing { kAsTrained, kMirrored };

cv::Mat Mirrored(const cv::Mat& picture) {
  cv::Mat mirrored;
  cv::flip(picture, mirrored, 1);
  return mirrored;
}

/// All answers close to `box`, of about its size, pixels of `grey`.
std::vector<CascadeHit> FindAround(const Box& box, const cv::Mat& grey, int min_neighbours,
                                   Cascade& cascade, Facing facing = Facing::kAsTrained) {
  const cv::Rect area = SearchArea(box, grey.size());
  if (area.empty()) return {};
  const bool is_mirrored = facing == Facing::kMirrored;
  const cv::Mat picture = is_mirrored ? Mirrored(grey(area)) : grey(area);
  std::vector<CascadeHit> hits =
      cascade.Find(picture, kSmallerLimit * box.height_px, kLargerLimit * box.height_px,
                   kFineScaleStep, min_neighbours);
  for (CascadeHit& hit : hits) {
    if (is_mirrored) hit.box.x_px = area.width - hit.box.x_px - hit.box.width_px;
    hit.box.x_px += area.x;
    hit.box.y_px += area.y;
  }
  return hits;
}

bool IsTaken(const Box& box, const std::vector<Box>& taken) {
  return std::any_of(taken.begin(), taken.end(),
                     [&box](const Box& other) { return scene::Overlap(box, other) > kTaken; });
}

/// The free place that is nearest to where the object was.
std::optional<Box> Nearest(const Box& box, const std::vector<CascadeHit>& hits,
                           const std::vector<Box>& taken) {
  std::optional<Box> nearest;
  for (const CascadeHit& hit : hits) {
    if (IsTaken(hit.box, taken)) continue;
    const double distance_px = (scene::Centre(hit.box) - scene::Centre(box)).norm();
    if (!nearest || distance_px < (scene::Centre(*nearest) - scene::Centre(box)).norm()) {
      nearest = hit.box;
    }
  }
  return nearest;
}

bool IsInside(const Box& box, cv::Size picture) {
  const Eigen::Vector2d centre = scene::Centre(box);
  return centre.x() >= 0.0 && centre.y() >= 0.0 && centre.x() < picture.width &&
         centre.y() < picture.height;
}

scene::Visibility VisibilityOf(const ObjectTrack& track, cv::Size picture) {
  if (track.misses_in_a_row == 0) return scene::Visibility::kSeen;
  return IsInside(track.box, picture) ? scene::Visibility::kOccluded
                                      : scene::Visibility::kRemembered;
}

}  // namespace

void CascadesConfig::Check(config::Faults& faults) const {
  for (std::size_t i = 0; i < trained.size(); ++i) {
    const std::string key = "cascades.trained[" + std::to_string(i) + "].";
    faults.Require(config::IsPlainText(trained[i].label), key + "label", config::kPlainTextRule);
    faults.Require(!trained[i].file.empty(), key + "file", "is empty; name a cascade");
    faults.Require(trained[i].neighbours_new >= 1, key + "neighbours_new", "must be at least 1");
    faults.Require(trained[i].neighbours_known >= 1, key + "neighbours_known",
                   "must be at least 1");
  }
  scan.Check(faults);
  tracking.Check(faults);
}

CascadeDetector::CascadeDetector(const CascadeConfig& config, const CascadesConfig& common,
                                 std::function<int()> new_id)
    : config_(config),
      cascade_(config.file, common.folders),
      scan_(common.scan, cascade_.window()),
      tracks_(common.tracking, std::move(new_id)) {
  for (const std::string& file : config.known_also_by) {
    further_cascades_.emplace_back(file, common.folders);
  }
}

std::vector<scene::Object> CascadeDetector::Detect(const GreyPicture& picture) {
  tracks_.Forget(picture.time);
  FollowKnown(picture);
  LookForNew(picture);
  tracks_.Tidy();
  return Told(picture);
}

void CascadeDetector::Reset() {
  tracks_.Reset();
  scan_.Reset();
}

void CascadeDetector::FollowKnown(const GreyPicture& picture) {
  std::vector<Box> taken;
  for (ObjectTrack& track : tracks_.tracks()) {
    const std::vector<CascadeHit> hits = FindKnown(track, picture.grey);
    if (const auto box = Nearest(track.box, hits, taken)) {
      tracks_.Hit(track, *box, picture.time);
      taken.push_back(*box);
    } else {
      tracks_.Miss(track);
    }
  }
}

std::vector<CascadeHit> CascadeDetector::FindKnown(const ObjectTrack& track, const cv::Mat& grey) {
  if (!track.is_confirmed()) return FindAround(track.box, grey, config_.neighbours_new, cascade_);
  const int neighbours = config_.neighbours_known;
  std::vector<CascadeHit> hits = FindAround(track.box, grey, neighbours, cascade_);
  for (Cascade& further : further_cascades_) {
    if (hits.empty()) hits = FindAround(track.box, grey, neighbours, further);
    if (hits.empty()) hits = FindAround(track.box, grey, neighbours, further, Facing::kMirrored);
  }
  return hits;
}

void CascadeDetector::LookForNew(const GreyPicture& picture) {
  std::vector<CascadeHit> places = scan_.Next(picture, cascade_, UrgencyNow());
  const auto is_known = [this](const CascadeHit& place) {
    const auto& tracks = tracks_.tracks();
    return std::any_of(tracks.begin(), tracks.end(), [&place](const ObjectTrack& track) {
      return track.misses_in_a_row == 0 && scene::Overlap(track.box, place.box) > kTaken;
    });
  };
  places.erase(std::remove_if(places.begin(), places.end(), is_known), places.end());
  if (places.size() > kMaxChecks) places.resize(kMaxChecks);
  for (const CascadeHit& place : places) {
    const auto hits = FindAround(place.box, picture.grey, config_.neighbours_new, cascade_);
    if (!hits.empty()) tracks_.Propose(hits.front().box, picture.time);
  }
}

Urgency CascadeDetector::UrgencyNow() {
  const auto& tracks = tracks_.tracks();
  const bool sees_any = std::any_of(tracks.begin(), tracks.end(), [](const ObjectTrack& track) {
    return track.misses_in_a_row == 0;
  });
  return sees_any ? Urgency::kForMore : Urgency::kForAny;
}

std::vector<scene::Object> CascadeDetector::Told(const GreyPicture& picture) {
  std::vector<scene::Object> objects;
  for (const ObjectTrack& track : tracks_.tracks()) {
    if (!track.is_confirmed()) continue;
    scene::Object object;
    object.id = track.id;
    object.label = config_.label;
    object.kind = config_.kind;
    object.box = track.box;
    object.score = track.score;
    object.visibility = VisibilityOf(track, picture.grey.size());
    object.last_seen = track.last_seen;
    objects.push_back(object);
  }
  std::sort(objects.begin(), objects.end(),
            [](const scene::Object& a, const scene::Object& b) { return a.id < b.id; });
  return objects;
}

}  // namespace deixis::object_detector
