"""Real people in depth without background, and the joints that the Kinect SDK gave for them (UTD-MHAD).

These joints are other points than the model's, and scatter by some centimetres. So one constant offset per joint, in
the frame of its limb, is learned on all people but one, and errors are measured on that one; each in turn.
"""

from __future__ import annotations

import tempfile
from collections.abc import Iterator
from dataclasses import dataclass
from fnmatch import fnmatch
from pathlib import Path
from typing import Any

import numpy as np

from deixis_frontend import csv_table
from deixis_frontend.evaluation import depth_logs, pose_chain, pose_matching, pose_results
from deixis_frontend.evaluation.depth_logs import DepthCamera, DepthFrame
from deixis_frontend.evaluation.pose_chain import Chain
from deixis_frontend.evaluation.pose_joints import JointPlace
from deixis_frontend.evaluation.pose_matching import JudgedPerson
from deixis_frontend.evaluation.pose_scores import GOOD_M, percentile, share
from deixis_frontend.evaluation.pose_truth import TruePerson, TrueScene
from deixis_frontend.layout import Layout

NAME = "depth_utd_mhad"
_FPS = 30.0
_ROWS, _COLUMNS = 240, 320
# The pictures are mirrored: with them, the principal point goes from 160 to 319 - 160.
_CAMERA = DepthCamera((285.63, 285.63), (159.0, 120.0), (_COLUMNS, _ROWS))
_LARGEST_OFFSET_M = 0.3  # the SDK's hip_center is more than 0.2 m above ours
_BODY_LOST = 0.5  # share of frames from which on a sequence counts as lost


def _both(joint: str, limb: str, end: str = "proximal") -> list[JointPlace]:
    return [JointPlace(f"{side}_{joint}", f"{side}_{limb}", end) for side in ("right", "left")]


_JOINTS = (
    JointPlace("hip_center", "pelvis"), JointPlace("spine", "abdomen"), JointPlace("shoulder_center", "neck"),
    JointPlace("head", "head"), *_both("shoulder", "upper_arm"), *_both("elbow", "lower_arm"),
    *_both("wrist", "hand"), *_both("hand", "hand", "distal"), *_both("hip", "thigh"), *_both("knee", "shank"),
    *_both("ankle", "foot"), *_both("foot", "foot", "distal"))


@dataclass(frozen=True)
class _Sequence:
    name: str
    subject: str
    judged: JudgedPerson


def is_in(folder: Path) -> bool:
    """Whether this is a folder of that kind."""
    return (folder / "index.csv").is_file() and any(folder.glob("*_skeleton.csv"))


def evaluate(layout: Layout, folder: Path, only: str | None, chain: Chain) -> dict[str, Any]:
    """`sequences` and `summary`; raises UserError when a program fails."""
    sequences = [_run(layout, folder, row, chain) for row in csv_table.read(
        folder / "index.csv", ("name", "subject")) if not only or fnmatch(row.text("name"), only)]
    after = {s.name: errors for s, errors in _without_offsets(sequences)}
    rows = [_row(s, after[s.name]) for s in sequences]
    return {"sequences": rows, "summary": _summary(sequences, after, rows)}


def lines(report: dict[str, Any]) -> Iterator[str]:
    """What is printed."""
    yield (f"{'sequence':<14}{'frames':>8}{'lost %':>8}{'median mm':>11}{'with offsets':>14}{'<10 cm %':>10}"
           f"{'not lost mm':>13}{'p95':>7}")
    for row in [*report["sequences"], {"name": "all", **report["summary"]}]:
        yield (f"{row['name']:<14}{row['frames']:>8}{row['lost_frames_percent']:>8.1f}{_mm(row['median_m']):>11}"
               f"{_mm(row['median_with_offsets_m']):>14}{row['within_10cm_percent']:>10.1f}"
               f"{_mm(row['found_median_with_offsets_m']):>13}{_mm(row['found_p95_with_offsets_m']):>7}")
    for joint, figures in report["summary"]["joints"].items():
        yield (f"{joint:<18} median {_mm(figures['median_m'])} mm; with offsets, in frames that are not lost,"
               f" {_mm(figures['found_median_with_offsets_m'])} mm, p95"
               f" {_mm(figures['found_p95_with_offsets_m'])} mm")
    yield f"sequences lost: {report['summary']['sequences_lost']} of {len(report['sequences'])}"


def _mm(metres: float | None) -> str:
    return "lost" if metres is None else f"{1000 * metres:.0f}"


def _run(layout: Layout, folder: Path, row: csv_table.Row, chain: Chain) -> _Sequence:
    name = row.text("name")
    with tempfile.TemporaryDirectory() as scratch:
        log = Path(scratch) / "depth.lcmlog"
        depth_logs.write(layout, log, _CAMERA, _frames(folder / f"{name}_depth.png"))
        fitted = pose_chain.fit(layout, log, chain, ("fitter.stature_m=0",))
    scene = TrueScene([_truth(name, folder / f"{name}_skeleton.csv")], [], _FPS)
    judged = pose_matching.judge(scene, pose_results.read(fitted.messages, _JOINTS))
    return _Sequence(name, row.text("subject"), judged.people[0])


