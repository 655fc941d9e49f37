"""Runs the built programs to their end."""

from __future__ import annotations

import signal
import subprocess
import tempfile
from collections.abc import Iterator

from deixis_frontend.child_processes import end_with_parent
from deixis_frontend.errors import UserError
from deixis_frontend.layout import Layout

_HINT = "Run with --help"  # stands below what was wrong with a command line


def run_program(layout: Layout, name: str, *arguments: str) -> str:
    """What the program wrote to stdout; raises UserError with its last line when it fails."""
    return "".join(program_lines(layout, name, *arguments))


def program_lines(layout: Layout, name: str, *arguments: str) -> Iterator[str]:
    """The same line by line, as they come; the program is ended when they are not read to the end."""
    with tempfile.TemporaryFile("w+", errors="replace") as said:  # Whatever its length: not a pipe.
        with subprocess.Popen([str(layout.program(name)), *arguments], env=layout.environment(),
                              stdout=subprocess.PIPE, stderr=said, text=True, errors="replace",
                              preexec_fn=end_with_parent(signal.SIGTERM)) as program:
            assert program.stdout is not None
            try:
                yield from program.stdout
            except BaseException:
                program.terminate()
                raise
        if program.returncode != 0:
            said.seek(0)
            reason = last_words(said.read()) or f"exit code {program.returncode}"
            if program.returncode < 0:  # What it said last is no reason then.
                reason = f"ended by {signal.strsignal(-program.returncode)}; before that: {reason}"
            raise UserError(f"{name} failed: {reason.removeprefix(f'{name}: ')}")


def last_words(said: str) -> str:
    """The last line that tells something, of what a program wrote to stderr."""
    lines = [line.strip() for line in said.splitlines()]
    return next((line for line in reversed(lines) if line and not line.startswith(_HINT)), "")
