"""Writes sequences as recordings: the text that deixis-train-gestures and deixis-evaluate-pointing read.

The format is described in services/gesture_recogniser/evaluation/recording.h.
"""

from __future__ import annotations

from pathlib import Path
from typing import Iterable

import numpy as np

from deixis_frontend.evaluation.sequences import SceneObject, Sequence

# The square box of the face detector, as measured on rendered people: its size on the person and how far
# its middle lies above the nose, metres.
FACE_BOX_M = 0.18
FACE_ABOVE_NOSE_M = 0.016


def write_recordings(sequences: Iterable[Sequence], folder: Path) -> None:
    """One file per sequence, with true hands (sigma 0) and a face box around the true nose."""
    folder.mkdir(parents=True, exist_ok=True)
    for sequence in sequences:
        lines = header(sequence.name, sequence.person_id, sequence.objects)
        lines += gesture_lines(sequence)
        lines += _frames(sequence)
        (folder / f"{sequence.name}.recording").write_text("\n".join(lines) + "\n")


def header(name: str, person: str, objects: Iterable[SceneObject]) -> list[str]:
    """The lines that name a recording and its objects."""
    lines = [f"recording {as_word(name)} {as_word(person) or 'unknown'}"]
    for thing in objects:
        label = as_word(thing.label) or "object"
        lines.append(f"object {thing.id} {label} " + " ".join(f"{v:.1f}" for v in thing.box_px))
    return lines


def as_word(name: str) -> str:
    """A name as it stands in a recording, whose lines are words: blanks become underscores."""
    return "_".join(name.split())


def acting_hand(sequence: Sequence, frame: int) -> str:
    """The hand of the gesture that is nearest in time; the right one without gestures."""
    gestures = sequence.gestures
    if not gestures:
        return "right"
    for this, following in zip(gestures, gestures[1:]):
        if frame <= (this.retract_end_frame + following.start_frame) / 2:
            return this.hand
    return gestures[-1].hand


def gesture_lines(sequence: Sequence) -> list[str]:
    """The lines that label a recording's gestures."""
    return [
        "gesture "
        + " ".join(
            f"{frame / sequence.fps:.4f}"
            for frame in (g.start_frame, g.apex_frame, g.end_frame, g.retract_end_frame)
        )
        + f" {g.hand} {g.object_id}"
        for g in sequence.gestures
    ]


def _frames(sequence: Sequence) -> list[str]:
    lines = []
    for frame in range(sequence.frames):
        lines.append(f"frame {frame / sequence.fps:.6f}")
        lines += _face(sequence, frame)
        acting = acting_hand(sequence, frame)
        for number, side in enumerate(("right", "left")):
            u, v = sequence.joints[f"{side[0]}_hand"][frame, 3:5]
            if np.isfinite(u) and u >= 0:
                lines.append(f"hand {number} {side} {u:.2f} {v:.2f} 0 1 {int(side == acting)}")
    return lines


def _face(sequence: Sequence, frame: int) -> list[str]:
    """A square around the middle of the face, its size by the nose's true distance."""
    nose, chin, top = (sequence.joints[name][frame] for name in ("nose", "chin", "head_top"))
    if not np.isfinite(nose).all() or nose[3] < 0 or nose[2] <= 0:
        return []
    head_px = float(np.hypot(*(chin[3:5] - top[3:5])))
    head_m = float(np.linalg.norm(chin[:3] - top[:3]))
    side = FACE_BOX_M * head_px / head_m
    top_px = nose[4] - FACE_ABOVE_NOSE_M * head_px / head_m - side / 2
    return [f"face {nose[3] - side / 2:.1f} {top_px:.1f} {side:.1f} {side:.1f}"]
