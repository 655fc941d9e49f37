"""Recordings whose hands are labelled: sequence folders, and two public kinds of video.

- sequence folders: joints.csv names r_hand and l_hand (0.4 wrist + 0.6 middle knuckle) of every frame
- videos beside a text file of hand boxes (one line per frame, corners as shares of width and height): the
  box's centre stands for the hand
- videos beside <name>_movenet.csv: body joints by a network; the hand lies 0.4 forearms beyond the wrist
"""

from __future__ import annotations

import csv
from dataclasses import dataclass
from fnmatch import fnmatch
from pathlib import Path

import numpy as np

from deixis_frontend.errors import UserError
from deixis_frontend.evaluation.hand_scores import TrueHand
from deixis_frontend.evaluation.sequences import Sequence, Skipped, read_sequences

_SIDES = {"right": "r", "left": "l"}
_VIDEO_SIZE = (640, 480)  # of the videos with hand boxes
_LEAST_SCORE = 0.3  # of a network's joint


@dataclass(frozen=True)
class HandRecording:
    """A video with its labelled hands; one entry per frame."""

    name: str
    video: Path
    truth: list[list[TrueHand]]
    gates_px: list[float]  # how far from its hand a track may be
    others: list[list[tuple[float, float]]]  # hands of bystanders: a track there is not false


def read_recordings(data: Path, only: str | None) -> tuple[list[HandRecording], list[Skipped]]:
    """The recordings in `data` whose name matches the glob `only`, and those without labelled hands."""
    if not data.is_dir():
        raise UserError(f"--data {data} is no folder: name one with sequence folders or videos")
    sequences, skipped = read_sequences(data, only, ("joints.csv", "left.mp4"))
    recordings = [_from_sequence(sequence) for sequence in sequences]
    for video in sorted([*data.glob("*.mp4"), *data.glob("*.avi")]):
        if only and not fnmatch(video.stem, only):
            continue
        joints = video.with_name(f"{video.stem}_movenet.csv")
        boxes = video.with_suffix(".txt")
        if joints.exists():
            recordings.append(_from_joints(video, joints))
        elif boxes.exists():
            recordings.append(_from_boxes(video, boxes))
        elif not (data / "sequence.csv").exists():
            skipped.append(Skipped(video.stem, "has no labelled hands"))
    return recordings, skipped


def _from_sequence(sequence: Sequence) -> HandRecording:
    head = sequence.joints["chin"][:, 4] - sequence.joints["head_top"][:, 4]
    gate = max(25.0, 0.75 * float(np.nanmedian(head)))
    width = int(sequence.intrinsics.get("image_width", 640))
    height = int(sequence.intrinsics.get("image_height", 480))
    truth: list[list[TrueHand]] = []
    others: list[list[tuple[float, float]]] = []
    for frame in range(sequence.frames):
        truth.append([_hand_of(sequence, side, frame, width, height) for side in _SIDES])
        others.append([(float(values[frame][3]), float(values[frame][4]))
                       for name, values in sequence.second_person_joints.items()
                       if name in ("r_hand", "l_hand")])
    return HandRecording(sequence.name, sequence.video, truth, [gate] * sequence.frames, others)


def _hand_of(sequence: Sequence, side: str, frame: int, width: int, height: int) -> TrueHand:
    u, v, visible = sequence.joints[f"{_SIDES[side]}_hand"][frame][3:6]
    is_inside = 0 <= u < width and 0 <= v < height
    return TrueHand(side, (float(u), float(v)), bool(visible == 1 and is_inside))


def _from_boxes(video: Path, boxes: Path) -> HandRecording:
    truth, gates = [], []
    for line in boxes.read_text().splitlines():
        values = np.array([float(v) for v in line.split()[1:5]])
        corners = values * np.tile(_VIDEO_SIZE, 2)
        centre = 0.5 * (corners[:2] + corners[2:])
        truth.append([TrueHand("unknown", (float(centre[0]), float(centre[1])), True)])
        gates.append(0.5 * float(np.hypot(*(corners[2:] - corners[:2]))))
    return HandRecording(video.stem, video, truth, gates, [[] for _ in truth])


def _from_joints(video: Path, joints: Path) -> HandRecording:
    truth, gates = [], []
    with joints.open(newline="") as file:
        for row in csv.DictReader(file):
            truth.append([hand for side in _SIDES if (hand := _beyond_wrist(row, side))])
            shoulders = _joint(row, "left_shoulder") - _joint(row, "right_shoulder")
            gates.append(max(25.0, 0.45 * float(np.hypot(*shoulders))))
    return HandRecording(video.stem, video, truth, gates, [[] for _ in truth])


def _beyond_wrist(row: dict[str, str], side: str) -> TrueHand | None:
    elbow, wrist = _joint(row, f"{side}_elbow"), _joint(row, f"{side}_wrist")
    if min(float(row[f"{side}_{name}_score"]) for name in ("elbow", "wrist")) < _LEAST_SCORE:
        return None
    hand = wrist + 0.4 * (wrist - elbow)
    is_inside = bool(0 <= hand[0] < _VIDEO_SIZE[0] and 0 <= hand[1] < _VIDEO_SIZE[1])
    return TrueHand(side, (float(hand[0]), float(hand[1])), is_inside)


def _joint(row: dict[str, str], name: str) -> np.ndarray:
    return np.array([float(row[f"{name}_x"]), float(row[f"{name}_y"])])
