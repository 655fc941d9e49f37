#include "services/calibrator/session.h"

#include <stdexcept>

#include "common/config/config.h"
#include "common/program/command_line.h"
#include "common/transport/url.h"
#include "services/calibrator/collection.h"
#include "services/calibrator/core/board_print.h"
#include "services/calibrator/feeds/bus_feed.h"
#include "services/calibrator/feeds/file_feed.h"
#include "services/calibrator/feeds/source_feed.h"
#include "services/calibrator/report.h"

namespace deixis::calibrator {
namespace {

std::unique_ptr<Feed> FileFeedOf(const FeedArguments& feed, Task task) {
  if (task == Task::kCamera) {
    return std::make_unique<FileFeed>(
        std::vector<std::vector<std::filesystem::path>>{FilesOf(feed.left, "--pictures")});
  }
  return std::make_unique<FileFeed>(std::vector<std::vector<std::filesystem::path>>{
      FilesOf(feed.left, "--left"), FilesOf(feed.right, "--right")});
}

capture::SourceConfig SourceConfigOf(const FeedArguments& feed, const std::string& text,
                                     const std::string& option) {
  capture::SourceConfig config = ParseSource(text, option);
  config.width_px = feed.device_size.width;
  config.height_px = feed.device_size.height;
  config.fourcc = feed.device_fourcc;
  config.rate_hz = feed.device_rate_hz;
  return config;
}

std::unique_ptr<Feed> SourceFeedOf(const FeedArguments& feed) {
  std::vector<capture::SourceConfig> configs{SourceConfigOf(feed, feed.source, "--source")};
  if (!feed.right_source.empty()) {
    configs.push_back(SourceConfigOf(feed, feed.right_source, "--right-source"));
  }
  TimeByOrderUnlessAllHaveTimes(configs);
  const FeedKind kind = KindOf(configs);
  if (configs.size() == 2) {
    return std::make_unique<TwoSourceFeed>(OpenSource(configs[0]), OpenSource(configs[1]), kind);
  }
  const auto layout = feed.is_side_by_side ? PictureLayout::kSideBySide : PictureLayout::kOneCamera;
  return std::make_unique<SourceFeed>(OpenSource(configs[0]), layout, kind);
}

std::unique_ptr<Feed> BusFeedOf(const FeedArguments& feed, Task task) {
  transport::BusOptions options;
  options.url = feed.lcm_url;
  const transport::Url url = transport::ResolveUrl(feed.lcm_url, options.receive_buffer_bytes);
  options.deliver_every_message = url.provider == "file";
  return std::make_unique<BusFeed>(std::make_unique<transport::Bus>(options), feed.channel,
                                   task == Task::kStereo ? 2 : 1);
}

std::unique_ptr<Feed> FeedOf(const Arguments& arguments) {
  const FeedArguments& feed = arguments.feed;
  if (!feed.left.empty()) return FileFeedOf(feed, arguments.task);
  if (!feed.source.empty()) return SourceFeedOf(feed);
  return BusFeedOf(feed, arguments.task);
}

std::vector<std::filesystem::path> FilesToWrite(const Arguments& arguments) {
  if (arguments.task != Task::kStereo) return {arguments.output};
  return {arguments.output / "intrinsics.yml", arguments.output / "extrinsics.yml"};
}

int PrintBoard(const Arguments& arguments, std::ostream& out) {
  const Board board = MakeBoard(arguments.board);
  const std::string caption = BoardCaption(arguments.board, board.layout);
  std::string content = BoardPdf(board.layout, caption);
  if (arguments.output.extension() == ".png") {
    const auto png = BoardPng(board.layout, caption);
    content.assign(png.begin(), png.end());
  }
  WriteTogether({{arguments.output, content}});
  out << "written: " << arguments.output.string() << "\n" << caption << std::endl;
  return program::kStopped;
}

void RequireViews(const Collected& collected, const Feed& feed) {
  const ViewSelection& selection = collected.selection;
  if (!selection.shots().empty()) return;
  std::string text =
      "no view was accepted out of " + std::to_string(collected.pictures) + " pictures";
  if (!feed.trouble().empty()) text += " (" + feed.trouble() + ")";
  const std::optional<Fate> reason = selection.MostFrequentFate();
  text +=
      reason ? ": " + selection.FatesText() + "; " + CureOf(*reason) : ": see that pictures come";
  throw std::runtime_error(text);
}

/// Writes unless something speaks against it; says what.
int Conclude(const Arguments& arguments, const std::vector<std::string>& faults,
             const std::function<std::vector<FileText>(const Notes&)>& files, std::ostream& out) {
  for (const std::string& fault : faults) out << "fault: " << fault << "\n";
  if (!faults.empty() && !arguments.permissions.may_write_poor) {
    out << "not written: " << faults.size() << " fault" << (faults.size() == 1 ? "" : "s")
        << "; --accept-poor writes it all the same" << std::endl;
    return program::kCannotWork;
  }
  Notes notes{arguments.time, ""};
  for (const auto& fault : faults) notes.remark += (notes.remark.empty() ? "" : "; ") + fault;
  const auto texts = files(notes);
  WriteTogether(texts);
  for (const FileText& file : texts) {
    out << "written: " << file.path.string() << (faults.empty() ? "" : " (marked as poor)") << "\n";
  }
  out.flush();
  return program::kStopped;
}

int FinishCamera(const Arguments& arguments, const Board& board, const Collected& collected,
                 const PictureFolder& pictures, std::ostream& out) {
  const ViewSelection& selection = collected.selection;
  const CameraCalibration result =
      CalibrateCamera(selection.shots(), 0, board.layout, arguments.calibration);
  ReportCamera(result, selection.shots(), "", out);
  pictures.WriteResiduals(selection, 0, result, board.layout, "");
  const auto faults = FaultsOf(result, selection.coverage(0), "", arguments.demands);
  return Conclude(
      arguments, faults,
      [&](const Notes& notes) {
        return std::vector<FileText>{{arguments.output, CameraYaml(result, notes)}};
      },
      out);
}

int FinishStereo(const Arguments& arguments, const Board& board, const Collected& collected,
                 const PictureFolder& pictures, std::ostream& out) {
  const ViewSelection& selection = collected.selection;
  const auto& first = selection.shots().front();
  if (first.views[0].size != first.views[1].size) {
    throw std::runtime_error("left and right pictures differ in size: set both cameras alike");
  }
  const StereoCalibration result =
      CalibrateStereo(selection.shots(), board.layout, arguments.calibration);
  ReportStereo(result, selection.shots(), out);
  pictures.WriteResiduals(selection, 0, result.left, board.layout, "_left");
  pictures.WriteResiduals(selection, 1, result.right, board.layout, "_right");
  pictures.WriteRectified(result.fit, collected.first_bgr);
  const auto paths = FilesToWrite(arguments);
  return Conclude(
      arguments, FaultsOf(result, selection, arguments.demands),
      [&](const Notes& notes) {
        return std::vector<FileText>{{paths[0], IntrinsicsYaml(result, notes)},
                                     {paths[1], ExtrinsicsYaml(result, notes)}};
      },
      out);
}

}  // namespace

int Run(const Arguments& arguments, const std::function<bool()>& is_stopped, std::ostream& out) {
  RequireWritable(FilesToWrite(arguments), arguments.permissions.existing);
  if (arguments.task == Task::kPrintBoard) return PrintBoard(arguments, out);
  const Board board = MakeBoard(arguments.board);
  const PictureFolder pictures(arguments.save);
  const auto feed = FeedOf(arguments);
  const Collected collected = Collect(*feed, board, arguments, pictures, is_stopped, out);
  RequireViews(collected, *feed);
  ReportFates(collected.selection, feed->trouble(), out);
  return arguments.task == Task::kCamera ? FinishCamera(arguments, board, collected, pictures, out)
                                         : FinishStereo(arguments, board, collected, pictures, out);
}

}  // namespace deixis::calibrator
