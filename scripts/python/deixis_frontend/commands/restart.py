"""`deixis restart`: stops services and starts them again, with the files as they are now."""

from __future__ import annotations

import argparse

from deixis_frontend import lcm_url
from deixis_frontend.commands import start
from deixis_frontend.commands.system_option import (
    add_names, add_system, has_ended, open_system, service_printer)
from deixis_frontend.errors import UserError
from deixis_frontend.supervision.control_client import Client
from deixis_frontend.supervision.system_file import System


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Names and the system file."""
    add_names(parser, "what to restart (default: all that run, with the system file read anew)")
    add_system(parser)


def run(arguments: argparse.Namespace) -> int:
    """0 when all that the system file still has have got ready again."""
    system, client = open_system(arguments)
    system.resolve(arguments.names)
    if not client.is_supervised():
        return start.leave_behind(system, client, arguments)
    if arguments.names:
        return 0 if client.command("restart", arguments.names, service_printer(system))["ok"] else 1
    return _restart_all(arguments, system, client)


def _restart_all(arguments: argparse.Namespace, system: System, client: Client) -> int:
    """With a new supervisor, which reads the system file anew."""
    status = client.own_status()
    if status.get("is_in_foreground"):
        raise UserError(f"the supervisor (pid {status['supervisor_pid']}) is in the foreground:"
                        " restart it where it was started (`systemctl restart deixis`), or name the"
                        " services to restart")
    url = status["lcm_url"]
    running = client.command("stop", [])["stopped"]
    if not has_ended(client):
        return 1
    arguments.names = _still_there(running, system)
    if running and not arguments.names:
        return 0  # Without names, `start` would take what the file starts by default.
    arguments.lcm_url = str(lcm_url.parse(arguments.lcm_url or url))
    return start.leave_behind(system, client, arguments)


def _still_there(running: list[str], system: System) -> list[str]:
    for name in running:
        if name not in system.services:
            print(f"{name} is stopped: it is not in {system.path} any more")
    return [name for name in running if name in system.services]
