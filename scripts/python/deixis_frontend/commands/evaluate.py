"""`deixis evaluate WHAT`: each part's evaluation is a module of its own, named in one table."""

from __future__ import annotations

from deixis_frontend.cli import Command

_PACKAGE = "deixis_frontend.evaluation"
SUBCOMMANDS: dict[str, Command] = {
    "hands": Command(f"{_PACKAGE}.hands", "the hand tracker's error, misses and false tracks"),
    "pointing": Command(f"{_PACKAGE}.pointing", "which pointing gestures are recognised, and when"),
}
