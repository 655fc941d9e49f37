"""Text of unknown origin on a terminal."""

from __future__ import annotations


def printable(text: str) -> str:
    """The text, what could move a cursor or change colours written as escapes (\\x1b)."""
    return text if text.isprintable() else text.encode("unicode_escape").decode("ascii")


def printable_line(line: bytes) -> str:
    """A line of a log, without its end, as UTF-8; tabs stay."""
    text = line.removesuffix(b"\r").decode(errors="replace")
    return "\t".join(map(printable, text.split("\t")))
