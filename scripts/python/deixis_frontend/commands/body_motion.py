"""`deixis body --motion`: a motion file as poses of a body model, and those as BVH."""

from __future__ import annotations

import argparse
import json
from pathlib import Path
from typing import Any

from deixis_frontend import layout, output_files
from deixis_frontend.errors import UserError
from deixis_frontend.number_options import above_zero
from deixis_frontend.programs import run_program
from deixis_frontend.text_options import file_path
from deixis_frontend.text_table import lines

# Options that say how one kind of file is read, and the other kind.
_MEANT_FOR = {"asf": (".amc", ".bvh"), "amc_rate": (".amc", ".bvh"), "unit": (".bvh", ".amc")}
_ONLY_WITH_MOTION = ("asf", "amc_rate", "unit", "bvh")


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Which motion, how it is to be read, and where its poses go."""
    group = parser.add_argument_group("recorded motion")
    group.add_argument("--motion", type=file_path, metavar="FILE",
                       help="read a .bvh file, or .amc with its .asf, into poses of the model; the person has the sizes of the file")
    group.add_argument("--asf", type=file_path, metavar="FILE",
                       help="skeleton of an .amc file (default: the one beside it whose name its own begins with)")
    group.add_argument("--amc-rate", type=above_zero, metavar="HZ",
                       help="frames per second of an .amc file (default: 120)")
    group.add_argument("--unit", type=above_zero, metavar="METRES",
                       help="metres per unit of a .bvh file (default: 0.01)")
    group.add_argument("--bvh", type=file_path, metavar="FILE", help="write the poses as BVH, centimetres")


def check(arguments: argparse.Namespace) -> None:
    """Raises UserError for options that need --motion, or another kind of it."""
    for option in _ONLY_WITH_MOTION:
        if getattr(arguments, option) is not None and arguments.motion is None:
            raise UserError(f"--{option.replace('_', '-')} needs --motion FILE")
    for option, (kind, other) in _MEANT_FOR.items():
        if getattr(arguments, option) is not None and arguments.motion.suffix.lower() == other:
            raise UserError(f"--{option.replace('_', '-')} is for {kind} files: {arguments.motion} is none")


def run(arguments: argparse.Namespace) -> int:
    """0; raises UserError when the motion cannot be read or a file cannot be written."""
    if arguments.bvh is not None:
        inputs = {"--motion": arguments.motion, "--asf": arguments.asf}
        output_files.require_outputs({"--bvh": arguments.bvh},
                                     {name: path for name, path in inputs.items() if path is not None},
                                     may_replace=arguments.force)
    options = [f"--motion={arguments.motion}", f"--model={arguments.model}"]
    for option in _ONLY_WITH_MOTION:
        value = getattr(arguments, option)
        if value is not None:
            options.append(f"--{option.replace('_', '-')}={value}")
    report = json.loads(run_program(layout.find(), "deixis-retarget", *options))
    if arguments.json:
        print(json.dumps(report, indent=2, ensure_ascii=False))
        return 0
    print("\n".join(_text(arguments.motion, report)))
    if arguments.bvh is not None:
        print(f"written: {arguments.bvh}")
    return 0


def _text(motion: Path, report: dict[str, Any]) -> list[str]:
    """The motion, its limbs with how far they are from the file's joints, and limits exceeded."""
    seconds = report["frames"] / report["frame_rate_hz"]
    text = [f"{motion}: {report['frames']} frames, {seconds:.2f} s; {report['model']}", ""]
    text += lines([("limb", "length mm", "mean error mm", "largest"),
                   *((limb["limb"], f"{1000 * limb['length_m']:.0f}", f"{1000 * limb['mean_error_m']:.1f}",
                      f"{1000 * limb['largest_error_m']:.1f}") for limb in report["limbs"])])
    if report["at_rest"]:
        text += ["", "not in the motion, left standing: " + ", ".join(report["at_rest"])]
    if not report["beyond_limits"]:
        return text + ["", "within the default limits of all joints"]
    return text + ["", *lines([("beyond the default limits", "motion", "frames", "at most degrees"),
                               *((row["joint"], row["motion"], str(row["frames"]), f"{row['worst_deg']:.1f}")
                                 for row in report["beyond_limits"])], left=2)]
