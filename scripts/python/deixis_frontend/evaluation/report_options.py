"""Where the figures of an evaluation go: looked at before the long run, written after it."""

from __future__ import annotations

import argparse
import importlib.util
import json
from pathlib import Path
from typing import Any

from deixis_frontend import output_files
from deixis_frontend.errors import UserError


def add_json(parser: argparse.ArgumentParser, what: str = "figures") -> None:
    """The option --json."""
    parser.add_argument("--json", type=Path, metavar="FILE", help=f"write the {what} as JSON")


def add_plots(parser: argparse.ArgumentParser, of: str = "figures") -> None:
    """The option --plots."""
    parser.add_argument("--plots", type=Path, metavar="DIR", help=f"write pictures of the {of}")


def check(arguments: argparse.Namespace) -> None:
    """Raises UserError when what --json and --plots name cannot be written."""
    if arguments.json is not None:
        output_files.require_file(arguments.json, "--json")
    if getattr(arguments, "plots", None) is not None:
        if importlib.util.find_spec("matplotlib") is None:
            raise UserError("--plots needs the Python module 'matplotlib': pip install matplotlib")
        output_files.require_folder(arguments.plots, "--plots")


def write_json(arguments: argparse.Namespace, report: dict[str, Any]) -> None:
    """Writes the report where --json says, if it says."""
    if arguments.json is not None:
        output_files.write_text(arguments.json, json.dumps(report, indent=2) + "\n", "--json")
