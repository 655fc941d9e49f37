"""`deixis evaluate depth`: how much of people has a depth, how exact it is, how long it takes.

Runs deixis-evaluate-depth, which measures OpenCV's own way on the same pictures beside ours.
"""

from __future__ import annotations

import argparse
import csv
import fnmatch
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from deixis_frontend import layout
from deixis_frontend.errors import UserError
from deixis_frontend.evaluation import report_options
from deixis_frontend.number_options import positive_count
from deixis_frontend.programs import program_lines

_PROGRAM = "deixis-evaluate-depth"
_METHODS = ("sgbm_3way", "bm")
_SEQUENCE_FILES = ("left.mp4", "right.mp4", "intrinsics.yml", "extrinsics.yml", "depth/room.png", "mask")
# Rectified pairs with true disparity: left, right, truth, how much of the truth's values is a pixel.
_PAIRS = {
    "aloe": ("aloeL.jpg", "aloeR.jpg", "aloeGT.png", 1),
    "motorcycle": ("motorcycle_left.png", "motorcycle_right.png", "motorcycle_disp_x256.png", 256),
}
_TOTAL = "all"
_HEADING = (f"{'recording':<14}{'by':<8}{'frames':>7}{'valid %':>9}{'median mm':>11}{'p90 mm':>8}"
            f"{'bad>2px %':>11}{'lost %':>8}{'beside %':>10}{'shared %':>10}{'median px':>11}{'ms':>8}")
_LEGEND = """\
valid: share of the pixels with a truth that were measured. bad: of these, wrong by more than 2 px.
lost: of all with a truth, not measured or bad. beside: of the pixels up to 4 px beside a body, with 0.15 m or
more behind it, those that got the body's depth. people: match_size people, nobody saying where they are; said: the
true bodies said. ms: of one core's time. shared: bad of what both ways have measured (pairs only)."""

Row = dict[str, Any]


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Which recordings, which settings, and where the figures go."""
    parser.add_argument("--data", type=Path, required=True, metavar="DIR",
                        help="folder of sequence folders, or of rectified pairs with true disparity")
    parser.add_argument("--only", metavar="GLOB", help="names of recordings to use")
    report_options.add_json(parser)
    report_options.add_plots(parser, "depth and its errors")
    parser.add_argument("--method", choices=_METHODS, help="another way of matching than configured")
    parser.add_argument("--every", type=positive_count, default=1, metavar="N",
                        help="use every N-th frame that has a truth")
    parser.add_argument("--set", dest="settings", action="append", default=[], metavar="KEY=VALUE",
                        help="override a key of stereo_driver.yaml")


def run(arguments: argparse.Namespace) -> int:
    """0; raises UserError when there is nothing to measure."""
    report_options.check(arguments)
    sequences, pairs, skipped = _recordings(arguments.data, arguments.only)
    for left_out in skipped:
        print(f"not used: {left_out['name']} ({left_out['reason']})")
    if not sequences and not pairs:
        raise UserError(f"no sequences or pairs with true depth in {arguments.data}:"
                        " nothing was measured")
    print(_HEADING)
    rows = []
    for row in _measure(_command(arguments, sequences, pairs)):
        _print(row)
        rows.append(row)
    print(_LEGEND)
    report_options.write_json(arguments, _report(rows, skipped))
    return 0


def _recordings(data: Path, only: str | None) -> tuple[list[Path], list[str], list[dict[str, str]]]:
    """Folders of sequences, pairs as the program takes them, and what is left out."""
    if not data.is_dir():
        raise UserError(f"--data {data}: no such folder")
    sequences, skipped = [], []
    for folder in sorted(path for path in data.iterdir() if path.is_dir()):
        if only and not fnmatch.fnmatch(folder.name, only):
            continue
        missing = [name for name in _SEQUENCE_FILES if not (folder / name).exists()]
        if missing:
            skipped.append({"name": folder.name, "reason": f"no {missing[0]}"})
        else:
            sequences.append(folder)
    pairs = [",".join([name, *(str(data / file) for file in files), str(scale)])
             for name, (*files, scale) in _PAIRS.items()
             if (not only or fnmatch.fnmatch(name, only))
             and all((data / file).is_file() for file in files)]
    return sequences, pairs, skipped


def _command(arguments: argparse.Namespace, sequences: list[Path], pairs: list[str]) -> list[str]:
    command = ["--every", str(arguments.every)]
    for folder in sequences:
        command += ["--sequence", str(folder)]
    for pair in pairs:
        command += ["--pair", pair]
    if arguments.plots:
        command += ["--pictures", str(arguments.plots)]
    method = [f"matcher.disparity.method={arguments.method}"] if arguments.method else []
    for setting in [*method, *arguments.settings]:
        command += ["--set", setting]
    return command


def _measure(command: list[str]) -> Iterator[Row]:
    """The program's rows as they come; raises UserError when it fails."""
    for row in csv.DictReader(program_lines(layout.find(), _PROGRAM, *command)):
        yield {key: _value(key, text) for key, text in row.items()}


def _value(key: str, text: str) -> Any:
    if key in ("sequence", "column"):
        return text
    if text == "":
        return None
    return int(text) if key in ("frames", "pixels") else float(text)


def _print(row: Row) -> None:
    def number(key: str, width: int, digits: int, scale: float = 1.0) -> str:
        value = row[key]
        return f"{'-' if value is None else f'{scale * value:.{digits}f}':>{width}}"

    print(f"{row['sequence']:<14}{row['column']:<8}{row['frames']:>7}{number('valid_percent', 9, 2)}"
          f"{number('error_median_m', 11, 1, 1000)}{number('error_p90_m', 8, 1, 1000)}"
          f"{number('bad2px_percent', 11, 2)}{number('lost_percent', 8, 2)}"
          f"{number('fattened_percent', 10, 1)}{number('bad2px_shared_percent', 10, 2)}{number('error_median_px', 11, 3)}"
          f"{number('ms_median', 8, 1)}", flush=True)


def _report(rows: list[Row], skipped: list[dict[str, str]]) -> dict[str, Any]:
    """A row each, and the figures of all sequences together; pairs have their rows only."""
    def figures(column: str) -> Row | None:
        of_all = [row for row in rows if row["column"] == column and row["sequence"] == _TOTAL]
        return {key: value for key, value in of_all[0].items()
                if key not in ("sequence", "column")} if of_all else None

    named = [{"name": row["sequence"], **{k: v for k, v in row.items() if k != "sequence"}}
             for row in rows if row["sequence"] != _TOTAL]
    others = {column: figures(column) for column in ("people", "said", "opencv")}
    return {"sequences": named, "skipped": skipped, "summary": {**(figures("deixis") or {}), **others}}
