"""`deixis start`: starts services and waits until they are ready."""

from __future__ import annotations

import argparse
import sys

from deixis_frontend import lcm_url
from deixis_frontend.commands.system_option import (
    add_names, add_system, open_system, print_service)


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Names and the system file."""
    add_names(parser, "what to start (default: 'start' of the system file)")
    add_system(parser)


def run(arguments: argparse.Namespace) -> int:
    """0 when all have got ready."""
    system, client = open_system(arguments)
    system.resolve(arguments.names)  # A wrong name must not start a supervisor.
    client.ensure_supervisor(lcm_url.choose(arguments.lcm_url),
                             url_is_wanted=bool(arguments.lcm_url))
    answer = client.command("start", arguments.names, print_service)
    if not answer["ok"]:
        print(f"deixis: not all services are ready: `deixis log` shows what they wrote"
              f" ({client.log_file.parent})", file=sys.stderr)
    return 0 if answer["ok"] else 1
