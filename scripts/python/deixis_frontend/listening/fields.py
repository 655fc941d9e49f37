"""Messages as plain values, and the fields of them that are asked for.

Byte arrays become a short text unless they are wanted in full.
"""

from __future__ import annotations

import argparse
import re
from dataclasses import dataclass
from typing import Any

_SHOWN_BYTES = 8
_STEP = re.compile(r"(?:^|\.)([A-Za-z_]\w*)|\[(\d+|\*)\]")


class NoSuchField(Exception):
    """A type has no field of that name. The text names those that there are."""


@dataclass(frozen=True)
class Path:
    """hands[0].centre_px as steps: a name, the number of an element, or * for all elements."""

    text: str
    steps: tuple[str | int, ...]


def field_path(text: str) -> Path:
    """Reads a path for argparse."""
    steps: list[str | int] = []
    end = 0
    for match in iter(lambda: _STEP.match(text, end), None):
        name, index = match.groups()
        steps.append(name if name else index if index == "*" else int(index))
        end = match.end()
    if end != len(text) or not steps or not re.match(r"[A-Za-z_]", text):
        raise argparse.ArgumentTypeError(
            f"'{text}' is no field: write for example hands[0].centre_px, hands[*].id")
    return Path(text, tuple(steps))


def select(message: Any, path: Path) -> Any:
    """The value there: None where a list has no such element, a list of all where the path has *.

    Raises NoSuchField.
    """
    return _follow(message, path.steps)


def plain(value: Any, *, is_full: bool) -> Any:
    """Dictionaries, lists and numbers; bytes only when `is_full`, else a text with their size."""
    if hasattr(value, "_decode_one"):
        return {name: plain(getattr(value, name), is_full=is_full) for name in value.__slots__}
    if isinstance(value, (list, tuple)):
        return [plain(part, is_full=is_full) for part in value]
    if isinstance(value, bytes) and not is_full:
        return _shortened(value)
    return value


def _follow(value: Any, steps: tuple[str | int, ...]) -> Any:
    for number, step in enumerate(steps):
        if step == "*":
            _require_list(value, step)
            return [_follow(part, steps[number + 1:]) for part in value]
        value = _step(value, step)
        if value is None:
            return None
    return value


def _step(value: Any, step: str | int) -> Any:
    if isinstance(step, int):
        _require_list(value, step)
        return value[step] if step < len(value) else None
    if not hasattr(value, "_decode_one") or step not in value.__slots__:
        raise NoSuchField(f"has no field {step}{_alternatives(value)}")
    return getattr(value, step)


def _require_list(value: Any, step: str | int) -> None:
    if not isinstance(value, (list, tuple, bytes)):
        raise NoSuchField(f"has nothing that [{step}] could be an element of")


def _alternatives(value: Any) -> str:
    if hasattr(value, "_decode_one"):
        return f": there are {', '.join(value.__slots__)}"
    return ": what holds it is a list: write [0] or [*]" if isinstance(value, (list, tuple)) else ""


def _shortened(data: bytes) -> str:
    begin, more = data[:_SHOWN_BYTES], "..." if data[_SHOWN_BYTES:] else ""
    text = begin.decode("ascii", errors="replace")
    shown = f'"{text}"' if text.isascii() and text.isprintable() else begin.hex()
    return f"<{len(data)} bytes: {shown}{more}>" if data else "<0 bytes>"
