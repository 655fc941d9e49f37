"""Runs the commands that cure what was found, each only when it is wanted."""

from __future__ import annotations

import os
import shutil
import subprocess
import sys

from deixis_frontend.doctor.findings import Command, Finding
from deixis_frontend.questions import is_wanted


def fix(findings: list[Finding], *, is_agreed: bool) -> bool:
    """Runs the cures of all findings that have some; true when one was run."""
    commands = [command for finding in findings for command in finding.fixes]
    return any([_run(_as_root(command)) for command in commands
                if is_agreed or is_wanted(f"run `{' '.join(_as_root(command))}`?")])


def _as_root(command: Command) -> Command:
    return command if os.geteuid() == 0 or not shutil.which("sudo") else ("sudo", *command)


def _run(command: Command) -> bool:
    print(f"+ {' '.join(command)}", file=sys.stderr, flush=True)
    try:
        code = subprocess.run(command, check=False, stdout=sys.stderr).returncode
    except OSError as error:
        print(f"deixis: {command[0]}: {error.strerror}: run it by hand as root", file=sys.stderr)
        return False
    if code:
        print(f"deixis: `{' '.join(command)}` failed: run it by hand as root", file=sys.stderr)
    return code == 0
