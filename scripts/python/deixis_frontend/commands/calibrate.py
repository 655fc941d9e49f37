"""`deixis calibrate WHAT`: hands over to deixis-calibrator, which has all the options."""

from __future__ import annotations

import argparse
import os
import sys

from deixis_frontend import layout as layouts

_WHAT = ("camera", "stereo", "board")


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """What to calibrate; the rest is deixis-calibrator's."""
    parser.usage = "deixis calibrate [-h] {camera,stereo,board} ..."
    parser.epilog = "`deixis calibrate camera --help` lists the options; the same for the others."
    parser.add_argument("what", choices=_WHAT, metavar="{" + ",".join(_WHAT) + "}",
                        help="one camera, two cameras side by side, or a board to print")
    rest = parser.add_argument("options", nargs=argparse.REMAINDER, help=argparse.SUPPRESS)
    rest.required = False  # argparse would name it among what is missing.


def run(arguments: argparse.Namespace) -> int:
    """Becomes the program, so that signals reach it: Ctrl-C ends the collecting, not the work."""
    layout = layouts.find()
    program = str(layout.program("deixis-calibrator"))
    options = list(arguments.options)
    if arguments.lcm_url is not None and arguments.what != "board":
        options += ["--lcm-url", arguments.lcm_url]
    sys.stdout.flush()
    # Its --help calls itself by the name that it is given.
    os.execve(program, ["deixis calibrate", arguments.what, *options], layout.environment())
