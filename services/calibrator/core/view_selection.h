#pragma once
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "services/calibrator/core/coverage.h"
#include "services/calibrator/core/view.h"

namespace deixis::calibrator {

struct SelectionConfig {
  double most_edge_px = 0.0;  ///< More is blurred; 0 = 4 px, or 1/200 of the width if that is more.
  double least_change = 0.02;   ///< Mean way of the corners from every earlier view, of the width.
  double most_motion_px = 0.0;  ///< Between one picture and the next; 0 = pictures stand alone;
                                ///< below 0 = 1/400 of the width.
};

/// What became of a shot.
enum class Fate {
  kAccepted,
  kNoBoard,  ///< Not found, in one of the pictures at least.
  kBlurred,
  kMoving,      ///< Corners moved since the picture before, or there was none yet.
  kTooSimilar,  ///< As one of the views accepted before.
  kOtherSize    ///< Pictures of a camera must have one size.
};

std::string NameOf(Fate fate);
/// What helps against it: "hold the board still, or set --most-motion-px".
std::string CureOf(Fate fate);

struct Judgement {
  Fate fate = Fate::kNoBoard;
  std::string remark;  ///< With figures: "edge 6.2 px, at most 4.0".
};

/// Chooses the shots to calibrate from, one after the other.
class ViewSelection {
 public:
  ViewSelection(const SelectionConfig& config, std::size_t cameras);

  /// Judges what the cameras saw at `time`, one of `views` each, nothing where the board was not
  /// found; when it is accepted, keeps it as a shot called `name`.
  Judgement Offer(const std::string& name, Timestamp time,
                  const std::vector<std::optional<View>>& views);

  const std::vector<Shot>& shots() const { return shots_; }
  const Coverage& coverage(std::size_t camera) const { return coverages_.at(camera); }
  /// How many shots met which fate: "3 accepted, 2 blurred"; empty before the first one.
  std::string FatesText() const;
  /// The fate that most shots met; nothing before the first one.
  std::optional<Fate> MostFrequentFate() const;
  const std::map<Fate, int>& fates() const { return fates_; }  ///< How many shots met which.
  /// What the next shot should show, by the camera that needs it most.
  std::vector<std::string> Advice() const;

 private:
  Judgement Judge(const std::vector<std::optional<View>>& views);
  std::optional<Judgement> JudgeSizes(const std::vector<std::optional<View>>& views) const;
  std::optional<Judgement> JudgeBlur(const std::vector<std::optional<View>>& views) const;
  std::optional<Judgement> JudgeMotion(const std::vector<std::optional<View>>& views);
  std::optional<Judgement> JudgeChange(const std::vector<std::optional<View>>& views) const;

  SelectionConfig config_;
  std::vector<Shot> shots_;
  std::vector<Coverage> coverages_;
  std::vector<std::optional<View>> before_;
  std::map<Fate, int> fates_;
};

}  // namespace deixis::calibrator
