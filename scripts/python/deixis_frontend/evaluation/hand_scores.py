"""How well tracked hands agree with the truth: errors, misses, false tracks, identity switches."""

from __future__ import annotations

from collections import Counter
from dataclasses import dataclass, field
from typing import Any, Sequence

import numpy as np

_FALSE_AFTER_S = 0.2  # a track that nothing explains for this long in all is a false one


@dataclass(frozen=True)
class TrueHand:
    """A labelled hand in one image. A hidden one is not asked for, but explains a track."""

    name: str  # "right", "left"
    centre_px: tuple[float, float]
    is_visible: bool


@dataclass(frozen=True)
class TrackedHand:
    """A hand as the tracker published it in one image."""

    id: int
    side: str  # "right", "left", "unknown"
    centre_px: tuple[float, float]


@dataclass
class HandScore:
    """Counts of one or more recordings."""

    frames: int = 0
    minutes: float = 0.0
    visible: int = 0
    misses: int = 0
    false_tracks: int = 0
    id_switches: int = 0
    sides: int = 0  # matched tracks that name a side ...
    right_sides: int = 0  # ... and the right one
    errors_px: list[float] = field(default_factory=list)

    def add(self, other: HandScore) -> None:
        """Takes in the counts of another score."""
        for name in vars(other):
            setattr(self, name, getattr(self, name) + getattr(other, name))

    def figures(self) -> dict[str, Any]:
        """What is reported; None where there was nothing to measure."""
        return {
            "error_median_px": _percentile(self.errors_px, 50),
            "error_p90_px": _percentile(self.errors_px, 90),
            "miss_percent": _share(self.misses, self.visible),
            "false_tracks_per_min": _rate(self.false_tracks, self.minutes),
            "id_switches_per_min": _rate(self.id_switches, self.minutes),
            "side_correct_percent": _share(self.right_sides, self.sides),
            "visible_hands": self.visible,
            "frames": self.frames,
        }


def score(truth: Sequence[Sequence[TrueHand]], tracks: Sequence[Sequence[TrackedHand]],
          gates_px: Sequence[float], seconds_per_frame: float) -> HandScore:
    """Compares frame by frame. A track within `gates_px` of a true hand belongs to it; where there is a
    choice, the sum of the distances decides."""
    result = HandScore(frames=len(truth), minutes=len(truth) * seconds_per_frame / 60.0)
    last_id: dict[str, int] = {}
    unexplained: Counter[int] = Counter()
    for true_hands, hands, gate in zip(truth, tracks, gates_px):
        pairs = match(true_hands, hands, gate)
        taken = {j for j in pairs if j is not None}
        unexplained.update(hand.id for j, hand in enumerate(hands) if j not in taken)
        for true_hand, j in zip(true_hands, pairs):
            if true_hand.is_visible:
                _count(result, true_hand, None if j is None else hands[j], last_id)
    result.false_tracks = sum(
        1 for frames in unexplained.values() if frames * seconds_per_frame > _FALSE_AFTER_S)
    return result


def match(true_hands: Sequence[TrueHand], hands: Sequence[TrackedHand],
          gate: float) -> list[int | None]:
    """For each true hand the index of its track, or None: as many as possible, then the nearest."""
    best: tuple[float, list[int | None]] = (0.0, [None] * len(true_hands))

    def extend(chosen: list[int | None], gain: float) -> None:
        nonlocal best
        if len(chosen) == len(true_hands):
            if gain > best[0]:
                best = (gain, chosen)
            return
        extend([*chosen, None], gain)
        for j, hand in enumerate(hands):
            distance = _distance(true_hands[len(chosen)], hand)
            if j not in chosen and distance <= gate:
                extend([*chosen, j], gain + 10.0 * gate - distance)

    extend([], 0.0)
    return best[1]


def _count(result: HandScore, true_hand: TrueHand, hand: TrackedHand | None,
           last_id: dict[str, int]) -> None:
    result.visible += 1
    if hand is None:
        result.misses += 1
        return
    result.errors_px.append(_distance(true_hand, hand))
    result.id_switches += last_id.get(true_hand.name, hand.id) != hand.id
    last_id[true_hand.name] = hand.id
    if hand.side != "unknown":
        result.sides += 1
        result.right_sides += hand.side == true_hand.name


def _distance(true_hand: TrueHand, hand: TrackedHand) -> float:
    return float(np.hypot(true_hand.centre_px[0] - hand.centre_px[0],
                          true_hand.centre_px[1] - hand.centre_px[1]))


def _percentile(values: list[float], percent: float) -> float | None:
    return round(float(np.percentile(values, percent)), 2) if values else None


def _share(part: int, whole: int) -> float | None:
    return round(100.0 * part / whole, 2) if whole else None


def _rate(count: int, minutes: float) -> float | None:
    return round(count / minutes, 2) if minutes else None
