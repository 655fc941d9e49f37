"""`deixis delay`: age of the messages per channel, from capture to arrival."""

from __future__ import annotations

import argparse
from typing import Any

from deixis_frontend.listening import meter
from deixis_frontend.listening.ages import HEADER, ChannelAge
from deixis_frontend.listening.source import Arrival


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """As of `hz`."""
    meter.add_arguments(parser)
    parser.epilog = ("GESTURES is sent twice, when a gesture is decided and when it ends, both with"
                     " the utime of the decision: the second one's age grows with the gesture's length.")


def run(arguments: argparse.Namespace) -> int:
    """0 when messages with a capture time came."""
    def measure(channels: dict[str, ChannelAge], arrival: Arrival, stamp: Any) -> None:
        if stamp is None or stamp.utime is None:
            return
        if arrival.channel not in channels:
            channels[arrival.channel] = ChannelAge(arrival.channel, arguments.window)
        channels[arrival.channel].add(arrival.time_us, stamp.utime)

    return meter.run(arguments, HEADER, measure)
