"""Converts the motion capture of people who point in virtual reality into recordings.

Five people point at 27 places that are out of reach. A virtual camera stands in front of the person
(640 x 480, 60 degrees); the hand's marker is the hand, the head's marker the middle of the face, and the
target with five others, drawn at random, are the objects. The frame of the data: x to the person's
right, y up, z forward, metres.
"""

from __future__ import annotations

import csv
from collections import defaultdict
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from deixis_frontend.evaluation.sequences import LabelledGesture, SceneObject
from deixis_frontend.training.recordings import FACE_BOX_M, header

MILLISECONDS = 1000.0  # "frames" per second of the labels: these recordings have no frame rate
_CAMERA_M = (0.0, 1.3, 5.0)
_FOCAL_PX = 554.0
_FEWEST_SAMPLES = 25
_OBJECT_M = 0.10
_OTHERS = 5


@dataclass(frozen=True)
class Movement:
    """One pointing movement as a recording."""

    name: str
    person: str
    gesture: LabelledGesture
    duration_ms: int


def is_vr_folder(data: Path) -> bool:
    """True when `data` looks like that motion capture."""
    return (data / "targets.csv").exists() and (data / "participant_01.csv").exists()


def write_vr_recordings(data: Path, folder: Path) -> list[Movement]:
    """One file per movement of at least 25 samples."""
    folder.mkdir(parents=True, exist_ok=True)
    targets = {(row["pid"], row["cid"]): _vector(row, "target") for row in _rows(data / "targets.csv")}
    places = np.unique(np.round(np.array(list(targets.values())), 3), axis=0)
    random = np.random.default_rng(1)
    movements = []
    for file in sorted(data.glob("participant_[0-9]*.csv")):
        person = str(int(file.stem.split("_")[1]))
        for number, rows in _movements(file).items():
            if len(rows) < _FEWEST_SAMPLES:
                continue
            target = int(np.abs(places - np.round(targets[person, number], 3)).sum(1).argmin())
            others = [i for i in range(len(places)) if i != target]
            shown = [target, *random.choice(others, _OTHERS, replace=False)]
            movements.append(_write(folder, person, number, rows, target, places, sorted(shown)))
    return movements


def _write(folder: Path, person: str, number: str, rows: list[dict[str, str]], target: int,
           places: np.ndarray, shown: list[int]) -> Movement:
    name = f"vr_{person}_{int(number):03d}"
    times = np.array([float(row["time"]) for row in rows])
    times -= times[0]
    hands = np.array([_vector(row, "hand") for row in rows])
    apex_s, end_s = _apex(times, hands), float(times[-1])
    objects = [_object(int(i), places[i]) for i in shown]
    lines = header(name, f"vr{person}", objects)
    lines.append(f"gesture 0 {apex_s:.3f} {end_s:.3f} {end_s:.3f} right {target}")
    for time, hand, row in zip(times, hands, rows):
        lines += [f"frame {time:.4f}", _face(_vector(row, "hmd"))]
        u, v, _ = _project(hand)
        lines.append(f"hand 0 right {u:.2f} {v:.2f} 0 1 1")
    (folder / f"{name}.recording").write_text("\n".join(lines) + "\n")
    end_ms = int(MILLISECONDS * end_s)
    gesture = LabelledGesture(0, int(MILLISECONDS * apex_s), end_ms, end_ms, "right", target, "")
    return Movement(name, f"vr{person}", gesture, end_ms)


def _apex(times: np.ndarray, hands: np.ndarray) -> float:
    """When the hand's speed last was above a tenth of its peak."""
    speeds = np.linalg.norm(np.diff(hands, axis=0), axis=1) / np.maximum(np.diff(times), 0.005)
    fast = np.nonzero(speeds > 0.1 * np.percentile(speeds, 95))[0]
    return float(times[fast[-1] + 1]) if len(fast) else float(times[-1])


def _project(point: np.ndarray) -> tuple[float, float, float]:
    """Pixel of a point for a camera that looks at the person's front, and pixels per metre there."""
    scale = _FOCAL_PX / (_CAMERA_M[2] - point[2])
    return 320.0 - scale * point[0], 240.0 - scale * (point[1] - _CAMERA_M[1]), scale


def _object(number: int, place: np.ndarray) -> SceneObject:
    u, v, scale = _project(place)
    side = _OBJECT_M * scale
    return SceneObject(number, f"place_{number}", tuple(place), (u - side / 2, v - side / 2, side, side))


def _face(head: np.ndarray) -> str:
    u, v, scale = _project(head)
    side = FACE_BOX_M * scale
    return f"face {u - side / 2:.1f} {v - side / 2:.1f} {side:.1f} {side:.1f}"


def _vector(row: dict[str, str], name: str) -> np.ndarray:
    return np.array([float(row[f"{name}.{axis}"]) for axis in "XYZ"])


def _movements(file: Path) -> dict[str, list[dict[str, str]]]:
    movements: dict[str, list[dict[str, str]]] = defaultdict(list)
    for row in _rows(file):
        movements[row["cid"]].append(row)
    return movements


def _rows(file: Path) -> list[dict[str, str]]:
    with file.open(newline="") as stream:
        return list(csv.DictReader(stream))
