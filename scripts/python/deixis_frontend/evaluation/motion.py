"""`deixis evaluate motion`: what the limits of joints say of recorded motion of real people.

Limits that reject what people did are too narrow. Joints that a recording has wrong (anywhere more than 45 degrees
beyond the source's limits, and those beyond them) are counted apart.
"""

from __future__ import annotations

import argparse
import csv
import io
from typing import Any

from deixis_frontend import layout, output_files
from deixis_frontend.evaluation import report_options
from deixis_frontend.number_options import above_zero
from deixis_frontend.programs import run_program
from deixis_frontend.text_options import file_path, name

_TABLES = ("joints", "causes", "recordings", "speeds")
_TEXTS = {"joint", "motion", "recording", "faulty"}


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Which recordings, whose, judged by what, and where the figures go."""
    parser.add_argument("--data", type=file_path, required=True, metavar="DIR",
                        help="folder with .bvh files, or .amc with their .asf")
    parser.add_argument("--actor", type=name, metavar="NAME",
                        help="only recordings of this person: the skeleton's name, as HDM_bd")
    parser.add_argument("--model", type=name, default="whole_body_detailed", metavar="NAME",
                        help="a model of config/body_models (default: whole_body_detailed)")
    parser.add_argument("--limits", choices=("default", "source"), default="default",
                        help="the default limits, or the source's rows as they are")
    parser.add_argument("--allowances-of", type=name, metavar="NAME",
                        help="judge by the source's rows, widened by what this person needs")
    parser.add_argument("--amc-rate", type=above_zero, default=120.0, metavar="HZ",
                        help="frames per second of .amc files (default: 120)")
    parser.add_argument("--write-speeds", type=file_path, metavar="FILE",
                        help="write limits of speed from the recordings of --actor, and stop")
    report_options.add_json(parser)


def run(arguments: argparse.Namespace) -> int:
    """0; raises UserError when there is nothing to measure."""
    report_options.check(arguments)
    options = [f"--recordings={arguments.data}", f"--model={arguments.model}",
               f"--limits={arguments.limits}", f"--amc-rate={arguments.amc_rate}"]
    if arguments.actor:
        options += [f"--actor={arguments.actor}"]
    if arguments.allowances_of:
        options += [f"--allowances-of={arguments.allowances_of}"]
    if arguments.write_speeds is not None:
        output_files.require_outputs({"--write-speeds": arguments.write_speeds}, {}, may_replace=True)
        options += [f"--write-speeds={arguments.write_speeds.absolute()}"]
    text = run_program(layout.find(), "deixis-evaluate-motion", *options)
    if arguments.write_speeds is not None:
        print(f"written: {arguments.write_speeds}")
        return 0
    report = parse(text)
    print_report(report)
    report_options.write_json(arguments, report)
    return 0


def parse(text: str) -> dict[str, Any]:
    """The program's four tables, with their sums."""
    tables = [list(csv.DictReader(io.StringIO(table))) for table in text.split("\n\n")]
    report: dict[str, Any] = {table: [_typed(row) for row in rows]
                              for table, rows in zip(_TABLES, tables, strict=True)}
    faulty = [row for row in report["joints"] if row["joint"] == "faulty"]
    report["joints"] = [row for row in report["joints"] if row["joint"] != "faulty"]
    frames = sum(row["joint_frames"] for row in report["joints"])
    rejected = sum(row["rejected"] for row in report["joints"])
    report["rejected_percent"] = 100.0 * rejected / frames if frames else 0.0
    report["faulty_joint_frames"] = sum(row["joint_frames"] for row in faulty)
    report["faulty_rejected"] = sum(row["rejected"] for row in faulty)
    return report


def _typed(row: dict[str, str]) -> dict[str, Any]:
    return {key: value if key in _TEXTS else float(value) if "." in value else int(value)
            for key, value in row.items()}


def print_report(report: dict[str, Any]) -> None:
    """Joints with their causes, recordings, speeds."""
    print(f"{'joint':<22}{'joint-frames':>13}{'rejected':>10}{'%':>8}  causes: joint-frames, worst excess")
    for row in report["joints"]:
        causes = ", ".join(f"{cause['motion']} {cause['rejected']} ({cause['worst_deg']:.1f} deg)"
                           for cause in report["causes"] if cause["joint"] == row["joint"])
        share = 100.0 * row["rejected"] / row["joint_frames"]
        print(f"{row['joint']:<22}{row['joint_frames']:>13}{row['rejected']:>10}{share:>8.2f}  {causes}")
    print(f"rejected: {report['rejected_percent']:.3f} % of the joint-frames of sound joints;"
          f" in joints that a recording has wrong: {report['faulty_rejected']} of"
          f" {report['faulty_joint_frames']} apart")
    print(f"\n{'recording':<52}{'frames':>8}{'rejected':>10}{'error mm: mean':>16}{'largest':>9}  faulty")
    for row in report["recordings"]:
        print(f"{row['recording']:<52}{row['frames']:>8}{row['rejected']:>10}{row['mean_error_mm']:>16.1f}"
              f"{row['largest_error_mm']:>9.1f}  {row['faulty'].replace(';', ', ')}")
    print(f"\n{'joint':<22}{'samples':>9}{'too fast %':>12}{'too sudden %':>14}{'fastest deg/s':>15}"
          f"{'most sudden deg/s2':>20}")
    for row in report["speeds"]:
        print(f"{row['joint']:<22}{row['samples']:>9}{100 * row['too_fast']:>12.2f}"
              f"{100 * row['too_sudden']:>14.2f}{row['fastest_deg_per_s']:>15}"
              f"{row['most_sudden_deg_per_s2']:>20}")
