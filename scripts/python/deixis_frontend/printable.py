"""Text of unknown origin on a terminal."""

from __future__ import annotations


def printable(text: str) -> str:
    """The text, what could move a cursor or change colours written as escapes (\\x1b)."""
    return text if text.isprintable() else text.encode("unicode_escape").decode("ascii")
