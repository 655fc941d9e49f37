"""`deixis hz`: rate, intervals and loss per channel, live or of a log."""

from __future__ import annotations

import argparse
from typing import Any

from deixis_frontend.listening import meter
from deixis_frontend.listening.rates import HEADER, ChannelRate
from deixis_frontend.listening.source import Arrival

add_arguments = meter.add_arguments


def run(arguments: argparse.Namespace) -> int:
    """0 when messages came."""
    def measure(channels: dict[str, ChannelRate], arrival: Arrival, stamp: Any) -> None:
        if arrival.channel not in channels:
            channels[arrival.channel] = ChannelRate(arrival.channel, arguments.window)
        channel = channels[arrival.channel]
        channel.add(arrival.time_us, len(arrival.data))
        if stamp is not None:
            channel.loss.add(stamp.sequence, stamp.publisher)

    return meter.run(arguments, HEADER, measure)
