"""Questions that are answered by yes or no."""

from __future__ import annotations

import sys


def is_wanted(question: str) -> bool:
    """Asks on stderr; who is not there to answer, or ends the input (Ctrl-D), does not want it."""
    print(f"{question} [y/N] ", end="", file=sys.stderr, flush=True)
    answer = sys.stdin.readline()
    if not answer.endswith("\n"):
        print(file=sys.stderr)
    return answer.strip().lower() in ("y", "yes")
