"""`deixis start`: starts services and waits until they are ready."""

from __future__ import annotations

import argparse
import sys
from dataclasses import replace

from deixis_frontend import layout as layouts
from deixis_frontend import lcm_url, standard_output
from deixis_frontend.commands.system_option import (
    add_names, add_system, open_system, service_printer)
from deixis_frontend.supervision import daemon
from deixis_frontend.supervision.control_client import Client
from deixis_frontend.supervision.foreground import Foreground
from deixis_frontend.supervision.system_file import System


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Names and the system file."""
    add_names(parser, "what to start (default: 'start' of the system file)")
    parser.add_argument("--foreground", action="store_true",
                        help="stay in the foreground, show what the services write, end when one is"
                             " given up; for systemd (sd_notify) and containers")
    add_system(parser)


def run(arguments: argparse.Namespace) -> int:
    """0 when all have got ready; in the foreground when all was stopped by somebody."""
    system, client = open_system(arguments)
    system.resolve(arguments.names)  # A wrong name must not start a supervisor.
    if arguments.foreground:
        return _stay(system, arguments)
    return leave_behind(system, client, arguments)


def leave_behind(system: System, client: Client, arguments: argparse.Namespace) -> int:
    """Starts services below a supervisor that stays in the background; 0 when all got ready."""
    client.ensure_supervisor(lcm_url.choose(arguments.lcm_url),
                             url_is_wanted=bool(arguments.lcm_url))
    answer = client.command("start", arguments.names, service_printer(system))
    if not answer["ok"]:
        print(f"deixis: not all services are ready: `deixis log` shows what they wrote"
              f" ({client.log_file.parent})", file=sys.stderr)
    return 0 if answer["ok"] else 1


def _stay(system: System, arguments: argparse.Namespace) -> int:
    layout = layouts.find()
    url = lcm_url.choose(arguments.lcm_url)
    lcm_url.require_bus(url)
    layout.use_types()
    foreground = Foreground(arguments.names, service_printer(system))
    daemon.supervise(replace(system, path=system.path.resolve()), layout, url,
                     foreground=foreground)
    try:
        sys.stdout.flush()
    except OSError:
        standard_output.discard()  # That nobody read it was no reason to end, and is no failure.
    return foreground.exit_code
