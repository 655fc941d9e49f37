"""Ends the services when their supervisor has died without doing so itself.

The supervisor holds the write end of this process's stdin. When the supervisor ends, however it
ends, stdin does too; whatever still carries the supervisor's token in its environment is stopped
then: services and their children, whatever session or group they have moved to.
"""

from __future__ import annotations

import os
import signal
import sys
import time
from pathlib import Path

TOKEN_VARIABLE = "DEIXIS_SUPERVISOR"
STOP_WITHIN_S = 3.0


def main(token: str) -> None:
    """Waits for the end of stdin, then stops all processes that carry the token."""
    for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
        signal.signal(number, signal.SIG_IGN)
    while sys.stdin.buffer.read(4096):
        continue
    stop_all(token)


def stop_all(*tokens: str) -> None:
    """Stops all processes that carry one of the tokens: asked first, then killed."""
    _signal(_bearers(tokens), signal.SIGTERM)
    deadline = time.monotonic() + STOP_WITHIN_S
    while (left := _bearers(tokens)) and time.monotonic() < deadline:
        time.sleep(0.05)
    _signal(left, signal.SIGKILL)


def _bearers(tokens: tuple[str, ...]) -> list[int]:
    needles = {f"{TOKEN_VARIABLE}={token}".encode() for token in tokens}
    pids = [int(entry.name) for entry in Path("/proc").iterdir() if entry.name.isdigit()]
    return [pid for pid in pids if pid != os.getpid() and needles & _environment(pid)]


def _environment(pid: int) -> set[bytes]:
    try:
        return set(Path(f"/proc/{pid}/environ").read_bytes().split(b"\0"))
    except OSError:
        return set()  # Gone, or not ours.


def _signal(pids: list[int], number: signal.Signals) -> None:
    for pid in pids:
        try:
            os.kill(pid, number)
        except ProcessLookupError:
            continue


if __name__ == "__main__":
    main(sys.argv[1])
