"""`deixis stop`: stops services; without names all of them and their supervisor."""

from __future__ import annotations

import argparse

from deixis_frontend.commands.system_option import (
    add_names, add_system, has_ended, open_system, service_printer)


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Names and the system file."""
    add_names(parser, "what to stop (default: everything)")
    add_system(parser)


def run(arguments: argparse.Namespace) -> int:
    """0 when they are stopped, were they running or not."""
    system, client = open_system(arguments)
    system.resolve(arguments.names)
    if not client.is_supervised():
        print("nothing is running")
        return 0
    client.command("stop", arguments.names, service_printer(system))
    return 0 if arguments.names or has_ended(client) else 1
