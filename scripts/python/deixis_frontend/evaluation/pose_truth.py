"""True poses of sequences, in the frame that the pose fitter answers in: the rectified left camera."""

from __future__ import annotations

import csv
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from deixis_frontend.evaluation.pose_joints import NAMES, PELVIS
from deixis_frontend.evaluation.sequences import Sequence, read_opencv_yaml

# What a sequence must have to be run and judged.
NEEDED = ("joints.csv", "left.mp4", "right.mp4", "intrinsics.yml", "extrinsics.yml")


@dataclass(frozen=True)
class Segment:
    """A stretch of frames (both ends included) in which something is done."""

    label: str
    start: int
    end: int


@dataclass(frozen=True)
class TruePerson:
    """Joints of one person per frame, in the order of `JOINTS`; NaN where they are not labelled."""

    name: str
    joints_m: np.ndarray  # frames x J x 3
    is_visible: np.ndarray  # frames x J
    pelvis_m: np.ndarray  # frames x 3

    @property
    def frames(self) -> int:
        """How many frames are labelled."""
        return len(self.pelvis_m)


@dataclass(frozen=True)
class TrueScene:
    """All that is known of one sequence. The first person is the one whose stature is told."""

    people: list[TruePerson]
    segments: list[Segment]
    fps: float


def read_scene(sequence: Sequence) -> TrueScene:
    """The people of a sequence folder."""
    rectified_from_raw = read_opencv_yaml(sequence.folder / "extrinsics.yml")["R1"]
    people = [_person(sequence.name, sequence.joints, rectified_from_raw)]
    if sequence.second_person_joints:
        people.append(_person(f"{sequence.name} person 2", sequence.second_person_joints, rectified_from_raw))
    return TrueScene(people, _segments(sequence.folder / "segments.csv"), sequence.fps)


def stature_m(sequence: Sequence) -> float | None:
    """Of the first person; None where it is not told."""
    told = sequence.person.get("stature_mm")
    return float(told) / 1000.0 if told else None


def _person(name: str, joints: dict[str, np.ndarray], rectified_from_raw: np.ndarray) -> TruePerson:
    frames = len(joints[PELVIS])
    nothing = np.full((frames, 6), np.nan)
    values = np.stack([joints.get(joint, nothing) for joint in NAMES], axis=1)
    return TruePerson(name, values[:, :, :3] @ rectified_from_raw.T, values[:, :, 5] == 1,
                      joints[PELVIS][:, :3] @ rectified_from_raw.T)


def _segments(path: Path) -> list[Segment]:
    if not path.exists():
        return []
    with path.open(newline="") as file:
        return [Segment(row["label"], int(row["start_frame"]), int(row["end_frame"]))
                for row in csv.DictReader(file)]
