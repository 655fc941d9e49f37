"""`deixis evaluate pointing`: which pointing gestures are recognised, with which object, and when.

The table is that of Hofemann, Fritsch, Sagerer 2004: the method as printed with its kinds of context, and
beside them the shipped configuration (`default`). Motion models are learned from the other people of the
data. Objects are the true boxes, as in the paper.
"""

from __future__ import annotations

import argparse
import tempfile
from pathlib import Path
from typing import Any

from deixis_frontend import layout
from deixis_frontend.errors import UserError
from deixis_frontend.evaluation import pointing_plots, pointing_program, report_options
from deixis_frontend.evaluation.gesture_scores import (
    RecognisedGesture, Score, score_sequence, summarise)
from deixis_frontend.evaluation.pointing_program import Column, Events, Job
from deixis_frontend.evaluation.sequences import (
    SEQUENCE_FILES, Sequence, Skipped, read_sequences)
from deixis_frontend.evaluation.tracked_recordings import write_tracked_recordings
from deixis_frontend.evaluation.vr_pointing import (
    MILLISECONDS, Movement, is_vr_folder, write_vr_recordings)
from deixis_frontend.number_options import positive_count
from deixis_frontend.training.recordings import as_word, write_recordings

_PRINTED = ("recogniser.method=as_printed", "recogniser.hands=acting")
_KEY = "recogniser.as_printed"
WEIGHTS = (0.8, 0.6, 0.4, 0.2, 0.1, 0.0)
DEFAULT = Column("default")
ACTING = Column("default_acting", ("recogniser.hands=acting",))
PRINTED = tuple(
    Column(name, (*_PRINTED, f"{_KEY}.context={name}")) for name in ("none", "distance", "directed")
) + tuple(
    Column(f"weighted_{p}", (*_PRINTED, f"{_KEY}.context=weighted", f"{_KEY}.p_missing={p}"))
    for p in WEIGHTS
)
# Sequences of this kind have objects behind one another: the image alone cannot tell them apart.
_NEEDS_DEPTH = "pointing_"


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Which sequences, which hands, how often, and where the figures go."""
    parser.add_argument("--data", type=Path, required=True, metavar="DIR",
                        help="folder of sequence folders, or of the VR motion capture")
    parser.add_argument("--only", metavar="GLOB", help="names of sequences to use")
    report_options.add_json(parser)
    report_options.add_plots(parser)
    parser.add_argument("--hands", choices=("true", "tracked", "both"), default="true",
                        help="true: labelled positions with 2.5 px noise, filtered; tracked: what the"
                             " shipped programs see in the video (default: true)")
    parser.add_argument("--seeds", type=positive_count, default=10, metavar="N", help="runs (default: 10)")
    parser.add_argument("--set", dest="settings", action="append", default=[], metavar="KEY=VALUE",
                        help="override a key of gesture_recogniser.yaml")


def run(arguments: argparse.Namespace) -> int:
    """0; raises UserError when there is nothing to measure."""
    report_options.check(arguments)
    where = layout.find()
    with tempfile.TemporaryDirectory() as folder:
        if is_vr_folder(arguments.data):
            report = _evaluate_vr(where, arguments, Path(folder))
        else:
            report = _evaluate_sequences(where, arguments, Path(folder))
    report_options.write_json(arguments, report)
    if arguments.plots:
        pointing_plots.write(report, arguments.plots)
    return 0


def _evaluate_sequences(where: layout.Layout, arguments: argparse.Namespace,
                        folder: Path) -> dict[str, Any]:
    sequences, skipped = read_sequences(arguments.data, arguments.only)
    for left_out in skipped:
        print(f"not used: {left_out.name} ({left_out.reason})")
    groups = _Groups(sequences)
    if not groups.main and not groups.free:
        raise UserError(f"no sequences with gestures in {arguments.data}: nothing was measured:"
                        f" each is a folder with {', '.join(SEQUENCE_FILES)}; a clip without them is"
                        " for `deixis demo --clip`")
    report: dict[str, Any] = {"sequences": [], "summary": {}, "skipped": [vars(s) for s in skipped]}
    kinds = ("true", "tracked") if arguments.hands == "both" else (arguments.hands,)
    for kind in kinds:
        summary, rows = _Evaluation(where, arguments, folder / kind, groups, kind).run()
        report["sequences"] += rows
        if kind == kinds[0]:
            report["summary"].update(summary)
        else:
            report["summary"][kind] = summary
    return report


class _Groups:
    """Sequences by what they are good for."""

    def __init__(self, sequences: list[Sequence]):
        labelled = [s for s in sequences if s.gestures and s.objects]
        self.free = [s for s in sequences if not s.gestures]
        self.depth = [s for s in labelled if s.name.startswith(_NEEDS_DEPTH)]
        self.stress = [s for s in labelled if s.name.startswith("stress_")]
        self.main = [s for s in labelled if s not in self.depth and s not in self.stress]
        if not self.main:
            self.main, self.depth = self.depth, []
        if not self.main:
            self.main, self.stress = self.stress, []


class _Evaluation:
    """All figures for one kind of hands."""

    def __init__(self, where: layout.Layout, arguments: argparse.Namespace, folder: Path,
                 groups: _Groups, kind: str):
        self._where = where
        self._folder = folder
        self._groups = groups
        self._kind = kind
        self._seeds = arguments.seeds
        self._settings = tuple(arguments.settings)

    def run(self) -> tuple[dict[str, Any], list[dict[str, Any]]]:
        """The summary by column and group, and one row per sequence."""
        print(f"\nhands: {self._kind}")
        summary, rows = {}, []
        if self._groups.main:
            summary, rows = self._table(self._groups.main, "main", (*PRINTED, DEFAULT, ACTING))
        for name, sequences in (("pointing_in_depth", self._groups.depth),
                                ("stress", self._groups.stress)):
            if sequences:
                print(f"{name}: {len(sequences)} sequences, apart")
                figures, more = self._table(sequences, name, (DEFAULT,))
                summary[name] = figures["default"]
                rows += more
        if self._groups.free and self._groups.main:
            summary["free_motion"] = self._free_motion()
        return summary, rows

    def _recordings(self, sequences: list[Sequence], name: str) -> Path:
        folder = self._folder / name
        if folder.exists():
            return folder
        if self._kind == "true":
            write_recordings(sequences, folder)
        else:
            for remark in write_tracked_recordings(self._where, sequences, folder):
                print(remark)
        return folder

    def _training(self) -> Path | None:
        """True hands of the main sequences, when there is more than one person; else shipped models."""
        if len({s.person_id for s in self._groups.main}) < 2:
            return None
        folder = self._folder / "training"
        if not folder.exists():
            write_recordings(self._groups.main, folder)
        return folder

    def _table(self, sequences: list[Sequence], name: str,
               columns: tuple[Column, ...]) -> tuple[dict[str, Any], list[dict[str, Any]]]:
        events = pointing_program.run(self._where, Job(
            columns, self._recordings(sequences, name), self._seeds, self._training(),
            settings=self._settings))
        summary = {}
        print(_HEADING)
        for column in columns:
            scores = [_score(sequences, events, column.name, seed)
                      for seed in range(1, self._seeds + 1)]
            summary[column.name] = summarise([_total(by_name) for by_name in scores])
            print(_line(column.name, summary[column.name]))
        rows = [_row(sequence, events, self._seeds, self._kind) for sequence in sequences]
        return summary, rows

    def _free_motion(self) -> dict[str, Any]:
        """People who do not point, with the objects of every labelled sequence put into the scene."""
        seeds = min(self._seeds, 3)
        events = pointing_program.run(self._where, Job(
            (DEFAULT,), self._recordings(self._groups.free, "free"), seeds, self._training(),
            self._recordings(self._groups.main, "main"), self._settings))
        alarms = sum(len(e) for runs in events["default"].values() for e in runs.values())
        minutes = sum(s.frames / s.fps for s in self._groups.free) / 60.0
        minutes *= seeds * len(self._groups.main)
        per_minute = alarms / minutes
        print(f"free motion: {len(self._groups.free)} sequences with the objects of"
              f" {len(self._groups.main)} scenes: {10 * per_minute:.1f} false alarms per 10 minutes")
        return {"false_alarms_per_min": round(per_minute, 3), "minutes": round(minutes, 2),
                "sequences": [s.name for s in self._groups.free]}


def _score(sequences: list[Sequence], events: Events, column: str, seed: int) -> dict[str, Score]:
    return {
        s.name: score_sequence(s.gestures, _events_of(s.name, events[column][seed]), s.fps,
                               s.frames, names_objects=column != "none")
        for s in sequences
    }


def _events_of(name: str, events: dict[tuple[str, str], list[RecognisedGesture]]
               ) -> list[RecognisedGesture]:
    return events.get((as_word(name), as_word(name)), [])


def _total(scores: dict[str, Score]) -> Score:
    total = Score()
    for score in scores.values():
        total.add(score)
    return total


def _row(sequence: Sequence, events: Events, seeds: int, kind: str) -> dict[str, Any]:
    scores = [_score([sequence], events, "default", seed)[sequence.name]
              for seed in range(1, seeds + 1)]
    return {"name": sequence.name, "person": sequence.person_id, "hands": kind,
            "frames": sequence.frames, **summarise(scores)}


_HEADING = (f"{'column':<16}{'expected':>9}{'correct':>9}{'ins':>7}{'del':>7}{'sub':>7}{'(amb)':>7}"
            f"{'WER %':>14}{'recognised %':>16}{'alarms/min':>12}{'delay s':>9}")


def _line(name: str, figures: dict[str, float]) -> str:
    delay = figures.get("decision_delay_median_s")
    return (f"{name:<16}{figures['expected']:>9.0f}{figures['correct']:>9.1f}"
            f"{figures['insertions']:>7.1f}{figures['deletions']:>7.1f}"
            f"{figures['substitutions']:>7.1f}{figures['ambiguous']:>7.1f}"
            f"{figures['wer_percent']:>8.1f} +-{figures['wer_spread_percent']:>4.1f}"
            f"{figures['recognition_percent']:>10.1f} +-{figures['recognition_spread_percent']:>4.1f}"
            f"{figures['false_alarms_per_min']:>12.2f}"
            + (f"{delay:>9.2f}" if delay is not None else f"{'-':>9}"))


def _evaluate_vr(where: layout.Layout, arguments: argparse.Namespace,
                 folder: Path) -> dict[str, Any]:
    movements = write_vr_recordings(arguments.data, folder)
    seeds = min(arguments.seeds, 3)
    events = pointing_program.run(
        where, Job((DEFAULT,), folder, seeds, settings=tuple(arguments.settings)))
    people: dict[str, list[Movement]] = {}
    for movement in movements:
        people.setdefault(movement.person, []).append(movement)
    print(f"real people, targets out of reach, one of 6: {len(movements)} movements\n{_HEADING}")
    rows = []
    for person, theirs in people.items():
        figures = summarise([_vr_score(theirs, events, seed) for seed in range(1, seeds + 1)])
        rows.append({"name": person, "hands": "true", "movements": len(theirs), **figures})
        print(_line(person, figures))
    total = summarise([_vr_score(movements, events, seed) for seed in range(1, seeds + 1)])
    print(_line("default", total))
    skipped: list[Skipped] = []
    return {"sequences": rows, "summary": {"default": total}, "skipped": skipped}


def _vr_score(movements: list[Movement], events: Events, seed: int) -> Score:
    total = Score()
    for movement in movements:
        found = _events_of(movement.name, events["default"][seed])
        total.add(score_sequence([movement.gesture], found, MILLISECONDS, movement.duration_ms))
    return total
