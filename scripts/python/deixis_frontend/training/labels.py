"""The labels of a log's gestures: a CSV file beside it."""

from __future__ import annotations

from collections.abc import Collection
from pathlib import Path

from deixis_frontend import csv_table
from deixis_frontend.csv_table import Row
from deixis_frontend.errors import Refusal, UserError

TIMES = ("start_s", "apex_s", "end_s", "retract_end_s")
COLUMNS = (*TIMES, "hand", "object_id")
HANDS = ("left", "right")


def read_lines(labels: Path, objects: Collection[int], duration_s: float) -> list[str]:
    """The labels as lines of a recording; raises Refusal with all faults, each with its line.

    `objects` are the ids that can be meant; gestures lie within the `duration_s` of the recording.
    """
    rows = csv_table.read(labels, COLUMNS)
    if not rows:
        raise UserError(f"{labels} holds no labels below its first line")
    lines, faults = [], []
    for row in rows:
        try:
            lines.append(_line(row, objects, duration_s))
        except UserError as fault:
            faults.append(str(fault))
    if faults:
        raise Refusal(faults)
    return lines


def _line(row: Row, objects: Collection[int], duration_s: float) -> str:
    times = [row.number(name) for name in TIMES]
    if times[0] < 0 or times[2] > duration_s:
        raise row.fault(f"{times[0]:g} s to {times[2]:g} s is not within the recording"
                        f" (0 to {duration_s:.3f} s)")
    if not times[0] < times[1] <= times[2] <= times[3]:
        raise row.fault(f"times are out of order: {' < '.join(TIMES[:2])} <="
                        f" {' <= '.join(TIMES[2:])}")
    hand = row.choice("hand", HANDS)
    thing = row.whole("object_id")
    if thing not in objects:
        raise row.fault(f"object_id {thing} is not among the objects of the recording"
                        f" ({', '.join(map(str, sorted(objects))) or 'there are none'})")
    return f"gesture {' '.join(f'{time:.4f}' for time in times)} {hand} {thing}"
