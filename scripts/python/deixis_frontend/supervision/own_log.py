"""What the supervisor itself has to say goes to its stderr, supervisor.log."""

from __future__ import annotations

import os


def say(text: str) -> None:
    """Writes a line. A full disk loses it, and stops nothing."""
    try:
        os.write(2, (text + "\n").encode())
    except OSError:
        return  # Nobody is left to tell; `status` counts what else is lost.
