#include "common/capture/paired_sources.h"

#include <utility>

namespace deixis::capture {
namespace {

// So many periods may one camera be later than the other.
constexpr std::size_t kMostWaiting = 5;

}  // namespace

PairedSources::PairedSources(std::unique_ptr<Source> first, std::unique_ptr<Source> second,
                             double max_skew_s, std::array<Grab, 2> begun)
    : max_skew_s_(max_skew_s),
      first_{std::move(first)},
      second_{std::move(second)},
      matcher_(max_skew_s, kMostWaiting) {
  Add(Taken(first_, std::move(begun[0])), Taken(second_, std::move(begun[1])));
}

PairGrab PairedSources::Next() {
  if (auto pair = matcher_.Next()) return {SourceState::kPicture, std::move(pair)};
  const bool wants_first = matcher_.wants_first(), wants_second = matcher_.wants_second();
  Add(Fetch(first_, wants_first), Fetch(second_, wants_second));
  if (auto pair = matcher_.Next()) return {SourceState::kPicture, std::move(pair)};
  if (!matcher_.IsOver(first_.state == SourceState::kFinished,
                       second_.state == SourceState::kFinished)) {
    return {};
  }
  matcher_.Finish();
  return {SourceState::kFinished, std::nullopt};
}

std::optional<Picture> PairedSources::Fetch(Side& side, bool is_wanted) {
  if (side.state == SourceState::kFinished) return std::nullopt;
  if (!is_wanted && !side.source->status().is_live) return std::nullopt;
  return Taken(side, side.source->Next());
}

std::optional<Picture> PairedSources::Taken(Side& side, Grab grab) {
  side.state = grab.state;
  return std::move(grab.picture);
}

void PairedSources::Add(std::optional<Picture> first, std::optional<Picture> second) {
  if (first) matcher_.AddFirst(first->time, std::move(*first));
  if (second) matcher_.AddSecond(second->time, std::move(*second));
}

}  // namespace deixis::capture
