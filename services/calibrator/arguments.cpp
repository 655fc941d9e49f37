#include "services/calibrator/arguments.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <map>

#include "common/program/command_line.h"

namespace deixis::calibrator {
namespace {

/// Texts that still have to be read.
struct Texts {
  std::string chessboard;
  std::string charuco;
  std::string size;
  std::string model = "plumb_bob";
  double still_px = -1.0;
  double change_percent = -1.0;
  bool may_replace = false;
  bool has_fixed_lenses = false;
};

bool IsCount(const std::string& text) {
  constexpr std::size_t kMostDigits = 5;
  return !text.empty() && text.size() <= kMostDigits &&
         std::all_of(text.begin(), text.end(), [](char c) { return c >= '0' && c <= '9'; });
}

cv::Size ParseSize(const std::string& text, const std::string& option) {
  const auto cross = text.find('x');
  const std::string columns = text.substr(0, cross);
  const std::string rows = cross == std::string::npos ? "" : text.substr(cross + 1);
  if (!IsCount(columns) || !IsCount(rows)) {
    throw CLI::ValidationError(option, "'" + text + "' is not of the form 9x6");
  }
  return {std::stoi(columns), std::stoi(rows)};
}

void AddBoard(CLI::App& app, Arguments& arguments, Texts& texts) {
  auto* chessboard = app.add_option(
      "--board", texts.chessboard,
      "Chessboard by its inner corners, per row x rows (9x6; best one odd, one even)");
  app.add_option("--charuco", texts.charuco, "ChArUco board by its squares, per row x rows (7x5)")
      ->excludes(chessboard);
  app.add_option("--square", arguments.board.square_m, "Side of a square, metres")->required();
  app.add_option("--marker", arguments.board.marker_m, "ChArUco: side of a marker, metres");
  app.add_option("--dictionary", arguments.board.dictionary, "ChArUco: markers")
      ->capture_default_str();
}

void AddStreams(CLI::App& app, Arguments& arguments, Texts& texts) {
  FeedArguments& feed = arguments.feed;
  app.add_option(
      "--source", feed.source,
      "device:0, url:..., video:FILE or folder:DIR, as config/camera_driver.yaml has it");
  app.add_option("--channel", feed.channel,
                 "Channel of the bus (camera: CAMERA, stereo: STEREO_PAIR)");
  app.add_option("-l,--lcm-url", feed.lcm_url,
                 "LCM URL (default: $LCM_DEFAULT_URL, else LCM's own); file://LOG reads a log");
  app.add_option("--size", texts.size, "Picture size asked of a device: 640x480");
  app.add_option("--rate", feed.device_rate_hz, "Rate asked of a device, Hz")
      ->check(CLI::NonNegativeNumber);
  app.add_option("--fourcc", feed.device_fourcc, "Pixel format asked of a device: MJPG");
  app.add_option("--views", arguments.most_views, "Streams: stop after so many views")
      ->check(CLI::Range(3, 500))
      ->capture_default_str();
  app.add_option("--seconds", arguments.seconds, "Streams: stop after so many seconds")
      ->check(CLI::NonNegativeNumber);
  app.add_option(
         "--most-motion-px", texts.still_px,
         "Streams: corners may move so far from picture to picture (default: 1/400 of the width)")
      ->check(CLI::NonNegativeNumber);
}

void AddFit(CLI::App& app, Arguments& arguments, Texts& texts) {
  app.add_option("--model", texts.model,
                 "Lens model; auto: the best on views left out; fisheye: not for stereo")
      ->check(CLI::IsMember({"plumb_bob", "rational", "fisheye", "auto"}))
      ->capture_default_str();
  app.add_flag("--fix-aspect", arguments.calibration.lens.has_fixed_aspect, "fx = fy");
  app.add_flag("--zero-tangent", arguments.calibration.lens.has_zero_tangent, "p1 = p2 = 0");
  app.add_option("--least-change", texts.change_percent,
                 "Views are too similar when corners lie nearer, % of the width (files and folders "
                 "without times 2, streams 6)")
      ->check(CLI::Range(0.0, 50.0));
  app.add_option("--most-edge-px", arguments.selection.most_edge_px,
                 "Wider edges are blurred (default: 4, or 1/200 of the width)")
      ->check(CLI::NonNegativeNumber);
}

void AddOutput(CLI::App& app, Arguments& arguments, Texts& texts) {
  Demands& demands = arguments.demands;
  app.add_option("--least-views", demands.views, "Fewer are not enough")
      ->check(CLI::Range(3, 500))
      ->capture_default_str();
  app.add_option("--most-error-px", demands.error_px, "A larger reprojection error is refused")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  app.add_option("--save", arguments.save, "Folder for pictures: corners, coverage, residuals");
  app.add_option("--time", arguments.time,
                 "Text for calibration_time (left out without: same input, same bytes)");
  app.add_flag("--force", texts.may_replace, "Replace files that are there");
  app.add_flag("--accept-poor", arguments.permissions.may_write_poor,
               "Write what would be refused, too, and mark it");
}

CLI::App* AddCamera(CLI::App& app, Arguments& arguments, Texts& texts) {
  CLI::App* camera = app.add_subcommand("camera", "Calibrates one camera");
  AddBoard(*camera, arguments, texts);
  camera->add_option("--pictures", arguments.feed.left, "Picture files, or patterns of them");
  AddStreams(*camera, arguments, texts);
  AddFit(*camera, arguments, texts);
  camera->add_option("-o,--output", arguments.output, "File to write: camera.yml")->required();
  AddOutput(*camera, arguments, texts);
  return camera;
}

CLI::App* AddStereo(CLI::App& app, Arguments& arguments, Texts& texts) {
  CLI::App* stereo = app.add_subcommand("stereo", "Calibrates two cameras that stand side by side");
  AddBoard(*stereo, arguments, texts);
  stereo->add_option("--left", arguments.feed.left, "The left camera's files, or patterns of them");
  stereo->add_option("--right", arguments.feed.right, "The right camera's, in the same order");
  AddStreams(*stereo, arguments, texts);
  stereo->add_option("--right-source", arguments.feed.right_source,
                     "The right camera's source, when --source is the left one's");
  stereo->add_flag("--side-by-side", arguments.feed.is_side_by_side,
                   "--source gives both cameras in one picture");
  AddFit(*stereo, arguments, texts);
  stereo->add_flag("--fixed-lenses", texts.has_fixed_lenses,
                   "Keep each camera's own lens: only the cameras' places are fitted together");
  stereo
      ->add_option("--alpha", arguments.calibration.alpha,
                   "Rectified pictures: 0 = only pixels that both have, 1 = all of them")
      ->check(CLI::Range(0.0, 1.0));
  stereo
      ->add_option("-o,--output", arguments.output,
                   "Folder to write intrinsics.yml and extrinsics.yml to")
      ->required();
  AddOutput(*stereo, arguments, texts);
  return stereo;
}

CLI::App* AddPrint(CLI::App& app, Arguments& arguments, Texts& texts) {
  CLI::App* print = app.add_subcommand("board", "Writes a board to print, in its true size");
  AddBoard(*print, arguments, texts);
  print->add_option("--print", arguments.output, "File to write: .pdf or .png")->required();
  print->add_flag("--force", texts.may_replace, "Replace a file that is there");
  return print;
}

void ReadBoard(const Texts& texts, Arguments& arguments) {
  if (texts.chessboard.empty() == texts.charuco.empty()) {
    throw CLI::ValidationError("--board", "give --board or --charuco");
  }
  const bool is_chessboard = texts.charuco.empty();
  arguments.board.kind = is_chessboard ? BoardKind::kChessboard : BoardKind::kCharuco;
  arguments.board.count = is_chessboard ? ParseSize(texts.chessboard, "--board")
                                        : ParseSize(texts.charuco, "--charuco");
  try {
    MakeBoard(arguments.board);
  } catch (const std::invalid_argument& error) {
    throw CLI::ValidationError(error.what());
  }
}

void RequireOneFeed(const Arguments& arguments) {
  const FeedArguments& feed = arguments.feed;
  const bool is_stereo = arguments.task == Task::kStereo;
  const std::string files = is_stereo ? "--left and --right" : "--pictures";
  const int given = static_cast<int>(!feed.left.empty() || !feed.right.empty()) +
                    static_cast<int>(!feed.source.empty()) +
                    static_cast<int>(!feed.channel.empty());
  if (given != 1) {
    throw CLI::ValidationError("pictures", "give one of " + files + ", --source, --channel");
  }
  if (!is_stereo) return;
  if (feed.left.empty() != feed.right.empty()) {
    throw CLI::ValidationError("--left", "goes with --right");
  }
  const bool has_two = feed.is_side_by_side != !feed.right_source.empty();
  if (!feed.source.empty() && !has_two) {
    throw CLI::ValidationError("--source", "needs --right-source or --side-by-side");
  }
  if (feed.source.empty() && (feed.is_side_by_side || !feed.right_source.empty())) {
    throw CLI::ValidationError("--source", "is missing");
  }
}

void ReadModel(const Texts& texts, Task task, CalibrationOptions& options) {
  static const std::map<std::string, LensModel> kModels{{"plumb_bob", LensModel::kPlumbBob},
                                                        {"rational", LensModel::kRational},
                                                        {"fisheye", LensModel::kFisheye}};
  if (task == Task::kStereo && texts.model == "fisheye") {
    throw CLI::ValidationError("--model",
                               "a stereo pair's lenses must be plumb_bob, rational or auto: the "
                               "stereo driver takes no fisheye");
  }
  if (texts.model == "auto") {
    options.choice = ModelChoice::kByCrossValidation;
  } else {
    options.lens.model = kModels.at(texts.model);
  }
}

void ReadTexts(const Texts& texts, Arguments& arguments) {
  ReadBoard(texts, arguments);
  arguments.permissions.existing = texts.may_replace ? Existing::kReplace : Existing::kKeep;
  if (arguments.task == Task::kPrintBoard) {
    const auto ending = arguments.output.extension();
    if (ending == ".pdf" || ending == ".png") return;
    throw CLI::ValidationError("--print", "the file's name must end in .pdf or .png");
  }
  RequireOneFeed(arguments);
  ReadModel(texts, arguments.task, arguments.calibration);
  if (texts.has_fixed_lenses) arguments.calibration.refinement = Refinement::kPlacesOnly;
  if (!texts.size.empty()) arguments.feed.device_size = ParseSize(texts.size, "--size");
  if (texts.change_percent >= 0.0) arguments.least_change = texts.change_percent / 100.0;
  arguments.selection.most_motion_px = texts.still_px;
}

}  // namespace

ParsedArguments ParseArguments(int argc, const char* const* argv) {
  ParsedArguments parsed;
  Texts texts;
  // `deixis calibrate` runs this program under its own name: that is what people have to type.
  CLI::App app("Calibrates one camera, or two, from a chessboard or a ChArUco board.",
               std::filesystem::path(argv[0]).filename().string());
  app.set_version_flag("--version", "deixis-calibrator " DEIXIS_VERSION);
  app.require_subcommand(1);
  AddCamera(app, parsed.arguments, texts);
  const CLI::App* stereo = AddStereo(app, parsed.arguments, texts);
  const CLI::App* print = AddPrint(app, parsed.arguments, texts);
  try {
    app.parse(argc, argv);
    if (stereo->parsed()) parsed.arguments.task = Task::kStereo;
    if (print->parsed()) parsed.arguments.task = Task::kPrintBoard;
    ReadTexts(texts, parsed.arguments);
  } catch (const CLI::ParseError& error) {
    parsed.exit_code = app.exit(error) == 0 ? program::kStopped : program::kWrongCommand;
  }
  return parsed;
}

}  // namespace deixis::calibrator
