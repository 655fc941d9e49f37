#pragma once
#include <functional>
#include <string>
#include <vector>

#include "common/config/config.h"
#include "services/object_detector/core/cascade.h"
#include "services/object_detector/core/detectors/detector.h"
#include "services/object_detector/core/object_kind_names.h"
#include "services/object_detector/core/object_tracks.h"
#include "services/object_detector/core/sliced_scan.h"

namespace deixis::object_detector {

/// One trained cascade and what it finds.
struct CascadeConfig {
  std::string label = "face";                             ///< What it finds.
  scene::ObjectKind kind = scene::ObjectKind::kFace;      ///< Of what kind that is.
  std::string file = "haarcascade_frontalface_alt2.xml";  ///< Path, or name in a cascade folder.
  /// Cascades that may recognise it, too, once it is known: a face that turns. Mirrored as well.
  std::vector<std::string> known_also_by{"haarcascade_profileface.xml"};
  int neighbours_new = 5;    ///< Answers that must agree on a new object.
  int neighbours_known = 2;  ///< The same for one that is followed.

  template <typename Visitor>
  void Visit(Visitor& v) {
    v("label", label);
    v("kind", kind);
    v("file", file);
    v("known_also_by", known_also_by);
    v("neighbours_new", neighbours_new);
    v("neighbours_known", neighbours_known);
  }
};

struct CascadesConfig {
  std::vector<CascadeConfig> trained{{}};  ///< One entry per kind of object; faces by default.
  std::vector<std::string> folders{"/usr/share/opencv4/haarcascades",
                                   "/usr/share/opencv4/lbpcascades"};  ///< Searched for files.
  ScanConfig scan;          ///< How new objects are looked for.
  TrackingConfig tracking;  ///< When they count and how long they are kept.

  template <typename Visitor>
  void Visit(Visitor& v) {
    v("trained", trained);
    v("folders", folders);
    v("scan", scan);
    v("tracking", tracking);
  }
  void Check(config::Faults& faults) const;
};

/// Finds and follows the objects of one cascade (Viola and Jones 2001). Known objects are verified
/// in every picture where they were, in a narrow band of sizes; the rest of the picture is looked
/// through for new ones a slice at a time.
class CascadeDetector final : public Detector {
 public:
  /// Throws ConfigError when the cascade's file cannot be read.
  CascadeDetector(const CascadeConfig& config, const CascadesConfig& common,
                  std::function<int()> new_id);

  std::vector<scene::Object> Detect(const GreyPicture& picture) override;
  void Reset() override;

 private:
  void FollowKnown(const GreyPicture& picture);
  std::vector<CascadeHit> FindKnown(const ObjectTrack& track, const cv::Mat& grey);
  void LookForNew(const GreyPicture& picture);
  Urgency UrgencyNow();
  std::vector<scene::Object> Told(const GreyPicture& picture);

  CascadeConfig config_;
  Cascade cascade_;
  std::vector<Cascade> further_cascades_;
  SlicedScan scan_;
  ObjectTracks tracks_;
};

}  // namespace deixis::object_detector
