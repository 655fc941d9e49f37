#include "services/calibrator/collection.h"

#include <chrono>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "services/calibrator/core/figures.h"

namespace deixis::calibrator {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::size_t kFewestForError = 4;
constexpr std::size_t kEnoughWithoutAdvice = 15;
constexpr std::chrono::seconds kTellEvery{2};
// Of the width. A stream has more than enough of pictures that are alike.
constexpr double kLeastChangeInStream = 0.06;
constexpr double kLeastChangeOfSeparate = 0.02;

/// Tells at most every two seconds of what is refused in a stream; of a file always.
class Complaints {
 public:
  Complaints(FeedKind kind, std::ostream& out) : kind_(kind), out_(out) {}

  void Tell(const std::string& text) {
    const auto now = Clock::now();
    if (kind_ != FeedKind::kSeparate && now < next_) return;
    next_ = now + kTellEvery;
    out_ << text << std::endl;
  }

 private:
  FeedKind kind_;
  std::ostream& out_;
  Clock::time_point next_ = Clock::now() + kTellEvery;
};

std::vector<std::optional<View>> LookAt(const Sight& sight, const Board& board) {
  std::vector<std::optional<View>> views;
  for (const cv::Mat& bgr : sight.bgr) {
    cv::Mat grey;
    if (!bgr.empty()) cv::cvtColor(bgr, grey, cv::COLOR_BGR2GRAY);
    views.push_back(grey.empty() ? std::nullopt : Look(grey, board));
  }
  return views;
}

/// The error of every camera so far, with the lens that is to be fitted; "?" where none fits yet.
std::string RunningError(const std::vector<Shot>& shots, const BoardLayout& layout,
                         const LensOptions& options) {
  if (shots.size() < kFewestForError) return "";
  std::string errors;
  for (std::size_t camera = 0; camera < shots.front().views.size(); ++camera) {
    const cv::Size size = shots.front().views[camera].size;
    const auto error_px = FittedError_px(CornersOf(shots, camera), layout, size, options);
    errors += (errors.empty() ? "" : ", ") + (error_px ? Figures("%.2f", *error_px) : "?");
  }
  return "  error " + errors + " px";
}

std::string Tilt(const View& view) {
  return Figures("%s %.0f, %s %.0f deg", view.tilt_right_deg >= 0.0 ? "right" : "left",
                 std::abs(view.tilt_right_deg), view.tilt_down_deg >= 0.0 ? "lower" : "upper",
                 std::abs(view.tilt_down_deg));
}

std::string Describe(const ViewSelection& selection, const BoardLayout& layout,
                     const LensOptions& options) {
  const Shot& shot = selection.shots().back();
  const View& view = shot.views[0];
  std::string text = Figures("view %2zu  %s", selection.shots().size(), shot.name.c_str());
  if (view.edge_width_px) text += Figures("  edge %.1f px", *view.edge_width_px);
  text += Figures("  at %.0f %%, %.0f %%  size %.0f %%", 100 * view.centre.x, 100 * view.centre.y,
                  100 * view.extent);
  text += "  back " + Tilt(view);
  text += Figures("  covered %.0f %%", 100 * selection.coverage(0).share());
  text += RunningError(selection.shots(), layout, options);
  const auto advice = selection.Advice();
  return advice.empty() ? text : text + "  next: " + advice.front();
}

class Collector {
 public:
  Collector(Feed& feed, const Board& board, const Arguments& arguments,
            const PictureFolder& pictures, std::ostream& out)
      : feed_(feed),
        board_(board),
        arguments_(arguments),
        pictures_(pictures),
        out_(out),
        complaints_(feed.kind(), out),
        collected_{
            ViewSelection(SelectionFor(feed, arguments), arguments.task == Task::kStereo ? 2 : 1),
            {},
            0} {}

  Collected Run(const std::function<bool()>& is_stopped) {
    Clock::time_point tell = Clock::now() + kTellEvery;
    while (!is_stopped() && !IsEnough()) {
      Take take = feed_.Next();
      if (take.state == capture::SourceState::kFinished) break;
      if (take.sight) {
        Add(*take.sight);
        tell = Clock::now() + kTellEvery;
      } else if (Clock::now() > tell) {
        out_ << "waiting: " << (feed_.trouble().empty() ? "no picture yet" : feed_.trouble())
             << std::endl;
        tell = Clock::now() + kTellEvery;
      }
    }
    return std::move(collected_);
  }

 private:
  static SelectionConfig SelectionFor(const Feed& feed, const Arguments& arguments) {
    SelectionConfig config = arguments.selection;
    const bool is_stream = feed.kind() != FeedKind::kSeparate;
    if (!is_stream) config.most_motion_px = 0.0;
    config.least_change =
        arguments.least_change.value_or(is_stream ? kLeastChangeInStream : kLeastChangeOfSeparate);
    return config;
  }

  void Add(const Sight& sight) {
    if (collected_.pictures++ == 0) first_time_ = sight.time;
    last_time_ = sight.time;
    const auto views = LookAt(sight, board_);
    const Judgement judgement = collected_.selection.Offer(sight.name, sight.time, views);
    if (judgement.fate != Fate::kAccepted) {
      complaints_.Tell("refused  " + sight.name + ": " + judgement.remark + Hint(judgement.fate));
      return;
    }
    if (collected_.first_bgr.empty()) collected_.first_bgr = sight.bgr;
    out_ << Describe(collected_.selection, board_.layout, arguments_.calibration.lens) << std::endl;
    pictures_.WriteView(collected_.selection, sight.bgr, board_.layout);
  }

  std::string Hint(Fate fate) const {
    const bool wants_another = fate == Fate::kTooSimilar || fate == Fate::kNoBoard;
    if (feed_.kind() != FeedKind::kLive || !wants_another) return "";
    const auto advice = collected_.selection.Advice();
    return advice.empty() ? "" : "; " + advice.front();
  }

  bool IsEnough() const {
    if (feed_.kind() == FeedKind::kSeparate) return false;
    const std::size_t views = collected_.selection.shots().size();
    const bool has_all = feed_.kind() == FeedKind::kLive && views >= kEnoughWithoutAdvice &&
                         collected_.selection.Advice().empty();
    const bool is_late =
        arguments_.seconds > 0.0 && SecondsBetween(first_time_, last_time_) >= arguments_.seconds;
    return has_all || is_late || views >= static_cast<std::size_t>(arguments_.most_views);
  }

  Feed& feed_;
  const Board& board_;
  const Arguments& arguments_;
  const PictureFolder& pictures_;
  std::ostream& out_;
  Complaints complaints_;
  Collected collected_;
  Timestamp first_time_;
  Timestamp last_time_;
};

}  // namespace

Collected Collect(Feed& feed, const Board& board, const Arguments& arguments,
                  const PictureFolder& pictures, const std::function<bool()>& is_stopped,
                  std::ostream& out) {
  return Collector(feed, board, arguments, pictures, out).Run(is_stopped);
}

}  // namespace deixis::calibrator
