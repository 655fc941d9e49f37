"""Regular expressions for channel names on a command line."""

from __future__ import annotations

import argparse
import re


def channel_pattern(text: str) -> re.Pattern[str]:
    """The expression; argparse tells what is wrong with it."""
    try:
        return re.compile(text)
    except re.error as error:
        raise argparse.ArgumentTypeError(f"'{text}' is no regular expression: {error}") from None


def any_of(channels: list[re.Pattern[str]]) -> re.Pattern[str]:
    """One expression for all, also as LCM reads it (between ^ and $); of none: every channel."""
    alternatives = "|".join(channel.pattern for channel in channels)
    return re.compile(f"({alternatives})" if channels else ".*")
