"""What /proc knows of a process: CPU time, memory."""

from __future__ import annotations

import os
import time
from pathlib import Path

from deixis_frontend.printable import printable

_TICKS_PER_S = os.sysconf("SC_CLK_TCK")
_PAGE_BYTES = os.sysconf("SC_PAGE_SIZE")


def cpu_seconds(pid: int) -> float | None:
    """CPU time of all threads so far; None when the process is gone."""
    try:
        text = Path(f"/proc/{pid}/stat").read_text(encoding="ascii", errors="replace")
    except OSError:
        return None
    # The name in brackets may hold spaces and brackets itself: count from its end.
    fields = text.rpartition(")")[2].split()
    return (int(fields[11]) + int(fields[12])) / _TICKS_PER_S


def resident_bytes(pid: int) -> int | None:
    """Memory in use, shared pages included; None when the process is gone."""
    try:
        return int(Path(f"/proc/{pid}/statm").read_text(encoding="ascii").split()[1]) * _PAGE_BYTES
    except (OSError, IndexError):
        return None


def command_name(pid: int) -> str:
    """Name of the program and its pid, for people."""
    try:
        words = Path(f"/proc/{pid}/cmdline").read_bytes().decode(errors="replace").split("\0")
    except OSError:
        words = [""]
    return f"{printable(Path(words[0]).name) or 'a process'} pid {pid}"


class CpuMeter:
    """Share of one core that a process used between two calls."""

    def __init__(self) -> None:
        self._pid = -1
        self._seconds = 0.0
        self._time = 0.0
        self.percent: float | None = None

    def sample(self, pid: int) -> None:
        """Takes a sample; a new pid starts anew."""
        seconds, now = cpu_seconds(pid), time.monotonic()
        if seconds is None or pid != self._pid:
            self.percent = None
        elif now > self._time:
            self.percent = 100.0 * (seconds - self._seconds) / (now - self._time)
        self._pid, self._seconds, self._time = pid, seconds or 0.0, now
