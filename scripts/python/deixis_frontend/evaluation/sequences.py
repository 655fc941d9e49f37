"""Reads folders of recorded or rendered sequences that come with their truth.

A sequence is a folder with sequence.csv (kind, fps, frames), person.csv, joints.csv, and, where there are
any, objects.csv, gestures.csv, intrinsics.yml and left.mp4. Positions are in the optical frame of the raw
left camera (metres), pixels in its raw image.
"""

from __future__ import annotations

import csv
import fnmatch
import re
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path

import numpy as np

from deixis_frontend import csv_table
from deixis_frontend.csv_table import Row

# What the figures of gestures need.
SEQUENCE_FILES = ("sequence.csv", "joints.csv", "objects.csv", "gestures.csv")
_FRAME_COLUMNS = ("start_frame", "apex_frame", "end_frame", "retract_end_frame")
_GESTURE_COLUMNS = (*_FRAME_COLUMNS, "hand", "object_id", "object_label")
_OBJECT_COLUMNS = ("id", "label", "x", "y", "z", "u_min", "v_min", "u_max", "v_max")


@dataclass(frozen=True)
class SceneObject:
    """Something that can be pointed at."""

    id: int
    label: str
    position_m: tuple[float, float, float]
    box_px: tuple[float, float, float, float]  # left, top, width, height


@dataclass(frozen=True)
class LabelledGesture:
    """One pointing gesture; frames of its start, of the hold's begin and end, and of the hand's return."""

    start_frame: int
    apex_frame: int
    end_frame: int
    retract_end_frame: int
    hand: str  # "left" or "right", the person's own
    object_id: int
    object_label: str


@dataclass(frozen=True)
class Skipped:
    """A folder that was not used, and why."""

    name: str
    reason: str


class Sequence:
    """One folder. What is large is read when it is first asked for."""

    def __init__(self, folder: Path):
        self.folder = folder
        self.name = folder.name
        facts = _key_values(folder / "sequence.csv")
        self.fps = float(facts["fps"])
        self.frames = int(facts["frames"])

    @cached_property
    def person(self) -> dict[str, str]:
        """What person.csv says of the person; empty where it is not there."""
        return _key_values(self.folder / "person.csv")

    @property
    def person_id(self) -> str:
        """Tells people apart; empty where it is not known."""
        return self.person.get("id", "")

    @property
    def video(self) -> Path:
        """Pictures of the left camera; the file need not be there."""
        return self.folder / "left.mp4"

    @cached_property
    def objects(self) -> list[SceneObject]:
        """What can be pointed at; empty without objects.csv."""
        return [
            SceneObject(
                row.whole("id"),
                row.text("label"),
                (row.number("x"), row.number("y"), row.number("z")),
                _box(row),
            )
            for row in _table(self.folder / "objects.csv", _OBJECT_COLUMNS)
        ]

    @cached_property
    def gestures(self) -> list[LabelledGesture]:
        """The labels in order; empty without gestures.csv."""
        return [
            _gesture(row) for row in _table(self.folder / "gestures.csv", _GESTURE_COLUMNS)
        ]

    @cached_property
    def joints(self) -> dict[str, np.ndarray]:
        """Per joint an array of frames x 6: x y z (m), u v (px), visible (0 or 1); NaN where not given."""
        return _joints(self.folder / "joints.csv", self.frames)

    @cached_property
    def second_person_joints(self) -> dict[str, np.ndarray]:
        """The same of a bystander; empty without joints_person2.csv."""
        return _joints(self.folder / "joints_person2.csv", self.frames)

    @cached_property
    def intrinsics(self) -> dict[str, np.ndarray]:
        """Matrices of intrinsics.yml (M1 D1 M2 D2) and its numbers (image_width, image_height)."""
        return read_opencv_yaml(self.folder / "intrinsics.yml")


def read_sequences(
    data: Path, only: str | None = None, needed: tuple[str, ...] = ("joints.csv",)
) -> tuple[list[Sequence], list[Skipped]]:
    """The sequences in `data` (or `data` itself) whose name matches the glob `only`: those that have the
    `needed` files, and those that lack some."""
    folders = [data] if (data / "sequence.csv").exists() else sorted(_folders(data))
    used, skipped = [], []
    for folder in folders:
        if only and not fnmatch.fnmatch(folder.name, only):
            continue
        reason = _why_not(folder, needed)
        if reason:
            skipped.append(Skipped(folder.name, reason))
        else:
            used.append(Sequence(folder))
    return used, skipped


def read_opencv_yaml(path: Path) -> dict[str, np.ndarray]:
    """Matrices and plain numbers of a file that cv::FileStorage wrote."""
    text = path.read_text()
    pattern = r"(\w+):\s*!!opencv-matrix\s+rows:\s*(\d+)\s+cols:\s*(\d+)\s+dt:\s*\w+\s+data:\s*\[(.*?)\]"
    values = {
        name: np.array([float(v) for v in data.split(",")]).reshape(int(rows), int(cols))
        for name, rows, cols, data in re.findall(pattern, text, re.S)
    }
    for name, number in re.findall(r"^(\w+):\s*([-+.\deE]+)\s*$", text, re.M):
        values[name] = np.array(float(number))
    return values


def _folders(data: Path) -> list[Path]:
    if not data.is_dir():
        return []
    return [folder for folder in data.iterdir() if folder.is_dir()]


def _why_not(folder: Path, needed: tuple[str, ...]) -> str:
    missing = [name for name in ("sequence.csv", *needed) if not (folder / name).exists()]
    return f"has no {', '.join(missing)}" if missing else ""


def _rows(path: Path) -> list[dict[str, str]]:
    if not path.exists():
        return []
    with path.open(newline="") as file:
        return list(csv.DictReader(file))


def _key_values(path: Path) -> dict[str, str]:
    return {row["key"]: row["value"] for row in _rows(path)}


def _table(path: Path, columns: tuple[str, ...]) -> list[Row]:
    return csv_table.read(path, columns) if path.exists() else []


def _gesture(row: Row) -> LabelledGesture:
    frames = [row.whole(name) for name in _FRAME_COLUMNS]
    if not 0 <= frames[0] < frames[1] <= frames[2] <= frames[3]:
        raise row.fault(f"{', '.join(_FRAME_COLUMNS)} are out of order")
    return LabelledGesture(frames[0], frames[1], frames[2], frames[3],
                           row.choice("hand", ("left", "right")), row.whole("object_id"),
                           row.text("object_label"))


def _box(row: Row) -> tuple[float, float, float, float]:
    left, top, right, bottom = (row.number(k) for k in ("u_min", "v_min", "u_max", "v_max"))
    return (left, top, right - left, bottom - top)


def _joints(path: Path, frames: int) -> dict[str, np.ndarray]:
    joints: dict[str, np.ndarray] = {}
    for row in _rows(path):
        values = joints.setdefault(row["joint"], np.full((frames, 6), np.nan))
        frame = int(row["frame"])
        if 0 <= frame < frames:
            values[frame] = [float(row[k]) for k in ("x", "y", "z", "u", "v", "visible")]
    return joints
