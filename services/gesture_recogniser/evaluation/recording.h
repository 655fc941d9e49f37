#pragma once
#include <Eigen/Core>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "common/scene/box.h"
#include "common/scene/hand.h"
#include "common/scene/object.h"

namespace deixis::gesture_recogniser {

/// A labelled pointing gesture; seconds from the recording's start.
struct LabelledGesture {
  double start_s = 0.0;
  double apex_s = 0.0;
  double end_s = 0.0;
  double retract_end_s = 0.0;
  scene::Side side = scene::Side::kUnknown;
  int object_id = -1;
};

/// A hand in one image. True positions have sigma 0; tracked ones bring their own.
struct RecordedHand {
  int id = -1;
  scene::Side side = scene::Side::kUnknown;
  Eigen::Vector2d centre_px = Eigen::Vector2d::Zero();
  double sigma_px = 0.0;
  bool is_measured = true;
  bool is_acting = false;
};

struct RecordedFrame {
  double time_s = 0.0;
  std::optional<scene::Box> face;
  std::vector<RecordedHand> hands;
};

/// Hands, faces, objects and labels of one sequence, as text (names are words without blanks):
///   recording NAME PERSON
///   object ID LABEL X Y WIDTH HEIGHT                      (pixels)
///   gesture START APEX END RETRACT_END SIDE OBJECT        (seconds; left or right; id)
///   frame TIME                                            (seconds; what follows belongs to it)
///   face X Y WIDTH HEIGHT
///   hand ID SIDE U V SIGMA MEASURED ACTING                (pixels; 0 or 1)
struct Recording {
  std::string name;
  std::string person;
  std::vector<scene::Object> objects;
  std::vector<LabelledGesture> gestures;
  std::vector<RecordedFrame> frames;
};

/// Throws config::ConfigError naming file and line.
Recording ReadRecording(const std::filesystem::path& file);

/// All *.recording files of a folder, by name.
std::vector<Recording> ReadRecordings(const std::filesystem::path& folder);

}  // namespace deixis::gesture_recogniser
