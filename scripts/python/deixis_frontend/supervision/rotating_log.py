"""A log file that is moved aside when it is full: x.log, x.log.1, ... x.log.<count>."""

from __future__ import annotations

import os
from pathlib import Path

from deixis_frontend.supervision.own_log import say


class RotatingLog:
    """Appends bytes to a file; keeps at most `count` full ones beside it.

    A disk that is full loses lines, never the caller: writing goes on when there is room again.
    """

    def __init__(self, path: Path, size_bytes: int, count: int) -> None:
        self._path = path
        self._size_bytes = size_bytes
        self._count = count
        self._file: int | None = None
        self._written = 0
        self._at_line_start = True
        self.lost_bytes = 0

    def write(self, data: bytes) -> None:
        """Appends `data`; lines are not torn between files, unless longer than two."""
        try:
            self._write(data)
        except OSError as error:
            if not self.lost_bytes:
                say(f"{self._path}: {error.strerror}: lines are lost")
            self.lost_bytes += len(data)
            self.close()

    def close(self) -> None:
        """Closes the file; a later write opens it again."""
        if self._file is not None:
            os.close(self._file)
            self._file = None

    def _write(self, data: bytes) -> None:
        if self._file is None:
            self._open()
        while data:
            piece = self._fitting(data)
            if not piece and self._is_between_lines() and self._written:
                self._rotate()
                continue
            piece = piece or data[: data.find(b"\n") + 1] or data
            self._append(piece)
            data = data[len(piece):]

    def _fitting(self, data: bytes) -> bytes:
        """As many whole lines of `data` as the file has room for."""
        room = self._size_bytes - self._written
        return data if len(data) <= room else data[: data.rfind(b"\n", 0, max(room, 0)) + 1]

    def _is_between_lines(self) -> bool:
        """True at the start of a line, and in one that will not end."""
        return self._at_line_start or self._written > 2 * self._size_bytes

    def _append(self, data: bytes) -> None:
        assert self._file is not None
        while data:
            written = os.write(self._file, data)
            self._written += written
            self._at_line_start = data[written - 1: written] == b"\n"
            data = data[written:]

    def _open(self) -> None:
        self._path.parent.mkdir(parents=True, exist_ok=True)
        flags = os.O_WRONLY | os.O_CREAT | os.O_APPEND | os.O_CLOEXEC
        self._file = os.open(self._path, flags, 0o644)
        self._written = os.fstat(self._file).st_size

    def _rotate(self) -> None:
        self.close()
        for number in range(self._count - 1, 0, -1):
            if self._numbered(number).exists():
                self._numbered(number).replace(self._numbered(number + 1))
        self._path.replace(self._numbered(1))
        self._open()

    def _numbered(self, number: int) -> Path:
        return self._path.with_name(f"{self._path.name}.{number}")
