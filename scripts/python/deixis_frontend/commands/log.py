"""`deixis log`: what the services wrote, with or without a supervisor running."""

from __future__ import annotations

import argparse
import itertools
import os
import time
from collections.abc import Iterator
from pathlib import Path
from typing import BinaryIO

from deixis_frontend import layout as layouts
from deixis_frontend.commands.system_option import add_names, add_system, open_system
from deixis_frontend.errors import UserError
from deixis_frontend.number_options import count
from deixis_frontend.printable import printable_line
from deixis_frontend.supervision.supervisor import log_folder

_POLL_S = 0.2
_BYTES_PER_LINE = 400  # generous: how far from the end the last lines are looked for


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """What to show, how much of it, and whether to go on."""
    add_names(parser, "whose log (default: all)")
    parser.add_argument("-f", "--follow", action="store_true", help="go on as lines come")
    parser.add_argument("-n", "--lines", type=count, default=20, help="lines per service (20)")
    add_system(parser)


def run(arguments: argparse.Namespace) -> int:
    """0; raises UserError when there is no log."""
    system, _ = open_system(arguments)
    folder = log_folder(system, layouts.find())
    names = system.resolve(arguments.names) if arguments.names else list(system.services)
    tails = [Tail(folder / f"{name}.log", f"{name} | " if len(names) > 1 else "")
             for name in names]
    if not arguments.follow and not any(tail.exists() for tail in tails):
        raise UserError(f"no logs in {folder}: `deixis start` first")
    for tail in tails:
        _print(tail.last(arguments.lines))
    while arguments.follow:
        for tail in tails:
            _print(tail.new())
        time.sleep(_POLL_S)
    return 0


class Tail:
    """The end of a log file that is rotated while it is being read."""

    def __init__(self, path: Path, prefix: str) -> None:
        self._path = path
        self._prefix = prefix
        self._file: BinaryIO | None = None
        self._rest = b""

    def exists(self) -> bool:
        """True when there is a file to read."""
        return self._path.exists()

    def last(self, count: int) -> Iterator[str]:
        """The last `count` lines."""
        if not self._open():
            return
        assert self._file is not None
        size = self._file.seek(0, os.SEEK_END)
        self._file.seek(max(0, size - count * _BYTES_PER_LINE))
        yield from list(self._read())[-count:] if count > 0 else []

    def new(self) -> Iterator[str]:
        """The lines since the last call."""
        if self._file is None and not self._open():
            return
        yield from self._read()
        for path in self._newer_files():
            yield from self._read()  # What came between the reading and the rotation.
            self._open(path)
            yield from self._read()

    def _open(self, path: Path | None = None) -> bool:
        if self._file:
            self._file.close()
        try:
            self._file = (path or self._path).open("rb")
        except FileNotFoundError:
            self._file = None
        return self._file is not None

    def _read(self) -> Iterator[str]:
        assert self._file is not None
        *lines, self._rest = (self._rest + self._file.read()).split(b"\n")
        for line in lines:
            yield self._prefix + printable_line(line)

    def _newer_files(self) -> list[Path]:
        """The files that were begun after the open one, oldest first."""
        assert self._file is not None
        ours = os.fstat(self._file.fileno()).st_ino
        newer: list[Path] = []
        for number in itertools.count():
            path = self._path.with_name(f"{self._path.name}.{number}") if number else self._path
            if not path.exists() or path.stat().st_ino == ours:
                return newer[::-1]
            newer.append(path)
        raise AssertionError("files are numbered without end")


def _print(lines: Iterator[str]) -> None:
    for line in lines:
        print(line, flush=True)
