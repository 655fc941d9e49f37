"""`deixis evaluate calibration`: a stereo calibration against OpenCV's sample, on the same pictures.

Each procedure is measured on the pairs that it was fitted to, and on pairs that it was not: fitted to the
even ones, measured on the odd ones, and the other way round.
"""

from __future__ import annotations

import argparse
import csv
import io
import re
import tempfile
from pathlib import Path
from typing import Any

from deixis_frontend import layout, output_files
from deixis_frontend.errors import UserError
from deixis_frontend.evaluation import report_options
from deixis_frontend.number_options import above_zero
from deixis_frontend.programs import run_program

_HEADING = (f"{'procedure':<24}{'left px':>9}{'right px':>10}{'stereo px':>11}{'baseline m':>12}"
            f"{'epipolar px':>13}{'rows px mean/median/p95':>26}{'on pairs held out':>22}"
            f"{'the same, sample corners':>26}")
_Rows = dict[str, dict[tuple[str, str], tuple[float, float, float]]]


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Which pictures, which board, and where the figures go."""
    parser.add_argument("--data", type=Path, required=True, metavar="DIR",
                        help="folder with pictures of a chessboard from two cameras")
    parser.add_argument("--left", default="left[0-9]*.jpg", metavar="GLOB",
                        help="names of the left camera's pictures (default: left[0-9]*.jpg)")
    parser.add_argument("--right", default="right[0-9]*.jpg", metavar="GLOB",
                        help="names of the right camera's (default: right[0-9]*.jpg)")
    parser.add_argument("--board", type=_board, default=(9, 6), metavar="CxR",
                        help="inner corners, per row x rows (default: 9x6)")
    parser.add_argument("--square", type=above_zero, default=0.025, metavar="M",
                        help="side of a square, metres (default: 0.025)")
    report_options.add_json(parser)
    parser.add_argument("--save", type=Path, metavar="DIR",
                        help="write the pictures that show how the calibration came about")


def run(arguments: argparse.Namespace) -> int:
    """0; raises UserError when there is nothing to measure."""
    report_options.check(arguments)
    if arguments.save is not None:
        output_files.require_folder(arguments.save, "--save")
    where = layout.find()
    _require_pictures(arguments)
    text = run_program(where, "deixis-evaluate-calibration", *_pictures(arguments), "--board",
                       *map(str, arguments.board), "--square", str(arguments.square))
    pairs, rows = parse(text)
    print(f"{pairs} pairs")
    print(_HEADING)
    report = [_figures(name, parts) for name, parts in rows.items()]
    for figures in report:
        print(_line(figures))
    if arguments.save is not None:
        _save_pictures(where, arguments)
    report_options.write_json(arguments, {"pairs": pairs, "procedures": report})
    return 0


def parse(text: str) -> tuple[int, _Rows]:
    """The number of pairs, and of each procedure what was measured: (part, what) to three figures."""
    pairs, rows = 0, dict[str, dict[tuple[str, str], tuple[float, float, float]]]()
    for row in csv.DictReader(io.StringIO(text)):
        if row["what"] == "pairs":
            pairs = int(row["a"])
            continue
        values = (float(row["a"]), float(row["b"]), float(row["c"]))
        rows.setdefault(row["procedure"], {})[row["part"], row["what"]] = values
    return pairs, rows


def _board(text: str) -> tuple[int, int]:
    match = re.fullmatch(r"(\d{1,3})x(\d{1,3})", text)
    if match is None:
        raise argparse.ArgumentTypeError(f"'{text}' is not of the form 9x6")
    return int(match[1]), int(match[2])


def _require_pictures(arguments: argparse.Namespace) -> None:
    if not arguments.data.is_dir():
        raise UserError(f"--data {arguments.data}: no such folder: name one with pictures")
    for option in ("left", "right"):
        pattern = getattr(arguments, option)
        if not any(arguments.data.glob(pattern)):
            raise UserError(f"no {pattern} in {arguments.data}: name the pictures with --{option}")


def _pictures(arguments: argparse.Namespace) -> list[str]:
    return ["--left", str(arguments.data / arguments.left),
            "--right", str(arguments.data / arguments.right)]


def _save_pictures(where: layout.Layout, arguments: argparse.Namespace) -> None:
    columns, rows = arguments.board
    with tempfile.TemporaryDirectory() as folder:  # Of the calibration, which nobody has asked for.
        run_program(where, "deixis-calibrator", "stereo", *_pictures(arguments), "--board",
                    f"{columns}x{rows}", "--square", str(arguments.square), "--accept-poor",
                    "--save", str(arguments.save), "--output", folder)
    print(f"pictures: {arguments.save}")


def _figures(name: str, parts: dict[tuple[str, str], tuple[float, float, float]]) -> dict[str, Any]:
    left, right, stereo = parts["all", "fit"]
    baseline, epipolar, focal = parts["all", "place"]
    figures: dict[str, Any] = {
        "procedure": name, "left_px": left, "right_px": right, "stereo_px": stereo,
        "baseline_m": baseline, "epipolar_px": epipolar, "focal_px": focal}
    for part, key in (("fitted", "rows"), ("held out", "held_out_rows"),
                      ("held out at the sample's corners", "held_out_rows_sample_corners")):
        mean, median, p95 = parts[part, "rows"]
        figures[key] = {"mean_px": mean, "median_px": median, "p95_px": p95}
    return figures


def _line(figures: dict[str, Any]) -> str:
    def three(key: str, width: int) -> str:
        rows = figures[key]
        text = f"{rows['mean_px']:.3f}/{rows['median_px']:.3f}/{rows['p95_px']:.3f}"
        return f"{text:>{width}}"

    return (f"{figures['procedure']:<24}{figures['left_px']:>9.3f}{figures['right_px']:>10.3f}"
            f"{figures['stereo_px']:>11.3f}{figures['baseline_m']:>12.4f}"
            f"{figures['epipolar_px']:>13.3f}{three('rows', 26)}{three('held_out_rows', 22)}"
            f"{three('held_out_rows_sample_corners', 26)}")
