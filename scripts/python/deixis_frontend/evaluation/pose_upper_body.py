"""Two real men from the hips up before a RealSense, pasted side by side, and their joints in the picture by a network.

Each half is a recording of its own: the other half's depth is taken out. The reference is a machine's, about 5 to 10 px
good, and has no depth: errors are in pixels. The recording has no times: the rate is a setting.
"""

from __future__ import annotations

import json
import tempfile
from collections.abc import Iterator
from dataclasses import dataclass
from fnmatch import fnmatch
from pathlib import Path
from typing import Any

import numpy as np

from deixis_frontend import csv_table
from deixis_frontend.evaluation import depth_logs, pose_chain, pose_results
from deixis_frontend.evaluation.depth_logs import DepthCamera, DepthFrame
from deixis_frontend.evaluation.pose_chain import Chain
from deixis_frontend.evaluation.pose_joints import INDEX, kind_of
from deixis_frontend.evaluation.pose_results import FoundFrame
from deixis_frontend.evaluation.pose_scores import percentile, share
from deixis_frontend.layout import Layout

NAME = "rgbd_upperbody_d435"
_FPS = 10.0
_LEAST_SCORE = 0.3  # of a network's joint
_GATE_PX = 120.0  # median over the joints of who stands for the man
_GOOD_PX = 20.0
_JOINTS = [f"{side}_{joint}" for joint in ("shoulder", "elbow", "wrist", "hip") for side in ("right", "left")]


@dataclass(frozen=True)
class _Half:
    name: str
    columns: slice


_HALVES = (_Half("left_person", slice(0, 351)), _Half("right_person", slice(352, 640)))


def is_in(folder: Path) -> bool:
    """Whether this is a folder of that kind."""
    return all(_labels(folder, half).is_file() for half in _HALVES) and (folder / "camera.json").is_file()


def evaluate(layout: Layout, folder: Path, only: str | None, chain: Chain) -> dict[str, Any]:
    """`sequences`, a row for each half, and `summary`; raises UserError when a program fails."""
    errors = {half.name: _run(layout, folder, half, chain) for half in _HALVES
              if not only or fnmatch(half.name, only)}
    together = np.concatenate(list(errors.values())) if errors else np.zeros((0, len(_JOINTS)))
    return {"sequences": [{"name": name, **_figures(of_half)} for name, of_half in errors.items()],
            "summary": _figures(together)}


def lines(report: dict[str, Any]) -> Iterator[str]:
    """What is printed."""
    for row in [*report["sequences"], {"name": "all", **report["summary"]}]:
        median = "lost" if row["median_px"] is None else f"{row['median_px']:.1f} px"
        yield (f"{row['name']:<14} frames {row['frames']}, lost {row['lost_frames_percent']} %, median {median},"
               f" within {_GOOD_PX:.0f} px {row['within_20px_percent']} %")


def errors_px(true_px: np.ndarray, found: dict[int, FoundFrame], camera: DepthCamera) -> np.ndarray:
    """Frames x joints; NaN where the network saw none, infinite where nobody stands for the man."""
    errors = np.where(np.isnan(true_px[:, :, 0]), np.nan, np.inf)
    columns = [INDEX[("r_" if name.startswith("right") else "l_") + name.split("_")[1]] for name in _JOINTS]
    for k, true in enumerate(true_px):
        is_known = ~np.isnan(true[:, 0])
        people = found[k].people if k in found and is_known.any() else []
        of_people = [np.linalg.norm(camera.pixels(p.joints_m[columns]) - true, axis=1) for p in people]
        medians = [float(np.median(of_person[is_known])) for of_person in of_people]
        if medians and min(medians) < _GATE_PX:
            errors[k] = of_people[int(np.argmin(medians))]
    return errors


def _run(layout: Layout, folder: Path, half: _Half, chain: Chain) -> np.ndarray:
    camera = _camera(folder)
    with tempfile.TemporaryDirectory() as scratch:
        log = Path(scratch) / "depth.lcmlog"
        depth_logs.write(layout, log, camera, _frames(folder, half))
        fitted = pose_chain.fit(layout, log, chain, ("fitter.stature_m=0",))
    found = {round(f.utime * 1e-6 * _FPS): f for f in pose_results.read(fitted.messages)}
    return errors_px(_read_labels(_labels(folder, half)), found, camera)


def _figures(errors: np.ndarray) -> dict[str, Any]:
    known = errors[~np.isnan(errors)]
    joints = {kind: np.concatenate([errors[:, j] for j, name in enumerate(_JOINTS) if name.endswith(kind)])
              for kind in dict.fromkeys(kind_of(name.split("_")[1]) for name in _JOINTS)}
    return {"frames": len(errors), "lost_frames_percent": share(np.isinf(errors).any(axis=1)),
            "median_px": percentile(known, 50, 1), "p95_px": percentile(known, 95, 1),
            "within_20px_percent": share(known <= _GOOD_PX),
            "joints": {kind: {"median_px": percentile(values, 50, 1)} for kind, values in joints.items()}}


def _camera(folder: Path) -> DepthCamera:
    facts = json.loads((folder / "camera.json").read_text(encoding="utf-8"))
    k = facts["intrinsic_matrix"]  # Column by column.
    return DepthCamera((k[0], k[4]), (k[6], k[7]), (facts["width"], facts["height"]))


def _frames(folder: Path, half: _Half) -> Iterator[DepthFrame]:
    for number, picture in enumerate(sorted((folder / "color").glob("*.jpg"))):
        whole = depth_logs.read_depth_png(folder / "depth" / f"{picture.stem}.png")
        depth_mm = np.zeros_like(whole)
        depth_mm[:, half.columns] = whole[:, half.columns]
        yield DepthFrame(round(number / _FPS * 1e6), depth_mm, picture.read_bytes())


def _labels(folder: Path, half: _Half) -> Path:
    return folder / f"joints2d_movenet_{half.name}.csv"


def _read_labels(path: Path) -> np.ndarray:
    """Frames x joints x 2, NaN where the network is not sure."""
    columns = tuple(f"{joint}_{part}" for joint in _JOINTS for part in ("x", "y", "score"))
    values = np.array([[row.number(column) for column in columns] for row in csv_table.read(path, columns)])
    values = values.reshape(len(values), len(_JOINTS), 3)
    return np.where(values[:, :, 2:] >= _LEAST_SCORE, values[:, :, :2], np.nan)
