"""What the commands that deal with the supervisor have in common."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

from deixis_frontend import layout as layouts
from deixis_frontend.supervision import system_file
from deixis_frontend.supervision.control_client import Client
from deixis_frontend.supervision.system_file import System

GOOD = ("running", "degraded", "finished")


def add_system(parser: argparse.ArgumentParser) -> None:
    """The option that names the system file."""
    parser.add_argument("--system", type=Path, metavar="FILE",
                        help="system file (default: config/system.yaml)")


def add_names(parser: argparse.ArgumentParser, meaning: str) -> None:
    """Groups and services to deal with."""
    parser.add_argument("names", nargs="*", metavar="group|service", help=meaning)


def open_system(arguments: argparse.Namespace) -> tuple[System, Client]:
    """The system that the arguments name, and how to talk to its supervisor."""
    layout = layouts.find()
    system = system_file.load(arguments.system or layout.find_config("system.yaml"))
    return system, Client(system, layout)


def has_ended(client: Client) -> bool:
    """Waits for the supervisor to end; says so when it does not."""
    if client.wait_until_gone():
        return True
    print(f"deixis: the supervisor has not ended: see {client.log_file}", file=sys.stderr)
    return False


def service_printer(system: System) -> Callable[[dict[str, Any]], None]:
    """Prints a line on each service of the system that has got ready, failed or stopped."""
    width = max(map(len, system.services), default=0)

    def print_service(facts: dict[str, Any]) -> None:
        pid = f"pid {facts['pid']}" if facts["pid"] else ""
        # Of one that was stopped, what it said before is over.
        words = "" if facts["state"] == "stopped" else facts["last_error"] or facts.get("text", "")
        print(f"{facts['name']:<{width}} {facts['state']:<10} {pid:<12} {words}".rstrip(),
              flush=True)

    return print_service
