"""`deixis train-body`: joints and surfaces of clothed people from rendered sequences with truth."""

from __future__ import annotations

import argparse
import csv
import fnmatch
import tempfile
from collections.abc import Iterator
from pathlib import Path

from deixis_frontend import layout, output_files
from deixis_frontend.errors import UserError
from deixis_frontend.programs import run_program

_SEQUENCE_FILES = ("person.csv", "joints.csv", "intrinsics.yml", "camera_world.yml", "depth", "mask")
_PERSON_HEADING = (f"{'person':<10}{'frames':>7}{'joints mm':>11}{'hand-made mm':>14}{'own mm':>8}"
                   f"{'of others mm':>14}")
_CALIBRATION_HEADING = f"{'person':<10}{'lengths':<12}{'limbs mm':>9}{'surface mm':>12}"
_LEGEND = """\
joints: mean distance of true joints from the model's. Surfaces, root mean square: with the shapes of
whole_body_detailed, with the person's own, with those learned without the person. Below: lengths of
arms, legs and clavicles of somebody whom the body was not learned from, by the stature and calibrated."""


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """What to learn from, and where the body goes."""
    parser.add_argument("--data", type=Path, required=True, metavar="DIR",
                        help="folder of rendered sequences with true joints, depth and masks")
    parser.add_argument("--only", metavar="GLOB", help="names of sequences to use")
    parser.add_argument("--leave-out", metavar="PERSON", help="leave this person's sequences out")
    parser.add_argument("--output", type=Path, required=True, metavar="FILE",
                        help="body to write, as config/body_models/clothed_body.yaml")
    parser.add_argument("--csv", type=Path, metavar="FILE",
                        help="all figures: each length's measure, share, spread and errors, and all below")


def run(arguments: argparse.Namespace) -> int:
    """0 when the body is written."""
    outputs = {"--output": arguments.output}
    if arguments.csv:
        outputs["--csv"] = arguments.csv
    output_files.require_outputs(outputs, {}, may_replace=True)
    folders = _folders(arguments.data, arguments.only, arguments.leave_out)
    with tempfile.TemporaryDirectory() as folder:
        written = Path(folder) / "body.yaml"
        options = [*map(str, folders), "--output", str(written)]
        if arguments.leave_out:
            options += ["--leave-out", arguments.leave_out]
        figures = run_program(layout.find(), "deixis-train-body", *options)
        output_files.write_text(arguments.output, written.read_text("utf-8"), "--output")
    if arguments.csv:
        output_files.write_text(arguments.csv, figures, "--csv")
    print("\n".join(_summary(figures)))
    print("written: " + " and ".join(map(str, outputs.values())))
    return 0


def _folders(data: Path, only: str | None, left_out: str | None) -> list[Path]:
    """Sequences that can be used; says which cannot, and why."""
    if not data.is_dir():
        raise UserError(f"--data {data}: no such folder")
    folders, people = [], set()
    for folder in sorted(path for path in data.iterdir() if path.is_dir()):
        if only and not fnmatch.fnmatch(folder.name, only):
            continue
        missing = [name for name in _SEQUENCE_FILES if not (folder / name).exists()]
        if missing:
            print(f"not used: {folder.name} (no {missing[0]})")
            continue
        folders.append(folder)
        people.add(_person(folder))
    if left_out and left_out not in people:
        raise UserError(f"--leave-out {left_out}: nobody of that name is there:"
                        f" there are {', '.join(sorted(people)) or 'none'}")
    if len(people - {left_out}) < 2:
        raise UserError(f"fewer than two people in {data}: how they differ is part of what is learned")
    return folders


def _person(folder: Path) -> str:
    with (folder / "person.csv").open(encoding="utf-8", newline="") as file:
        return dict(row[:2] for row in csv.reader(file) if len(row) > 1).get("id", "")


def _summary(figures: str) -> Iterator[str]:
    """The tables of people; with two people there are none."""
    rows = list(csv.reader(figures.splitlines()))
    for heading, first, text in (("person", _PERSON_HEADING, _person_line),
                                 ("calibrated_person", _CALIBRATION_HEADING, _calibration_line)):
        begin = next((i for i, row in enumerate(rows) if row[0] == heading), None)
        if begin is None:
            continue
        yield first
        for row in rows[begin + 1:]:
            if row[0] == "calibrated_person":
                break
            yield text(dict(zip(rows[begin], row, strict=False)))
        yield ""
    if any(row[0] == "person" for row in rows):
        yield _LEGEND


def _person_line(row: dict[str, str]) -> str:
    return (f"{row['person']:<10}{row['frames']:>7}{row['joint_error_mm']:>11}{row['hand_made_rms_mm']:>14}"
            f"{row['own_rms_mm']:>8}{row['others_rms_mm']:>14}")


def _calibration_line(row: dict[str, str]) -> str:
    errors = [abs(float(value)) for key, value in row.items() if key.endswith("_error_mm")]
    mean = sum(errors) / len(errors)
    return f"{row['calibrated_person']:<10}{row['lengths']:<12}{mean:>9.1f}{row['surface_rms_mm']:>12}"
