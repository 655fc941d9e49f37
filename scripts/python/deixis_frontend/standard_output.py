"""Standard output that nobody reads, or that finds no room: told in one line, never passed over."""

from __future__ import annotations

import os
import sys
from collections.abc import Callable
from contextlib import redirect_stdout
from io import TextIOWrapper
from typing import Any, TextIO, cast

READER_HAS_GONE = 141  # exit code, as of a shell


class OutputError(OSError):
    """What was printed could not be written."""


def checked(run: Callable[[], int]) -> int:
    """What `run` returns once all that it printed is written.

    1, with the reason on stderr, when that is not possible; 141 when the reader has gone.
    """
    if sys.stdout is None:  # Closed by whoever called us.
        return run()
    try:
        output = _Output(sys.stdout)
        with redirect_stdout(cast(TextIO, output)):
            return _run_to_the_last_byte(run, output)
    except BrokenPipeError:  # Of stderr: most often they share a reader.
        discard()
        return READER_HAS_GONE
    except OutputError as error:
        discard()
        if isinstance(error.__cause__, BrokenPipeError):
            return READER_HAS_GONE  # Not our fault, and nobody left to tell.
        print(f"deixis: cannot write the output: {error.strerror}", file=sys.stderr)
        return 1


def discard() -> None:
    """Throws away what is left to be written, and all that is printed from now on."""
    os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())


def _run_to_the_last_byte(run: Callable[[], int], output: _Output) -> int:
    try:
        code = run()
    except SystemExit:
        if output.error is not None:  # argparse, which prints --help, passes over that.
            raise output.error from output.error.__cause__
        output.flush()
        raise
    output.flush()
    return code


class _Output:
    """A stream whose errors can be told from those of other files."""

    def __init__(self, stream: TextIO) -> None:
        self._stream = stream
        # German names, say, where only ASCII goes. Another way than "strict" was chosen by someone.
        if isinstance(stream, TextIOWrapper) and stream.errors == "strict":
            stream.reconfigure(errors="backslashreplace")
        self.error: OutputError | None = None  # the last one

    def write(self, text: str) -> int:
        return self._checked(self._stream.write, text)

    def flush(self) -> None:
        self._checked(self._stream.flush)

    def __getattr__(self, name: str) -> Any:
        return getattr(self._stream, name)

    def _checked(self, action: Callable[..., Any], *arguments: str) -> Any:
        try:
            return action(*arguments)
        except OSError as error:
            self.error = OutputError(error.errno, error.strerror)
            raise self.error from error
