"""`deixis evaluate people`: how well people and the floor are found in depth images whose truth is known.

Runs deixis-evaluate-people on the true depth, or on the depth of recordings made from the same sequences.
"""

from __future__ import annotations

import argparse
import fnmatch
import json
from pathlib import Path
from typing import Any

from deixis_frontend import layout
from deixis_frontend.errors import UserError
from deixis_frontend.evaluation import report_options
from deixis_frontend.number_options import positive_count
from deixis_frontend.programs import program_lines

_PROGRAM = "deixis-evaluate-people"
_SEQUENCE_FILES = ("intrinsics.yml", "extrinsics.yml", "camera_world.yml", "frames.csv", "depth/room.png", "mask")
_HEADING = (f"{'recording':<14}{'frames':>7}{'found':>7}{'of':>6}{'recall %':>10}{'precision %':>13}{'unsound %':>11}"
            f"{'false':>7}{'floors':>8}{'tilt deg':>10}{'p95':>7}{'height mm':>11}{'p95':>7}{'ms':>8}")
_LEGEND = """\
found: people half of whose pixels one region holds. recall: share of people's measured pixels in regions.
precision: share of the regions' pixels that are people. unsound: of people's pixels, not trusted as depth.
false: regions that are no person. tilt, height: errors of the floor, median and p95."""


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Which recordings, whose depth, and where the figures go."""
    parser.add_argument("--data", type=Path, required=True, metavar="DIR",
                        help="folder of sequence folders with calibration, true depth and masks of people")
    parser.add_argument("--logs", type=Path, metavar="DIR",
                        help="folder of logs with STEREO, NAME.lcmlog for sequence NAME: their depth, not the true one")
    parser.add_argument("--only", metavar="GLOB", help="names of recordings to use")
    parser.add_argument("--width", type=positive_count, metavar="PX", help="columns of the true depth (default 320)")
    report_options.add_json(parser)
    report_options.add_plots(parser, "depth and the people found")


def run(arguments: argparse.Namespace) -> int:
    """0; raises UserError when there is nothing to measure."""
    report_options.check(arguments)
    sequences, skipped = _sequences(arguments)
    for left_out in skipped:
        print(f"not used: {left_out['name']} ({left_out['reason']})")
    if not sequences:
        raise UserError(f"no sequences with true depth and masks in {arguments.data}: nothing was measured")
    print(_HEADING)
    rows = []
    for line in program_lines(layout.find(), _PROGRAM, *_command(arguments, sequences)):
        rows.append(json.loads(line))
        _print(rows[-1])
    print(_LEGEND)
    report_options.write_json(arguments, {"sequences": rows[:-1], "skipped": skipped, "summary": rows[-1]})
    return 0


def _sequences(arguments: argparse.Namespace) -> tuple[list[Path], list[dict[str, str]]]:
    """Folders of sequences, and what is left out."""
    if not arguments.data.is_dir():
        raise UserError(f"--data {arguments.data}: no such folder")
    sequences, skipped = [], []
    for folder in sorted(path for path in arguments.data.iterdir() if path.is_dir()):
        if arguments.only and not fnmatch.fnmatch(folder.name, arguments.only):
            continue
        needed = [folder / name for name in _SEQUENCE_FILES]
        if arguments.logs:
            needed.append(arguments.logs / f"{folder.name}.lcmlog")
        missing = [path for path in needed if not path.exists()]
        if missing:
            skipped.append({"name": folder.name, "reason": f"no {missing[0].name}"})
        else:
            sequences.append(folder)
    return sequences, skipped


def _command(arguments: argparse.Namespace, sequences: list[Path]) -> list[str]:
    command = [part for folder in sequences for part in ("--sequence", str(folder))]
    if arguments.logs:
        command += ["--logs", str(arguments.logs)]
    if arguments.width:
        command += ["--width", str(arguments.width)]
    if arguments.plots:
        command += ["--pictures", str(arguments.plots)]
    return command


def _print(row: dict[str, Any]) -> None:
    def number(key: str, width: int, digits: int, scale: float = 1.0) -> str:
        value = row[key]
        return f"{'-' if value is None else f'{scale * value:.{digits}f}':>{width}}"

    print(f"{row['name']:<14}{row['frames']:>7}{row['found_people']:>7}{row['people']:>6}"
          f"{number('recall_percent', 10, 2)}{number('precision_percent', 13, 2)}{number('unsound_percent', 11, 2)}"
          f"{row['false_regions']:>7}{row['floors']:>8}{number('tilt_median_deg', 10, 2)}{number('tilt_p95_deg', 7, 2)}"
          f"{number('height_median_m', 11, 1, 1000)}{number('height_p95_m', 7, 1, 1000)}{number('ms_median', 8, 3)}",
          flush=True)
