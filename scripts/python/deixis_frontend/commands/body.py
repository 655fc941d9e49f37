"""`deixis body`: the human model of one person: sizes, limbs and joint limits; as picture, URDF and mesh."""

from __future__ import annotations

import argparse
import json
from typing import Any

from deixis_frontend import layout, output_files
from deixis_frontend.commands import body_motion
from deixis_frontend.errors import UserError
from deixis_frontend.number_options import above_zero
from deixis_frontend.programs import run_program
from deixis_frontend.text_options import file_path, name
from deixis_frontend.text_table import lines

_STATURES_M = (1.2, 2.3)
_PERCENTILES = (0.1, 99.9)
_FILES = ("png", "urdf", "ply")
_PASSED_ON = ("sex", "stature", "percentile", "model", "joint", "measure", "language", "pose",
              "body_id")


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Who it is, what is told of the body, and the files that are written of it."""
    parser.add_argument("--sex", choices=("female", "male"), help="whose sizes; needed without --motion")
    size = parser.add_mutually_exclusive_group()
    size.add_argument("--stature", type=_stature, metavar="METRES", help="body height")
    size.add_argument("--percentile", type=_percentile, metavar="P",
                      help="instead: P %% of that sex are no taller (default: 50)")
    parser.add_argument("--model", type=name, metavar="NAME", default="whole_body_detailed",
                        help="file of config/body_models, or a path that ends in .yaml (default: %(default)s)")
    parser.add_argument("--joint", type=name, metavar="NAME",
                        help="tell the limits of this joint only; in any language")
    parser.add_argument("--measure", type=name, metavar="NAME", help="tell this measure only; in any language")
    parser.add_argument("--language", choices=("en", "de", "la"),
                        help="of the names (default: en)")
    parser.add_argument("--json", action="store_true", help="print JSON, with more in it")
    parser.add_argument("--pose", choices=("standing", "rest"),
                        help="how the body is drawn and meshed (default: standing)")
    parser.add_argument("--angle", action="append", default=[], metavar="LIMB.ANGLE=DEGREES",
                        help="then one angle of it, as right_lower_arm.flexion=90; again for more")
    parser.add_argument("--png", type=file_path, metavar="FILE",
                        help="draw it, front and side, with the ranges of its joints")
    parser.add_argument("--urdf", type=file_path, metavar="FILE", help="write the model as URDF")
    parser.add_argument("--body-id", type=name, metavar="ID",
                        help="ends all names of the URDF, as in REP 155 (default: default)")
    parser.add_argument("--ply", type=file_path, metavar="FILE", help="write the surface as PLY, metres")
    parser.add_argument("--force", action="store_true", help="replace files that are there")
    body_motion.add_arguments(parser)


def run(arguments: argparse.Namespace) -> int:
    """0; raises UserError when a name is none or a file cannot be written."""
    body_motion.check(arguments)
    if arguments.motion is not None:
        _refuse_beside_motion(arguments)
        return body_motion.run(arguments)
    if arguments.sex is None:
        raise UserError("--sex female or --sex male is needed, or a motion file: --motion FILE")
    files = {f"--{option}": getattr(arguments, option) for option in _FILES
             if getattr(arguments, option) is not None}
    output_files.require_outputs(files, {}, may_replace=arguments.force)
    report = json.loads(run_program(layout.find(), "deixis-body", *_options(arguments)))
    if arguments.json:
        print(json.dumps(report, indent=2, ensure_ascii=False))
        return 0
    print("\n".join(_text(report, with_posture=bool(arguments.angle))))
    for option in _FILES:
        if getattr(arguments, option) is not None:
            print(f"written: {getattr(arguments, option)}")
    return 0


def _refuse_beside_motion(arguments: argparse.Namespace) -> None:
    for option in ("sex", "stature", "percentile", "joint", "measure", *_FILES):
        if getattr(arguments, option) is not None:
            raise UserError(f"--{option} does not go with --motion, whose person has the file's sizes")
    for option in ("language", "pose", "body_id"):
        if getattr(arguments, option) is not None:
            raise UserError(f"--{option.replace('_', '-')} does not go with --motion")
    if arguments.angle:
        raise UserError("--angle does not go with --motion, whose poses are the file's")


def _options(arguments: argparse.Namespace) -> list[str]:
    """The program's command line."""
    options = []
    for option in (*_PASSED_ON, *_FILES):
        value = getattr(arguments, option)
        if value is not None:
            options.append(f"--{option.replace('_', '-')}={value}")
    return options + [f"--angle={text}" for text in arguments.angle]


