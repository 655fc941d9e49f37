"""Runs the built programs to their end."""

from __future__ import annotations

import signal
import subprocess

from deixis_frontend.child_processes import end_with_parent
from deixis_frontend.errors import UserError
from deixis_frontend.layout import Layout

_HINT = "Run with --help"  # stands below what was wrong with a command line


def run_program(layout: Layout, name: str, *arguments: str) -> str:
    """What the program wrote to stdout; raises UserError with its last line when it fails."""
    done = subprocess.run([str(layout.program(name)), *arguments], env=layout.environment(),
                          capture_output=True, text=True, errors="replace", check=False,
                          preexec_fn=end_with_parent(signal.SIGTERM))
    if done.returncode != 0:
        reason = last_words(done.stderr) or f"exit code {done.returncode}"
        raise UserError(f"{name} failed: {reason}")
    return done.stdout


def last_words(said: str) -> str:
    """The last line that tells something, of what a program wrote to stderr."""
    lines = [line.strip() for line in said.splitlines()]
    return next((line for line in reversed(lines) if line and not line.startswith(_HINT)), "")
