"""`deixis procman`: writes the services of the system file as a procman sheriff reads them."""

from __future__ import annotations

import argparse
import socket
import sys
from pathlib import Path

from deixis_frontend import layout as layouts
from deixis_frontend import lcm_url
from deixis_frontend.commands.system_option import add_system
from deixis_frontend.deployment import procman_file
from deixis_frontend.deployment.procman_file import SHERIFFS, Choices
from deixis_frontend.number_options import count
from deixis_frontend.output_files import UnfinishedFile, write_text
from deixis_frontend.supervision import system_file

_WAIT_MS = 2000


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Where to, and for which sheriff."""
    parser.add_argument("-o", "--output", type=Path, metavar="FILE", required=True,
                        help="configuration file of the sheriff (.pmd) to write")
    parser.add_argument("--deputy", metavar="NAME", default=socket.gethostname(),
                        help="deputy that runs the services (default: this host's name)")
    parser.add_argument("--sheriff", choices=list(SHERIFFS), default="libbot2",
                        help="who reads the file: bot-procman-sheriff (default: libbot2), one"
                             " without stop_signal (libbot2-early), procman-sheriff with `deputy`"
                             " in the place of `host` (procman)")
    parser.add_argument("--wait-ms", type=count, metavar="N", default=_WAIT_MS,
                        help="milliseconds from the start of a service till those come that wait"
                             f" for it (default: {_WAIT_MS})")
    parser.add_argument("--force", action="store_true", help="replace a file that is there")
    add_system(parser)


def run(arguments: argparse.Namespace) -> int:
    """0 when the file was written."""
    layout = layouts.find()
    system = system_file.load((arguments.system or layout.find_config("system.yaml")).absolute())
    choices = Choices(SHERIFFS[arguments.sheriff], arguments.deputy, arguments.wait_ms)
    text = procman_file.render(system, layout, lcm_url.choose(arguments.lcm_url), choices)
    with UnfinishedFile(arguments.output, "--output", may_replace=arguments.force) as file:
        write_text(file.path, text, "--output")
        file.keep()
    for name in procman_file.restarted_always(system):
        print(f"deixis: {name}: procman knows no 'restart: on_failure': it starts it again after"
              " exit code 0, too", file=sys.stderr)
    print(f"wrote {len(system.services)} commands to {arguments.output}: load it with the sheriff,"
          " then run its script `start`")
    return 0
