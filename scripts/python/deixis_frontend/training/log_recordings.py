"""Turns a log of hand tracks and objects, with labels beside it, into a recording."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from deixis_frontend import layout
from deixis_frontend.errors import UserError
from deixis_frontend.evaluation.sequences import SceneObject
from deixis_frontend.evaluation.tracked_recordings import frame_lines
from deixis_frontend.lcm_tools import require_log
from deixis_frontend.training.labels import read_lines
from deixis_frontend.training.recordings import header


def write_log_recording(where: layout.Layout, log: Path, labels: Path, folder: Path) -> None:
    """`labels` counts its seconds from the first HAND_TRACKS message of `log`."""
    require_log(log)
    try:
        hands, faces, objects = _read(where, log)
    except ValueError as error:
        raise UserError(f"{error}: name a log that `deixis record` wrote") from None
    if not hands:
        raise UserError(f"{log} has no HAND_TRACKS: record while the hand tracker runs")
    duration_s = (hands[-1].utime - hands[0].utime) / 1e6
    lines = header(log.stem, "", objects.values())
    lines += read_lines(labels, objects, duration_s) + frame_lines(hands, faces)
    folder.mkdir(parents=True, exist_ok=True)
    (folder / f"{log.stem}.recording").write_text("\n".join(lines) + "\n")


def _read(where: layout.Layout,
          log: Path) -> tuple[list[Any], dict[int, Any], dict[int, SceneObject]]:
    """Hand messages in order, the faces of each capture time, the last state of each object."""
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
    return hands, faces, objects