def _text(report: dict[str, Any], *, with_posture: bool) -> list[str]:
    """The report as people read it: a heading and the tables that are there."""
    text = [f"{report['sex']}, {report['stature_m']:.3f} m, {report['model']}"]
    tables = {"measures": _measures, "limbs": _limbs, "joint_limits": _joint_limits,
              "speed_limits": _speed_limits}
    if with_posture:
        tables["posture"] = _posture
    for part, table in tables.items():
        if part in report:
            text += ["", *table(report[part])]
    return text


def _measures(rows: list[dict[str, Any]]) -> list[str]:
    return lines([("measure", "name", "mm"),
                  *((row["measure"], row["name"], f"{row['mm']:.0f}") for row in rows)], left=2)


def _limbs(limbs: list[dict[str, Any]]) -> list[str]:
    """Millimetres: length, semi-axes of both ends; then the model's angles, degrees."""
    table = lines([("limb", "length mm", "proximal a, b", "distal a, b", "angles of its joint"),
                   *(_limb(limb) for limb in limbs)], left=5)
    return table


def _limb(limb: dict[str, Any]) -> tuple[str, str, str, str, str]:
    ends = [" ".join(f"{1000 * axis:.0f}" for axis in limb[f"{end}_semi_axes_m"])
            for end in ("proximal", "distal")]
    angles = ", ".join(f"{angle['angle']} {angle['min_deg']:g}..{angle['max_deg']:g}"
                       for angle in limb["angles"])
    return limb["limb"], f"{1000 * limb['length_m']:.0f}", ends[0], ends[1], angles


def _joint_limits(rows: list[dict[str, Any]]) -> list[str]:
    table = lines([("joint", "posture", "motion", "degrees", "by default"),
                   *((row["joint_name"], row["posture"], row["motion_name"], _degrees(row),
                      f"{row['default_deg']:g}") for row in rows)], left=3)
    notes = [f"by default {row['default_deg']:g}: {row['joint_name']}, {row['motion_name']}:"
             f" {row['default_why']}" for row in rows if row["default_why"]]
    notes += [f"corrected: {row['joint_name']}, {row['motion_name']}: the source prints"
             f" \"{row['printed']}\": {row['why']}" for row in rows if row["printed"]]
    return table + ([""] if notes else []) + notes


def _speed_limits(speeds: dict[str, Any]) -> list[str]:
    """Degrees per second and per second squared, with what they rest on."""
    if not speeds["joints"]:
        return ["limits of speed: none known"]
    table = lines([("joint", "degrees/s", "degrees/s2"),
                   *((row["joint_name"], f"{row['speed_deg_per_s']:g}", f"{row['acceleration_deg_per_s2']:g}")
                     for row in speeds["joints"])])
    return [*table, "", f"limits of speed: {speeds['derived_from']}. Certainty: {speeds['certainty']}"]


def _posture(joints: list[dict[str, Any]]) -> list[str]:
    """How far each joint is from its limits in the pose."""
    return lines([("in this pose", "nearest limit", "degrees left"),
                  *((joint["joint"], limit["motion_name"], f"{limit['left_deg']:.0f}")
                    for joint in joints for limit in joint["limits"])], left=2)


def _degrees(row: dict[str, Any]) -> str:
    span = f"{row['high_deg']:g}"
    if row["low_deg"] != row["high_deg"]:
        span = f"{row['low_deg']:g}-{span}"
    return f"+-{span}" if row["is_to_both_sides"] else span


def _stature(text: str) -> float:
    value = above_zero(text)
    low, high = _STATURES_M
    if not low <= value <= high:
        hint = f": {value / 100:g}?" if low <= value / 100 <= high else ""
        raise argparse.ArgumentTypeError(f"{text} is beyond {low:g}..{high:g} metres{hint}")
    return value


def _percentile(text: str) -> float:
    value = above_zero(text)
    low, high = _PERCENTILES
    if not low <= value <= high:
        raise argparse.ArgumentTypeError(f"{text} is beyond {low:g}..{high:g}")
    return value
