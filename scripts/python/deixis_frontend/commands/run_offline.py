"""`deixis run-offline`: hosts services in one process, log in, log out, always the same result."""

from __future__ import annotations

import argparse
import os
import sys
from pathlib import Path

from deixis_frontend import layout as layouts
from deixis_frontend.lcm_tools import require_log


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """The two logs; what else is given goes to deixis-offline as it is."""
    parser.add_argument("input", type=Path, help="log to read")
    parser.add_argument("output", type=Path, help="log to write")
    parser.add_argument("--services", metavar="A,B", help="services to host (default: all)")
    parser.add_argument("--set", action="append", default=[], metavar="SERVICE.KEY=VALUE",
                        help="one key of one service's configuration; repeatable")
    parser.add_argument("--config", action="append", default=[], metavar="SERVICE=FILE",
                        help="another configuration file for a service; repeatable")
    parser.add_argument("--results-only", action="store_true",
                        help="leave the input's messages out of the output")


def run(arguments: argparse.Namespace) -> int:
    """Exit code of deixis-offline, which takes the place of this process."""
    layout = layouts.find()
    require_log(arguments.input)
    command = offline_command(layout, arguments.input, arguments.output, arguments.set,
                              arguments.services)
    for assignment in arguments.config:
        command += ["--config", assignment]
    if arguments.results_only:
        command.append("--results-only")
    sys.stdout.flush()
    os.environ.setdefault("DEIXIS_CONFIG_DIR", str(layout.config))
    os.execv(command[0], command)


def offline_command(layout: layouts.Layout, source: Path, target: Path, settings: list[str],
                    services: str | None = None) -> list[str]:
    """Command line of deixis-offline."""
    command = [str(layout.program("deixis-offline")), str(source), str(target)]
    if services:
        command += ["--services", services]
    for assignment in settings:
        command += ["--set", assignment]
    return command
