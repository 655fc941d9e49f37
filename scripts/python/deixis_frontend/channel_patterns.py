"""Regular expressions for channel names on a command line."""

from __future__ import annotations

import argparse
import re

from deixis_frontend.errors import UserError


def channel_pattern(text: str) -> re.Pattern[str]:
    """The expression; argparse tells what is wrong with it."""
    if not text:
        raise argparse.ArgumentTypeError("'' is no channel: name one, or '.*' for all")
    try:
        return re.compile(text)
    except re.error as error:
        raise argparse.ArgumentTypeError(f"'{text}' is no regular expression: {error}") from None


def any_of(channels: list[re.Pattern[str]]) -> re.Pattern[str]:
    """One expression for all, also as LCM reads it (between ^ and $); of none: every channel.

    Raises UserError when they do not go together.
    """
    alternatives = "|".join(channel.pattern for channel in channels)
    try:
        return re.compile(f"({alternatives})" if channels else ".*")
    except re.error as error:
        raise UserError(f"the channels {alternatives} do not go together: {error}:"
                        " write for example (?i:name) in place of (?i)name") from None
