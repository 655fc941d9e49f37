"""`deixis restart`: stops services and starts them again, with the files as they are now."""

from __future__ import annotations

import argparse

from deixis_frontend import lcm_url
from deixis_frontend.commands import start
from deixis_frontend.commands.system_option import (
    add_names, add_system, open_system, print_service)


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Names and the system file."""
    add_names(parser, "what to restart (default: all that run, with the system file read anew)")
    add_system(parser)


def run(arguments: argparse.Namespace) -> int:
    """0 when all have got ready again."""
    system, client = open_system(arguments)
    system.resolve(arguments.names)
    if not client.is_supervised():
        return start.run(arguments)
    if arguments.names:
        return 0 if client.command("restart", arguments.names, print_service)["ok"] else 1
    url = client.command("status", [])["status"]["lcm_url"]
    running = client.command("stop", [])["stopped"]
    client.wait_until_gone()
    arguments.names = [name for name in running if name in system.services]
    arguments.lcm_url = str(lcm_url.parse(arguments.lcm_url or url))
    return start.run(arguments)
