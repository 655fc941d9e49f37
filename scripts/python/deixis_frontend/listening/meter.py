"""What `hz` and `delay` have in common: a table per second while messages come, one at the end."""

from __future__ import annotations

import argparse
import re
import signal
import time
from collections.abc import Callable
from contextlib import suppress
from typing import Any, Protocol

from deixis_frontend import layout as layouts
from deixis_frontend import text_table
from deixis_frontend.errors import UserError
from deixis_frontend.interrupts import end_as_by_ctrl_c
from deixis_frontend.listening import source
from deixis_frontend.listening.decoder import Decoder
from deixis_frontend.listening.source import Arrival, Source
from deixis_frontend.number_options import above_zero

_TABLE_EVERY_S = 1.0


class Channel(Protocol):
    """What is measured on one channel."""

    def recent_row(self, now_us: int) -> tuple[str, ...]: ...
    def whole_row(self) -> tuple[str, ...]: ...
    def notes(self) -> list[str]: ...


# Given the channels so far, a message, and its stamp: None when it does not decode.
Measure = Callable[[dict[str, Any], Arrival, Any], None]


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """The channels, and the window of the live table."""
    source.add_arguments(parser)
    parser.add_argument("--window", type=above_zero, default=5.0, metavar="S",
                        help="seconds that the live table looks back (default: 5)")


def run(arguments: argparse.Namespace, header: tuple[str, ...], measure: Measure) -> int:
    """0 when something was measured; Ctrl-C, SIGTERM and SIGHUP end it alike."""
    meter = Meter(Decoder(layouts.find()), header, measure)
    messages = source.open_source(arguments)
    end_as_by_ctrl_c(signal.SIGTERM, signal.SIGHUP)
    try:
        with suppress(KeyboardInterrupt):
            meter.listen(messages, arguments.channels)
    finally:
        meter.conclude(messages)
    if not meter.has_heard:
        raise UserError(source.why_nothing(messages, arguments.channels))
    return 0 if meter.channels else 1


class Meter:
    """Hands every message to the measure, prints tables."""

    def __init__(self, decoder: Decoder, header: tuple[str, ...], measure: Measure) -> None:
        from deixis_lcm import stamps

        self._stamp_of = stamps.stamp_of
        self._decoder = decoder
        self._header = header
        self._measure = measure
        self.channels: dict[str, Channel] = {}
        self.has_heard = False

    def listen(self, messages: Source, channels: list[re.Pattern[str]]) -> None:
        """Until there are no more; a table per second when they come live."""
        next_table = time.monotonic() + _TABLE_EVERY_S
        for arrival in source.telling_silence(messages, channels):
            if arrival is not None:
                self._take(arrival)
            elif messages.url and time.monotonic() >= next_table:
                next_table = time.monotonic() + _TABLE_EVERY_S  # One, however many were missed.
                self._print_recent()

    def conclude(self, messages: Source) -> None:
        """The table of all that came, and what needs words."""
        if self.channels:
            print(f"all of {messages.name}:")
            self._print([channel.whole_row() for channel in self.channels.values()])
        for note in [note for channel in self.channels.values() for note in channel.notes()]:
            print(note)
        if self._decoder.words():
            print(f"not decoded: {self._decoder.words()}")

    def _take(self, arrival: Arrival) -> None:
        self.has_heard = True
        message = self._decoder.decode(arrival)
        stamp = None if message is None else self._stamp_of(message.content)
        self._measure(self.channels, arrival, stamp)

    def _print_recent(self) -> None:
        if not self.channels:
            return
        now_us = time.time_ns() // 1000
        self._print([channel.recent_row(now_us) for channel in self.channels.values()])
        print(flush=True)

    def _print(self, rows: list[tuple[str, ...]]) -> None:
        print("\n".join(text_table.lines([self._header, *sorted(rows)])))
