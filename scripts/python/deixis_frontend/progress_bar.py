"""How far a long command is, on a terminal."""

from __future__ import annotations

import sys
import time

_EVERY_S = 0.2
_WIDTH = 30


class ProgressBar:
    """A bar on stderr while work is done; silent where stderr is no terminal. A context manager."""

    def __init__(self, total: int) -> None:
        """`total` is what `show` gets when all is done."""
        self._total = max(total, 1)
        self._is_shown = sys.stderr.isatty()
        self._next = 0.0

    def __enter__(self) -> ProgressBar:
        return self

    def __exit__(self, *_: object) -> None:
        if self._is_shown:
            print("\r\033[K", end="", file=sys.stderr, flush=True)

    def show(self, done: int) -> None:
        """Draws the bar anew, a few times per second."""
        if not self._is_shown or time.monotonic() < self._next:
            return
        self._next = time.monotonic() + _EVERY_S
        part = min(done / self._total, 1.0)
        bar = "#" * round(part * _WIDTH)
        print(f"\r[{bar:<{_WIDTH}}] {part:4.0%}", end="", file=sys.stderr, flush=True)
