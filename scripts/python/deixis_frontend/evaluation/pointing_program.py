"""Runs deixis-evaluate-pointing: many configurations and seeds over recordings, in one process."""

from __future__ import annotations

import csv
import io
from collections import defaultdict
from dataclasses import dataclass, field
from pathlib import Path

from deixis_frontend import layout
from deixis_frontend.evaluation.gesture_scores import RecognisedGesture
from deixis_frontend.programs import run_program

# column -> seed -> (recording, scene) -> events
Events = dict[str, dict[int, dict[tuple[str, str], list[RecognisedGesture]]]]


@dataclass(frozen=True)
class Column:
    """A configuration to run: its name and the keys that differ from the shipped file."""

    name: str
    settings: tuple[str, ...] = ()

    def argument(self) -> str:
        """As deixis-evaluate-pointing takes it."""
        return f"{self.name}:{','.join(self.settings)}" if self.settings else self.name


@dataclass(frozen=True)
class Job:
    """What to run, over what."""

    columns: tuple[Column, ...]
    recordings: Path
    seeds: int = 1
    training: Path | None = None  # models from here, the tested person left out; None = shipped
    scenes: Path | None = None  # objects of these are put into each recording
    settings: tuple[str, ...] = field(default=())  # for all columns


def run(where: layout.Layout, job: Job) -> Events:
    """The events of all columns and seeds."""
    arguments = ["--recordings", str(job.recordings), "--seeds", str(job.seeds)]
    if job.training:
        arguments += ["--training", str(job.training)]
    if job.scenes:
        arguments += ["--scenes", str(job.scenes)]
    for column in job.columns:
        arguments += ["--column", column.argument()]
    for setting in job.settings:
        arguments += ["--set", setting]
    return _parse(run_program(where, "deixis-evaluate-pointing", *arguments))


def _parse(text: str) -> Events:
    events: Events = defaultdict(lambda: defaultdict(lambda: defaultdict(list)))
    for row in csv.DictReader(io.StringIO(text)):
        events[row["column"]][int(row["seed"])][row["recording"], row["scene"]].append(
            RecognisedGesture(float(row["time_s"]), row["side"], row["outcome"], int(row["object"]))
        )
    return events
