#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "services/calibrator/core/calibration.h"
#include "services/calibrator/core/calibration_files.h"
#include "services/calibrator/core/verdict.h"
#include "services/calibrator/core/view_selection.h"

namespace deixis::calibrator {

enum class Task { kCamera, kStereo, kPrintBoard };

/// Where pictures come from: exactly one of files, source and channel.
struct FeedArguments {
  std::vector<std::string> left;  ///< Files; one camera: its pictures.
  std::vector<std::string> right;
  std::string source;
  std::string right_source;
  bool is_side_by_side = false;
  std::string channel;
  std::string lcm_url;
  cv::Size device_size;  ///< Asked of a device; zeros = its own choice.
  double device_rate_hz = 0.0;
  std::string device_fourcc;
};

/// What --force and --accept-poor allow.
struct Permissions {
  Existing existing = Existing::kKeep;
  bool may_write_poor = false;  ///< --accept-poor
};

struct Arguments {
  Task task = Task::kCamera;
  BoardConfig board;
  FeedArguments feed;
  SelectionConfig selection;  ///< least_change as `least_change` below says.
  /// Mean way of the corners from every earlier view, of the width; nothing = by the feed's kind.
  std::optional<double> least_change;
  CalibrationOptions calibration;
  Demands demands;
  int most_views = 40;   ///< Streams: enough.
  double seconds = 0.0;  ///< Streams: time for collecting, by their own clock; 0 = no limit.
  std::filesystem::path output;  ///< File, or for stereo a folder; for a board the file to print.
  std::filesystem::path save;    ///< Folder for pictures; empty = none.
  std::string time;
  Permissions permissions;
};

/// Reads the command line. Where it asks for help or is wrong, prints what is due and gives the
/// exit code instead.
struct ParsedArguments {
  Arguments arguments;
  std::optional<int> exit_code;
};
ParsedArguments ParseArguments(int argc, const char* const* argv);

}  // namespace deixis::calibrator
