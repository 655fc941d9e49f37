#include "services/calibrator/core/view_selection.h"

#include <algorithm>

#include "common/text/size_text.h"
#include "services/calibrator/core/figures.h"

namespace deixis::calibrator {
namespace {

std::string CameraName(std::size_t camera, std::size_t cameras) {
  if (cameras == 1) return "";
  return camera == 0 ? "left: " : "right: ";
}

double MostEdge_px(const SelectionConfig& config, cv::Size size) {
  return config.most_edge_px > 0.0 ? config.most_edge_px : std::max(4.0, size.width / 200.0);
}

double MostMotion_px(const SelectionConfig& config, cv::Size size) {
  return config.most_motion_px > 0.0 ? config.most_motion_px : size.width / 400.0;
}

}  // namespace

std::string NameOf(Fate fate) {
  switch (fate) {
    case Fate::kAccepted:
      return "accepted";
    case Fate::kNoBoard:
      return "no board";
    case Fate::kBlurred:
      return "blurred";
    case Fate::kMoving:
      return "moving";
    case Fate::kTooSimilar:
      return "too similar";
    case Fate::kOtherSize:
      return "other size";
  }
  return "unknown";
}

std::string CureOf(Fate fate) {
  switch (fate) {
    case Fate::kAccepted:
      return "nothing is wrong";
    case Fate::kNoBoard:
      return "check --board (inner corners, not squares), light and focus";
    case Fate::kBlurred:
      return "hold the board still, see to light and focus, or set --most-edge-px";
    case Fate::kMoving:
      return "hold the board still, or set --most-motion-px";
    case Fate::kTooSimilar:
      return "show the board from elsewhere, or set --least-change";
    case Fate::kOtherSize:
      return "give pictures of one size";
  }
  return "unknown";
}

ViewSelection::ViewSelection(const SelectionConfig& config, std::size_t cameras)
    : config_(config), coverages_(cameras) {}

Judgement ViewSelection::Offer(const std::string& name, Timestamp time,
                               const std::vector<std::optional<View>>& views) {
  Judgement judgement = Judge(views);
  before_ = views;
  ++fates_[judgement.fate];
  if (judgement.fate != Fate::kAccepted) return judgement;
  Shot shot{name, time, {}};
  for (std::size_t camera = 0; camera < views.size(); ++camera) {
    shot.views.push_back(*views[camera]);
    coverages_[camera].Add(*views[camera]);
  }
  shots_.push_back(std::move(shot));
  return judgement;
}

Judgement ViewSelection::Judge(const std::vector<std::optional<View>>& views) {
  for (std::size_t camera = 0; camera < views.size(); ++camera) {
    if (!views[camera]) {
      return {Fate::kNoBoard, CameraName(camera, views.size()) + "the board is not found"};
    }
  }
  if (const auto fault = JudgeSizes(views)) return *fault;
  if (const auto fault = JudgeBlur(views)) return *fault;
  if (const auto fault = JudgeMotion(views)) return *fault;
  if (const auto fault = JudgeChange(views)) return *fault;
  return {Fate::kAccepted, ""};
}

std::optional<Judgement> ViewSelection::JudgeSizes(
    const std::vector<std::optional<View>>& views) const {
  if (shots_.empty()) return std::nullopt;
  for (std::size_t camera = 0; camera < views.size(); ++camera) {
    const cv::Size wanted = shots_.front().views[camera].size;
    const cv::Size size = views[camera]->size;
    if (size == wanted) continue;
    return Judgement{Fate::kOtherSize,
                     CameraName(camera, views.size()) + text::SizeText(size.width, size.height) +
                         ", not " + text::SizeText(wanted.width, wanted.height) + " as the first"};
  }
  return std::nullopt;
}

std::optional<Judgement> ViewSelection::JudgeBlur(
    const std::vector<std::optional<View>>& views) const {
  for (std::size_t camera = 0; camera < views.size(); ++camera) {
    const auto edge_px = views[camera]->edge_width_px;
    const double most_px = MostEdge_px(config_, views[camera]->size);
    if (!edge_px || *edge_px <= most_px) continue;
    return Judgement{Fate::kBlurred, CameraName(camera, views.size()) + "edges are " +
                                         Figures("%.1f", *edge_px) + " px wide, at most " +
                                         Figures("%.1f", most_px)};
  }
  return std::nullopt;
}

std::optional<Judgement> ViewSelection::JudgeMotion(const std::vector<std::optional<View>>& views) {
  if (config_.most_motion_px == 0.0) return std::nullopt;
  for (std::size_t camera = 0; camera < views.size(); ++camera) {
    const bool was_there = before_.size() == views.size() && before_[camera];
    const auto motion_px = was_there
                               ? CornerMotion_px(before_[camera]->corners, views[camera]->corners)
                               : std::nullopt;
    if (!motion_px) return Judgement{Fate::kMoving, "hold the board still"};
    const double most_px = MostMotion_px(config_, views[camera]->size);
    if (*motion_px <= most_px) continue;
    return Judgement{Fate::kMoving, CameraName(camera, views.size()) + "corners move " +
                                        Figures("%.1f", *motion_px) + " px, at most " +
                                        Figures("%.1f", most_px)};
  }
  return std::nullopt;
}

std::optional<Judgement> ViewSelection::JudgeChange(
    const std::vector<std::optional<View>>& views) const {
  for (const Shot& shot : shots_) {
    const auto way_px = CornerMotion_px(shot.views[0].corners, views[0]->corners);
    if (!way_px || *way_px >= config_.least_change * views[0]->size.width) continue;
    return Judgement{Fate::kTooSimilar,
                     "corners lie " + Figures("%.1f", *way_px) + " px from those of " + shot.name};
  }
  return std::nullopt;
}

std::string ViewSelection::FatesText() const {
  std::string text;
  for (const auto& [fate, count] : fates_) {
    text += (text.empty() ? "" : ", ") + std::to_string(count) + " " + NameOf(fate);
  }
  return text;
}

std::optional<Fate> ViewSelection::MostFrequentFate() const {
  if (fates_.empty()) return std::nullopt;
  return std::max_element(fates_.begin(), fates_.end(),
                          [](const auto& a, const auto& b) { return a.second < b.second; })
      ->first;
}

std::vector<std::string> ViewSelection::Advice() const {
  const auto least =
      std::min_element(coverages_.begin(), coverages_.end(),
                       [](const Coverage& a, const Coverage& b) { return a.share() < b.share(); });
  return least->Advice();
}

}  // namespace deixis::calibrator
