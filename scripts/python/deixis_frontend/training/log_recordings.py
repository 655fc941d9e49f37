"""Turns a log of hand tracks and objects, with labels beside it, into a recording."""

from __future__ import annotations

import csv
from pathlib import Path
from typing import Any

from deixis_frontend import layout
from deixis_frontend.errors import UserError
from deixis_frontend.evaluation.sequences import SceneObject
from deixis_frontend.evaluation.tracked_recordings import frame_lines
from deixis_frontend.training.recordings import header

_LABELS = ("start_s", "apex_s", "end_s", "retract_end_s", "hand", "object_id")


def write_log_recording(where: layout.Layout, log: Path, labels: Path, folder: Path) -> None:
    """`labels` counts its seconds from the first HAND_TRACKS message of `log`."""
    where.use_types()
    from deixis_lcm import logs

    hands: list[Any] = []
    faces: dict[int, Any] = {}
    objects: dict[int, SceneObject] = {}
    for _, channel, message in logs.read(log, channels={"HAND_TRACKS", "OBJECTS"}):
        if channel == "HAND_TRACKS":
            hands.append(message)
            continue
        faces[message.utime] = [o for o in message.objects if o.kind == o.FACE and o.has_box]
        for thing in message.objects:
            if thing.kind != thing.FACE and thing.has_box:
                objects[thing.id] = SceneObject(
                    thing.id, thing.label, tuple(thing.position_m), tuple(thing.box_px))
    if not hands:
        raise UserError(f"{log} has no HAND_TRACKS")
    lines = header(log.stem, "", objects.values()) + _label_lines(labels)
    lines += frame_lines(hands, faces)
    folder.mkdir(parents=True, exist_ok=True)
    (folder / f"{log.stem}.recording").write_text("\n".join(lines) + "\n")


def _label_lines(labels: Path) -> list[str]:
    with labels.open(newline="") as file:
        rows = list(csv.DictReader(file))
    missing = [name for name in _LABELS if rows and name not in rows[0]]
    if missing or not rows:
        raise UserError(f"{labels} must have lines with the columns {','.join(_LABELS)}")
    return ["gesture " + " ".join(row[name] for name in _LABELS) for row in rows]
