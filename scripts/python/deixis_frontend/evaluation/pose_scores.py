"""Figures of judged people: errors of joints, angles and lengths, losses, and whether the stated spreads hold.

What was missed is infinitely wrong: it moves medians and percentiles, and where one falls on it, the figure is None
(with `visible_lost_percent` telling how much was missed). None stands, too, where nothing was measured (`*_count` 0).
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

import numpy as np

from deixis_frontend.evaluation import pose_geometry, pose_matching
from deixis_frontend.evaluation.pose_joints import JOINTS, KINDS
from deixis_frontend.evaluation.pose_matching import MISSED, JudgedPerson, JudgedScene
from deixis_frontend.evaluation.pose_results import HIDDEN, LOST, MEASURED

GOOD_M = 0.10
WRONG_M = pose_matching.WRONG_M
EPISODE_FRAMES = 5  # a joint that is wrong for more frames than this was lost
# Squared Mahalanobis distances in three dimensions that 50 % and 90 % stay below.
_CHI2 = {50: 2.366, 90: 6.251}

Figures = dict[str, Any]


def of_scenes(scenes: Sequence[JudgedScene]) -> Figures:
    """All figures of the first persons of the scenes together."""
    people = [scene.people[0] for scene in scenes]
    minutes = sum(scene.minutes for scene in scenes)
    false_people = sum(scene.false_people for scene in scenes)
    return {**of_people(people),
            "false_people_per_min": round(false_people / minutes, 2) if minutes else None}


def of_people(people: Sequence[JudgedPerson]) -> Figures:
    """All figures that are of people alone."""
    return {**_errors(people), **_angles(people), **_coverage(people), **_losses(people),
            **_confidence(people),
            "frames": sum(len(person.ids) for person in people),
            "joints": {kind: of_joint(people, kind) for kind in KINDS},
            "length_error_m": {name: _length(people, name) for name in pose_geometry.BONES}}


def brief(people: Sequence[JudgedPerson]) -> Figures:
    """What a row of a stretch tells: errors, lost joints, and which kind of joint is worst."""
    worst = _worst_kind(people)
    episodes = [e for person in people for e in lost_episodes(person)]
    return {**_errors(people), "frames": sum(len(person.ids) for person in people),
            "worst_joint": worst, "lost_episodes": len(episodes),
            "longest_lost_s": max((e["seconds"] for e in episodes), default=0.0)}


def of_joint(people: Sequence[JudgedPerson], kind: str) -> Figures:
    """Errors of one kind of joint while it is visible; x, y, z apart as medians of what is off, with its sign."""
    columns = [j for j, joint in enumerate(JOINTS) if joint.kind == kind]
    errors = _gather(people, lambda p: p.errors_m[:, columns][p.is_visible[:, columns]])
    offsets = _gather(people, lambda p: (p.found_m - p.true_m)[:, columns][p.is_visible[:, columns]])
    offsets = offsets.reshape(-1, 3)
    offsets = offsets[np.isfinite(offsets).all(axis=1)]
    return {"median_m": percentile(errors, 50), "p95_m": percentile(errors, 95),
            "within_10cm_percent": share(errors <= GOOD_M), "count": len(errors),
            **{f"{axis}_bias_m": percentile(offsets[:, i], 50) for i, axis in enumerate("xyz")},
            **{f"{axis}_median_m": percentile(np.abs(offsets[:, i]), 50) for i, axis in enumerate("xyz")}}


def lost_episodes(person: JudgedPerson) -> list[Figures]:
    """Joints that are wrong by more than 15 cm for more than 5 of their visible frames in a row."""
    episodes = []
    for j, joint in enumerate(JOINTS):
        frames = np.flatnonzero(person.is_visible[:, j] & ~np.isnan(person.errors_m[:, j]))
        is_wrong = person.errors_m[frames, j] > WRONG_M
        for first, last in runs(is_wrong):
            if last - first + 1 > EPISODE_FRAMES:
                seconds = (frames[last] - frames[first] + 1) / person.fps
                episodes.append({"joint": joint.name, "start_frame": int(frames[first]),
                                 "end_frame": int(frames[last]), "seconds": round(float(seconds), 3)})
    return episodes


def is_lost(person: JudgedPerson) -> np.ndarray:
    """Per frame: nobody stands for the person, or who does is said to be lost, or most visible joints are wrong."""
    wrong = ((person.errors_m > WRONG_M) & person.is_visible).sum(axis=1)
    return (person.ids < 0) | person.is_said_lost | (2 * wrong > person.is_visible.sum(axis=1))


def runs(flags: np.ndarray) -> list[tuple[int, int]]:
    """First and last index of each stretch of true flags."""
    edges = np.diff(np.concatenate(([0], flags.astype(int), [0])))
    return [(int(a), int(b) - 1) for a, b in zip(np.flatnonzero(edges == 1), np.flatnonzero(edges == -1))]


def percentile(values: np.ndarray, percent: float, digits: int = 4) -> float | None:
    """None of no values, and where it falls on an infinite one."""
    values = np.sort(values[~np.isnan(values)])
    if not len(values):
        return None
    place = percent / 100.0 * (len(values) - 1)
    low, high = values[int(np.floor(place))], values[int(np.ceil(place))]
    if not np.isfinite(high):
        return None
    return round(float(low + (place - np.floor(place)) * (high - low)), digits)


def share(flags: np.ndarray) -> float | None:
    """Of true flags, percent; None of no flags."""
    return round(100.0 * float(np.mean(flags)), 2) if len(flags) else None


def _gather(people: Sequence[JudgedPerson], of: Callable[[JudgedPerson], np.ndarray]) -> np.ndarray:
    parts = [np.ravel(of(person)) for person in people]
    return np.concatenate(parts) if parts else np.zeros(0)


def _errors(people: Sequence[JudgedPerson]) -> Figures:
    visible = _visible_errors(people)
    hidden = _gather(people, lambda p: p.errors_m[~p.is_visible & ~np.isnan(p.errors_m)])
    return {"visible_median_m": percentile(visible, 50), "visible_p95_m": percentile(visible, 95),
            "within_10cm_percent": share(visible <= GOOD_M),
            "visible_lost_percent": share(np.isinf(visible)), "visible_count": len(visible),
            "hidden_median_m": percentile(hidden, 50), "hidden_p95_m": percentile(hidden, 95),
            "hidden_count": len(hidden)}


def _visible_errors(people: Sequence[JudgedPerson]) -> np.ndarray:
    return _gather(people, lambda p: p.errors_m[p.is_visible & ~np.isnan(p.errors_m)])


def _angles(people: Sequence[JudgedPerson]) -> Figures:
    by_joint: dict[str, np.ndarray] = {
        name: np.concatenate([pose_geometry.angle_errors_deg(p, name) for p in people] or [np.zeros(0)])
        for name in pose_geometry.ANGLES}
    pooled = np.concatenate(list(by_joint.values()))
    return {"angle_median_deg": percentile(pooled, 50, 2), "angle_p95_deg": percentile(pooled, 95, 2),
            "angles": {name: {"median_deg": percentile(values, 50, 2), "p95_deg": percentile(values, 95, 2),
                              "count": len(values)} for name, values in by_joint.items()}}


def _length(people: Sequence[JudgedPerson], bone: str) -> Figures:
    errors = np.concatenate([pose_geometry.length_errors_m(p, bone) for p in people] or [np.zeros(0)])
    return {"bias": percentile(errors, 50), "median": percentile(np.abs(errors), 50),
            "p95": percentile(np.abs(errors), 95)}


def _coverage(people: Sequence[JudgedPerson]) -> Figures:
    """Of joints that were reported: those missed have no ellipsoid."""
    figures = {}
    for prefix, wants_visible in (("", True), ("hidden_", False)):
        squared = _gather(people, lambda p, wanted=wants_visible: pose_geometry.mahalanobis2(p)[
            (p.is_visible == wanted) & (p.states != MISSED) & ~np.isnan(p.errors_m)])
        for percent, bound in _CHI2.items():
            figures[f"{prefix}coverage{percent}_percent"] = share(squared <= bound)
    return figures


def _losses(people: Sequence[JudgedPerson]) -> Figures:
    lost = [is_lost(person) for person in people]
    absences = [length for flags in lost for length in _absences(flags)]
    count, longest = _longest_episodes(people)
    return {"lost_frames_percent": share(np.concatenate(lost) if lost else np.zeros(0)),
            "absent_frames_percent": share(_gather(people, lambda p: p.ids < 0)),
            "start_frames_median": _median([_absences(flags)[0] for flags in lost]),
            "restart_frames_median": _median(absences), "restart_frames_worst": max(absences, default=None),
            "id_switches": sum(_switches(person.ids) for person in people),
            "lost_episodes": count,
            "longest_lost_s": longest[0]["seconds"] if longest else 0.0, "longest_lost": longest[:5]}


def _longest_episodes(people: Sequence[JudgedPerson]) -> tuple[int, list[Figures]]:
    """How many there are; and these, longest first, joints that were lost together in one."""
    together: dict[tuple[str, int, int], Figures] = {}
    count = 0
    for person in people:
        for episode in lost_episodes(person):
            count += 1
            key = (person.name, episode["start_frame"], episode["end_frame"])
            joint = episode.pop("joint")
            together.setdefault(key, {"sequence": person.name, "joints": [], **episode})["joints"].append(joint)
    return count, sorted(together.values(), key=lambda e: -e["seconds"])


def _absences(flags: np.ndarray) -> list[int]:
    """Frames until the start (0 = at once), then until each re-start."""
    lengths = [last - first + 1 for first, last in runs(flags)]
    return lengths if len(flags) and flags[0] else [0, *lengths]


def _median(values: list[int]) -> float | None:
    return float(np.median(values)) if values else None


def _switches(ids: np.ndarray) -> int:
    there = ids[ids >= 0]
    return int(np.count_nonzero(np.diff(there)))


def _confidence(people: Sequence[JudgedPerson]) -> Figures:
    """How often visible joints that are wrong are called measured, and right ones lost or hidden."""
    errors = _visible_errors(people)
    states = _gather(people, lambda p: p.states[p.is_visible & ~np.isnan(p.errors_m)])
    wrong = (errors > WRONG_M) & (states != MISSED)
    right = errors <= WRONG_M
    return {"overclaim_percent": share(states[wrong] == MEASURED), "wrong_count": int(wrong.sum()),
            "underclaim_percent": share(np.isin(states[right], (HIDDEN, LOST)))}


def _worst_kind(people: Sequence[JudgedPerson]) -> str | None:
    """The one that is least often within 10 cm; of equal ones that with the largest 95th percentile."""
    figures = {kind: of_joint(people, kind) for kind in KINDS}
    known = {kind: (-f["within_10cm_percent"], f["p95_m"] or np.inf) for kind, f in figures.items() if f["count"]}
    return max(known, key=lambda kind: known[kind]) if known else None
