"""What the supervisor itself has to say goes to its stderr, supervisor.log."""

from __future__ import annotations

import os
import time


def say(text: str) -> None:
    """Writes a line. A full disk loses it, and stops nothing."""
    try:
        os.write(2, (text + "\n").encode())
    except OSError:
        return  # Nobody is left to tell; `status` counts what else is lost.


def note(text: str) -> None:
    """Writes a line on the supervisor's life, with the time, as services' logs have them."""
    say(f"-- {time.strftime('%Y-%m-%dT%H:%M:%S')} supervisor: {text}")
