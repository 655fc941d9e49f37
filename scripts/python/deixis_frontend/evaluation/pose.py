"""`deixis evaluate pose`: how far the pose fitter is from true people, what it loses, and whether it knows.

Runs the shipped programs: stereo driver (video to log), then pose fitter (log to log); twice: with the person's
stature told, and with nothing told. Start pose, lengths and mask are never given.
"""

from __future__ import annotations

import argparse
import tempfile
from concurrent.futures import Future, ThreadPoolExecutor, as_completed
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from deixis_frontend import layout, output_files
from deixis_frontend.errors import UserError
from deixis_frontend.evaluation import (
    pose_chain, pose_matching, pose_plots, pose_real, pose_report, pose_results, pose_scores, pose_truth,
    report_options)
from deixis_frontend.evaluation.pose_chain import Chain
from deixis_frontend.evaluation.pose_matching import JudgedScene
from deixis_frontend.evaluation.pose_overlays import Overlay
from deixis_frontend.evaluation.sequences import Sequence, Skipped, read_sequences
from deixis_frontend.number_options import positive_count
from deixis_frontend.progress_bar import ProgressBar

COLUMNS = ("stature_given", "nothing_given")


@dataclass(frozen=True)
class Run:
    """One sequence in one column."""

    sequence: Sequence
    column: str
    scene: pose_truth.TrueScene
    judged: JudgedScene
    fit_ms: list[float]


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Which sequences, which settings, and where the figures go."""
    parser.add_argument("--data", type=Path, required=True, metavar="DIR",
                        help="folder of sequence folders, or of recordings of real people")
    parser.add_argument("--only", metavar="GLOB", help="names of sequences to use")
    report_options.add_json(parser)
    report_options.add_plots(parser, "worst frames and of errors over time")
    parser.add_argument("--overlays", type=Path, metavar="DIR",
                        help="write films (MP4) and pictures (PNG) of the limbs fitted to stereo sequences")
    parser.add_argument("--columns", choices=(*COLUMNS, "both"), default="both",
                        help="what is told of the people (default: both, one after the other)")
    parser.add_argument("--hands", action=argparse.BooleanOptionalAction, default=True,
                        help="let the fitter hear of hands and faces, as the group stereo does (default: yes)")
    parser.add_argument("--together", action="store_true",
                        help="run stereo driver and fitter in one process, so that the driver hears of the bodies")
    parser.add_argument("--depth-cache", type=Path, metavar="DIR",
                        help="keep the logs of depth here, and take them from here")
    parser.add_argument("--jobs", type=positive_count, default=2, metavar="N",
                        help="sequences at a time (default: 2)")
    parser.add_argument("--set", dest="settings", action="append", default=[], metavar="KEY=VALUE",
                        help="override a key of pose_fitter.yaml")
    parser.add_argument("--stereo-set", dest="stereo_settings", action="append", default=[],
                        metavar="KEY=VALUE", help="override a key of stereo_driver.yaml")


def run(arguments: argparse.Namespace) -> int:
    """0; 1 when a sequence could not be run; raises UserError when there is nothing to measure."""
    report_options.check(arguments)
    if arguments.overlays:
        output_files.require_folder(arguments.overlays, "--overlays")
    where, chain = layout.find(), _chain(arguments)
    real = pose_real.find(arguments.data, arguments.only)
    sequences, skipped = read_sequences(arguments.data, arguments.only, pose_truth.NEEDED)
    skipped = [s for s in skipped if s.name not in {folder.name for _, folder, _ in real}]
    for left_out in skipped:
        print(f"not used: {left_out.name} ({left_out.reason})")
    if not sequences and not real:
        raise UserError(f"no sequences with stereo videos and true joints in {arguments.data}: nothing was"
                        f" measured: each is a folder with sequence.csv, {', '.join(pose_truth.NEEDED)}")
    with tempfile.TemporaryDirectory() as scratch:
        runs, failed = _run_all(where, chain, arguments, sequences, Path(scratch))
    report = _report(runs, skipped, failed)
    pose_report.show(report)
    reports, real_failed = pose_real.evaluate_all(where, real, chain)
    report["real"] = reports
    report["summary"].update({name: of_kind["summary"] for name, of_kind in reports.items()})
    report["failed"] += [vars(s) for s in real_failed]
    report_options.write_json(arguments, report)
    return 1 if report["failed"] else 0


def _chain(arguments: argparse.Namespace) -> Chain:
    return Chain(tuple(arguments.settings), tuple(arguments.stereo_settings), arguments.hands,
                 arguments.together, arguments.depth_cache)


def _run_all(where: layout.Layout, chain: Chain, arguments: argparse.Namespace, sequences: list[Sequence],
             scratch: Path) -> tuple[list[Run], list[Skipped]]:
    """All runs in the order of the sequences, and what failed."""
    columns = COLUMNS if arguments.columns == "both" else (arguments.columns,)
    runs: list[Run] = []
    failed: list[Skipped] = []
    with ThreadPoolExecutor(arguments.jobs) as pool, ProgressBar(len(sequences)) as bar:
        jobs: dict[Future[list[Run]], Sequence] = {
            pool.submit(_run_sequence, where, sequence, chain, columns, scratch, arguments): sequence
            for sequence in sequences}
        try:
            for done, job in enumerate(as_completed(jobs), 1):
                bar.show(done)
                try:
                    runs += job.result()
                except UserError as error:
                    failed.append(Skipped(jobs[job].name, str(error)))
                    print(f"not run: {jobs[job].name} ({error})", flush=True)
        finally:
            pool.shutdown(wait=False, cancel_futures=True)  # Ctrl-C does not wait for those to come.
    return sorted(runs, key=lambda r: r.sequence.name), failed


def _run_sequence(where: layout.Layout, sequence: Sequence, chain: Chain, columns: tuple[str, ...],
                  scratch: Path, arguments: argparse.Namespace) -> list[Run]:
    scene = pose_truth.read_scene(sequence)
    log = pose_chain.stereo_log(where, sequence.folder, chain, scratch)
    runs = []
    for column in columns:
        stature = pose_truth.stature_m(sequence) if column == "stature_given" else 0.0
        if stature is None:
            continue
        name = f"{sequence.name}_{column}"
        overlay = Overlay(arguments.overlays, name, scene.fps) if arguments.overlays else None
        fitted = pose_chain.fit(where, log, chain, (f"fitter.stature_m={stature:g}",), sequence.folder, overlay)
        judged = pose_matching.judge(scene, pose_results.read(fitted.messages))
        runs.append(Run(sequence, column, scene, judged, fitted.fit_ms))
        if arguments.plots:  # At once: messages of all runs together are too much to keep.
            pose_plots.write(name, judged.people[0], scene.segments, log, fitted.messages, arguments.plots)
    return runs


def _report(runs: list[Run], skipped: list[Skipped], failed: list[Skipped]) -> dict[str, Any]:
    columns = [column for column in COLUMNS if any(r.column == column for r in runs)]
    return {"sequences": [_row(r) for r in runs],
            "summary": {column: _summary([r for r in runs if r.column == column]) for column in columns},
            "skipped": [vars(s) for s in skipped], "failed": [vars(s) for s in failed]}


def _row(one: Run) -> dict[str, Any]:
    segments = [{"label": s.label, "start_frame": s.start,
                 **pose_scores.brief([one.judged.people[0].cut(slice(s.start, s.end + 1))])}
                for s in one.scene.segments]
    others = [{"name": p.name, **pose_scores.of_people([p])} for p in one.judged.people[1:]]
    return {"name": one.sequence.name, "column": one.column, "person": one.sequence.person_id,
            **pose_scores.of_scenes([one.judged]), **_times([one]), "segments": segments, "bystanders": others}


def _summary(runs: list[Run]) -> dict[str, Any]:
    labels = sorted({s.label for r in runs for s in r.scene.segments})
    by_label = {label: pose_scores.brief([r.judged.people[0].cut(slice(s.start, s.end + 1)) for r in runs
                                          for s in r.scene.segments if s.label == label])
                for label in labels}
    bystanders = [p for r in runs for p in r.judged.people[1:]]
    return {**pose_scores.of_scenes([r.judged for r in runs]), **_times(runs), "segments": by_label,
            "bystanders": pose_scores.of_people(bystanders) if bystanders else None}


def _times(runs: list[Run]) -> dict[str, Any]:
    """CPU time, of all threads, per depth image."""
    times = np.array([ms for r in runs for ms in r.fit_ms])
    return {"fit_ms_median": pose_scores.percentile(times, 50, 2),
            "fit_ms_p99": pose_scores.percentile(times, 99, 2)}
