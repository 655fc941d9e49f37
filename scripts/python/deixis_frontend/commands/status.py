"""`deixis status`: a table, or JSON, of how the services are doing."""

from __future__ import annotations

import argparse
import json
from typing import Any

from deixis_frontend.commands.system_option import GOOD, add_system, open_system
from deixis_frontend.status_table import render

NOT_RUNNING = 3


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Form of the output and the system file."""
    parser.add_argument("--json", action="store_true", help="everything that is known, as JSON")
    add_system(parser)


def run(arguments: argparse.Namespace) -> int:
    """0 all well, 1 something is not as it should be, 3 nothing runs."""
    system, client = open_system(arguments)
    if not client.is_supervised():
        nothing = {"system": system.name, "supervisor_pid": None, "services": []}
        print(json.dumps(nothing) if arguments.json else "nothing is running")
        return NOT_RUNNING
    status = client.command("status", [])["status"]
    print(json.dumps(status, indent=2) if arguments.json else render(status, system.path.resolve()))
    return 0 if _is_well(status) else 1


def _is_well(status: dict[str, Any]) -> bool:
    return all(service["state"] in (*GOOD, "stopped") for service in status["services"])
