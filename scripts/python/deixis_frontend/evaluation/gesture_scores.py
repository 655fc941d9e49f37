"""Scores recognised gestures against labels as in Hofemann, Fritsch, Sagerer 2004, Table 1."""

from __future__ import annotations

from dataclasses import dataclass, field
from statistics import fmean, median, pstdev
from typing import Iterable

from deixis_frontend.evaluation.sequences import LabelledGesture

# A recognition counts until this long after the hold's end.
GRACE_S = 0.5


@dataclass(frozen=True)
class RecognisedGesture:
    """One event of the recogniser."""

    time_s: float
    hand: str
    outcome: str  # "object", "no_object", "ambiguous"
    object_id: int


@dataclass
class Score:
    """Counts of one or more sequences."""

    expected: int = 0
    correct: int = 0
    insertions: int = 0
    deletions: int = 0
    substitutions: int = 0
    ambiguous: int = 0  # substitutions that were answered "one of these"
    free_alarms: int = 0  # insertions outside of every gesture
    free_minutes: float = 0.0
    delays_s: list[float] = field(default_factory=list)

    def add(self, other: Score) -> None:
        """Takes in the counts of another score."""
        for name, value in vars(other).items():
            setattr(self, name, getattr(self, name) + value)

    @property
    def wer_percent(self) -> float:
        """Word error rate: insertions, deletions and substitutions per expected gesture."""
        errors = self.insertions + self.deletions + self.substitutions
        return 100.0 * errors / max(1, self.expected)

    @property
    def recognition_percent(self) -> float:
        """Share of the expected gestures that were recognised with their object."""
        return 100.0 * self.correct / max(1, self.expected)

    @property
    def false_alarms_per_min(self) -> float:
        """Insertions outside of every gesture, per minute outside of every gesture."""
        return self.free_alarms / self.free_minutes if self.free_minutes > 0 else 0.0


def score_sequence(
    gestures: list[LabelledGesture],
    events: Iterable[RecognisedGesture],
    fps: float,
    frames: int,
    *,
    names_objects: bool = True,
) -> Score:
    """Scores one sequence; without `names_objects` time alone decides (column `none`)."""
    score = Score(expected=len(gestures), free_minutes=_free_minutes(gestures, fps, frames))
    found: dict[int, bool] = {}  # index of a gesture -> its object was named
    for event in sorted(events, key=lambda e: e.time_s):
        index = _gesture_at(gestures, event.time_s, fps)
        if index is None or index in found:
            score.insertions += 1
            score.free_alarms += index is None and _is_free(gestures, event.time_s, fps)
        else:
            found[index] = not names_objects or event.object_id == gestures[index].object_id
            _note_recognition(score, event, gestures[index].apex_frame / fps)
    score.correct = sum(found.values())
    score.substitutions = len(found) - score.correct
    score.deletions = len(gestures) - len(found)
    return score


def summarise(scores: list[Score]) -> dict[str, float]:
    """Mean of several runs (seeds), and the spread of the two rates over them."""
    runs = max(1, len(scores))
    delays = [delay for score in scores for delay in score.delays_s]
    counts = ("expected", "correct", "insertions", "deletions", "substitutions", "ambiguous")
    summary: dict[str, float] = {
        name: round(sum(getattr(score, name) for score in scores) / runs, 3) for name in counts
    }
    for rate in ("wer_percent", "recognition_percent"):
        values = [getattr(score, rate) for score in scores]
        summary[rate] = round(fmean(values), 2)
        summary[rate.replace("percent", "spread_percent")] = round(pstdev(values), 2)
    summary["false_alarms_per_min"] = round(fmean(s.false_alarms_per_min for s in scores), 3)
    if delays:
        summary["decision_delay_median_s"] = round(median(delays), 3)
        summary["decision_delay_p90_s"] = round(sorted(delays)[int(0.9 * (len(delays) - 1))], 3)
    return summary


def _note_recognition(score: Score, event: RecognisedGesture, apex_s: float) -> None:
    score.ambiguous += event.outcome == "ambiguous"
    score.delays_s.append(event.time_s - apex_s)


def _gesture_at(gestures: list[LabelledGesture], time_s: float, fps: float) -> int | None:
    for index, gesture in enumerate(gestures):
        if gesture.start_frame / fps - 1e-6 <= time_s <= gesture.end_frame / fps + GRACE_S + 1e-6:
            return index
    return None


def _is_free(gestures: list[LabelledGesture], time_s: float, fps: float) -> bool:
    return all(not g.start_frame <= time_s * fps <= g.retract_end_frame for g in gestures)


def _free_minutes(gestures: list[LabelledGesture], fps: float, frames: int) -> float:
    busy = sum(g.retract_end_frame - g.start_frame for g in gestures)
    return max(0, frames - busy) / fps / 60.0
