"""A service's log that is shown on a stream, too, line by line."""

from __future__ import annotations

from typing import BinaryIO

from deixis_frontend.printable import printable_line
from deixis_frontend.supervision.rotating_log import RotatingLog

_LONGEST_LINE_BYTES = 16384  # one that does not end is shown in parts


class EchoedLog:
    """Writes to a RotatingLog, and `name | line` to a stream for as long as somebody reads it."""

    def __init__(self, log: RotatingLog, name: str, stream: BinaryIO) -> None:
        self._log = log
        self._prefix = f"{name} | "
        self._stream: BinaryIO | None = stream
        self._rest = b""

    @property
    def lost_bytes(self) -> int:
        """What the log found no room for."""
        return self._log.lost_bytes

    def write(self, data: bytes) -> None:
        """Appends `data`."""
        self._log.write(data)
        *lines, self._rest = (self._rest + data).split(b"\n")
        if len(self._rest) > _LONGEST_LINE_BYTES:
            lines, self._rest = [*lines, self._rest], b""
        self._show(lines)

    def close(self) -> None:
        """Closes the log; what stands without an end of line is shown."""
        self._show([self._rest] if self._rest else [])
        self._rest = b""
        self._log.close()

    def _show(self, lines: list[bytes]) -> None:
        if self._stream is None or not lines:
            return
        try:
            self._stream.write("".join(f"{self._prefix}{printable_line(line)}\n"
                                       for line in lines).encode())
            self._stream.flush()
        except OSError:
            self._stream = None  # Nobody reads any more; the log has it all.