def _frames(path: Path) -> Iterator[DepthFrame]:
    """The pictures, un-mirrored."""
    stack = depth_logs.read_depth_png(path).reshape(-1, _ROWS, _COLUMNS)[:, :, ::-1]
    for number, depth_mm in enumerate(stack):
        yield DepthFrame(round(number / _FPS * 1e6), np.ascontiguousarray(depth_mm))


def _truth(name: str, path: Path) -> TruePerson:
    columns = [f"{joint.name}_{axis}" for joint in _JOINTS for axis in "xyz"]
    rows = csv_table.read(path, tuple(columns))
    mirrored = np.array([[row.number(column) for column in columns] for row in rows])
    # x to the right of the mirrored picture, y up: to x right, y down.
    joints = mirrored.reshape(len(rows), len(_JOINTS), 3) * (-1.0, -1.0, 1.0)
    return TruePerson(name, joints, np.ones(joints.shape[:2], bool), joints[:, 0])


def _without_offsets(sequences: list[_Sequence]) -> Iterator[tuple[_Sequence, np.ndarray]]:
    """Frames x joints errors of each sequence, with the offsets that the other people teach."""
    for subject in sorted({s.subject for s in sequences}):
        offsets = _offsets([s.judged for s in sequences if s.subject != subject])
        for one in sequences:
            if one.subject == subject:
                moved = one.judged.found_m + np.einsum("fjab,jb->fja", one.judged.rotations, offsets)
                errors = np.linalg.norm(moved - one.judged.true_m, axis=2)
                yield one, np.where(np.isnan(errors), np.inf, errors)


def _offsets(people: list[JudgedPerson]) -> np.ndarray:
    """Joints x 3, in the frames of the limbs; zeros where nobody teaches."""
    parts = []
    for person in people:
        in_limb = np.einsum("fjba,fjb->fja", person.rotations, person.true_m - person.found_m)
        # Who is lost teaches nothing, and neither does a joint that is farther off than any offset is.
        is_right = ~_is_lost(person)[:, None] & (person.errors_m <= _LARGEST_OFFSET_M)
        parts.append(np.where(is_right[..., None], in_limb, np.nan))
    together = np.concatenate([np.zeros((0, len(_JOINTS), 3)), *parts])
    offsets = np.zeros((len(_JOINTS), 3))
    for j in range(len(_JOINTS)):
        known = together[np.isfinite(together[:, j]).all(axis=1), j]
        if len(known):
            offsets[j] = np.median(known, axis=0)
    return offsets


def _row(one: _Sequence, after: np.ndarray) -> dict[str, Any]:
    return {"name": one.name, "subject": one.subject, **_figures([one.judged], [after])}


def _figures(people: list[JudgedPerson], after: list[np.ndarray]) -> dict[str, Any]:
    raw = np.concatenate([np.ravel(p.errors_m) for p in people])
    moved = np.concatenate([np.ravel(errors) for errors in after])
    lost = np.concatenate([_is_lost(person) for person in people])
    found = np.concatenate([np.ravel(errors[~_is_lost(person)]) for person, errors in zip(people, after)])
    return {"frames": len(lost), "lost_frames_percent": share(lost), "median_m": percentile(raw, 50),
            "median_with_offsets_m": percentile(moved, 50), "p95_with_offsets_m": percentile(moved, 95),
            "within_10cm_percent": share(moved <= GOOD_M),
            "found_median_with_offsets_m": percentile(found, 50), "found_p95_with_offsets_m": percentile(found, 95)}


def _is_lost(person: JudgedPerson) -> np.ndarray:
    """Per frame: most joints are wrong, before any offset."""
    return np.median(person.errors_m, axis=1) > pose_matching.WRONG_M


def _summary(sequences: list[_Sequence], after: dict[str, np.ndarray],
             rows: list[dict[str, Any]]) -> dict[str, Any]:
    people = [s.judged for s in sequences]
    moved = [after[s.name] for s in sequences]
    joints = {}
    for j, joint in enumerate(_JOINTS):
        raw = np.concatenate([p.errors_m[:, j] for p in people])
        without = np.concatenate([errors[:, j] for errors in moved])
        found = np.concatenate([errors[~_is_lost(p), j] for p, errors in zip(people, moved)])
        joints[joint.name] = {"median_m": percentile(raw, 50), "median_with_offsets_m": percentile(without, 50),
                              "found_median_with_offsets_m": percentile(found, 50),
                              "found_p95_with_offsets_m": percentile(found, 95)}
    return {**_figures(people, moved), "joints": joints,
            "sequences_lost": sum(1 for row in rows if row["lost_frames_percent"] > 100 * _BODY_LOST),
            "people": len({s.subject for s in sequences})}
