"""`deixis run-offline`: hosts services in one process, log in, log out, always the same result."""

from __future__ import annotations

import argparse
import signal
import subprocess
import sys
from pathlib import Path

from deixis_frontend import layout as layouts
from deixis_frontend.child_processes import end_with_parent
from deixis_frontend.errors import UserError
from deixis_frontend.interrupts import INTERRUPTED, end_as_by_ctrl_c, held_back
from deixis_frontend.lcm_tools import require_log
from deixis_frontend.output_files import UnfinishedFile


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """The two logs; what else is given goes to deixis-offline as it is."""
    parser.add_argument("input", type=Path, help="log to read")
    parser.add_argument("output", type=Path, help="log to write")
    parser.add_argument("--services", metavar="A,B",
                        help="services to host (default: object_detector,hand_tracker,"
                             "gesture_recogniser; stereo_driver only when it is named)")
    parser.add_argument("--set", action="append", default=[], metavar="SERVICE.KEY=VALUE",
                        help="one key of one service's configuration; repeatable")
    parser.add_argument("--config", action="append", default=[], metavar="SERVICE=FILE",
                        help="another configuration file for a service; repeatable")
    parser.add_argument("--results-only", action="store_true",
                        help="leave the input's messages out of the output")
    parser.add_argument("--force", action="store_true", help="replace an output that is there")


def run(arguments: argparse.Namespace) -> int:
    """Exit code of deixis-offline; the output is written when that is 0, else it is as it was."""
    layout = layouts.find()
    require_log(arguments.input)
    if arguments.output.resolve() == arguments.input.resolve():
        raise UserError(f"input and output are the same file {arguments.input}: name another")
    layout.program("deixis-offline")
    end_as_by_ctrl_c(signal.SIGTERM, signal.SIGHUP)
    with UnfinishedFile(arguments.output, "output", may_replace=arguments.force) as output:
        code = _run([*offline_command(layout, arguments.input, output.path, arguments.set,
                                      arguments.services), *_more_options(arguments)], layout)
        if code == 0:
            output.keep()
        elif code == INTERRUPTED:
            print(f"deixis: interrupted: {arguments.output} was not written", file=sys.stderr)
    return code


def _more_options(arguments: argparse.Namespace) -> list[str]:
    options = [word for assignment in arguments.config for word in ("--config", assignment)]
    return [*options, "--results-only"] if arguments.results_only else options


def _run(command: list[str], layout: layouts.Layout) -> int:
    with held_back() as let_through:
        process = subprocess.Popen(command, env=layout.environment(),
                                   preexec_fn=end_with_parent(signal.SIGTERM))
        try:
            let_through()
            return process.wait()
        except KeyboardInterrupt:
            process.terminate()
            process.wait()
            return INTERRUPTED


def offline_command(layout: layouts.Layout, source: Path, target: Path, settings: list[str],
                    services: str | None = None) -> list[str]:
    """Command line of deixis-offline."""
    command = [str(layout.program("deixis-offline")), str(source), str(target)]
    if services is not None:
        command += ["--services", services]
    for assignment in settings:
        command += ["--set", assignment]
    return command
