"""`deixis evaluate hands`: the hand tracker's error, misses, false tracks and identity switches.

Runs the shipped programs: camera driver (video to log), object detector and hand tracker (log to log).
"""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import Any

from deixis_frontend import layout
from deixis_frontend.errors import UserError
from deixis_frontend.evaluation import report_options
from deixis_frontend.evaluation.hand_recordings import HandRecording, read_recordings
from deixis_frontend.evaluation.hand_scores import HandScore, TrackedHand, TrueHand, score
from deixis_frontend.evaluation.offline_chain import results_of_video

_SIDES = {0: "unknown", 1: "left", 2: "right"}
_HEADING = (f"{'recording':<14}{'frames':>7}{'hands':>7}{'error px':>10}{'p90':>7}{'missed %':>10}"
            f"{'false/min':>11}{'switches/min':>14}{'side ok %':>11}")


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Which recordings, which settings, and where the figures go."""
    parser.add_argument("--data", type=Path, required=True, metavar="DIR",
                        help="folder of sequence folders, or of videos with labelled hands")
    parser.add_argument("--only", metavar="GLOB", help="names of recordings to use")
    report_options.add_json(parser)
    report_options.add_plots(parser, "errors")
    parser.add_argument("--set", dest="settings", action="append", default=[], metavar="KEY=VALUE",
                        help="override a key of hand_tracker.yaml")


def run(arguments: argparse.Namespace) -> int:
    """0; raises UserError when there is nothing to measure."""
    report_options.check(arguments)
    recordings, skipped = read_recordings(arguments.data, arguments.only)
    for left_out in skipped:
        print(f"not used: {left_out.name} ({left_out.reason})")
    if not recordings:
        raise UserError(f"no labelled hands in {arguments.data}: nothing was measured")
    rows, summary = _evaluate_all(recordings, arguments.settings, arguments.plots)
    report_options.write_json(arguments, {"sequences": rows, "summary": summary,
                                          "skipped": [vars(s) for s in skipped]})
    return 0


def _evaluate_all(recordings: list[HandRecording], settings: list[str],
                  plots: Path | None) -> tuple[list[dict[str, Any]], dict[str, Any]]:
    """The figures of each recording, printed as they come, and those of all together."""
    where = layout.find()
    print(_HEADING)
    rows, total = [], HandScore()
    for recording in recordings:
        result = _evaluate(where, recording, settings)
        total.add(result)
        rows.append({"name": recording.name, **result.figures()})
        _print(rows[-1])
        if plots:
            _plot(recording.name, result, plots)
    summary = total.figures()
    _print({"name": "all", **summary})
    return rows, summary


def _evaluate(where: layout.Layout, recording: HandRecording, settings: list[str]) -> HandScore:
    messages = _track(where, recording.video, settings)
    if len(messages) != len(recording.truth):
        print(f"{recording.name}: {len(messages)} pictures, {len(recording.truth)} labelled ones")
    count = min(len(messages), len(recording.truth))
    if count == 0:
        raise UserError(f"{recording.name}: the hand tracker published nothing")
    seconds = (messages[count - 1].utime - messages[0].utime) / 1e6 / max(1, count - 1)
    truth = [[*hands, *(TrueHand("bystander", other, False) for other in others)]
             for hands, others in zip(recording.truth, recording.others)]
    return score(truth[:count], [_tracked(m) for m in messages[:count]],
                 recording.gates_px[:count], seconds)


def _track(where: layout.Layout, video: Path, settings: list[str]) -> list[Any]:
    """One hand message per picture, in order."""
    overrides = [f"hand_tracker.{setting}" for setting in settings]
    results = results_of_video(where, video, ("object_detector", "hand_tracker"), {"HAND_TRACKS"},
                               overrides)
    return [message for _, message in results]


def _tracked(message: Any) -> list[TrackedHand]:
    return [TrackedHand(hand.id, _SIDES[hand.side], (hand.centre_px[0], hand.centre_px[1]))
            for hand in message.hands]


def _print(row: dict[str, Any]) -> None:
    def number(key: str, width: int, digits: int = 1) -> str:
        value = row[key]
        return f"{'-' if value is None else f'{value:.{digits}f}':>{width}}"

    print(f"{row['name']:<14}{row['frames']:>7}{row['visible_hands']:>7}"
          f"{number('error_median_px', 10)}{number('error_p90_px', 7)}{number('miss_percent', 10)}"
          f"{number('false_tracks_per_min', 11)}{number('id_switches_per_min', 14)}"
          f"{number('side_correct_percent', 11, 0)}")


def _plot(name: str, result: HandScore, folder: Path) -> None:
    import matplotlib

    matplotlib.use("Agg")
    from matplotlib import pyplot

    folder.mkdir(parents=True, exist_ok=True)
    figure, axes = pyplot.subplots(figsize=(5, 3.5))
    errors = sorted(result.errors_px)
    axes.plot(errors, [100.0 * (i + 1) / max(1, result.visible) for i in range(len(errors))])
    axes.set(xlabel="error of the centre, px", ylabel="visible hands within it, %",
             title=name, xlim=(0, 50), ylim=(0, 100))
    axes.grid(True)
    figure.tight_layout()
    figure.savefig(folder / f"hands_{name}.png", dpi=120)
    pyplot.close(figure)
