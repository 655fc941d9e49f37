"""Texts on the command line that must name something: an empty one is wrong usage (exit code 2)."""

from __future__ import annotations

import argparse
from pathlib import Path


def name(text: str) -> str:
    """A text that is not empty."""
    if not text:
        raise argparse.ArgumentTypeError("is empty: name something, or leave the option out")
    return text


def file_path(text: str) -> Path:
    """A path that is not empty: Path("") would be the folder that one is in."""
    return Path(name(text))
