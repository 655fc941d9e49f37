"""Publishes the messages of a log as they came."""

from __future__ import annotations

import re
import time
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from deixis_lcm.log_events import Event, EventReader

LONGEST_NAME = 63  # bytes of a channel's, LCM's own limit


@dataclass
class Played:
    """What became of a log."""

    published: int = 0
    bytes: int = 0
    other_channels: set[str] = field(default_factory=set)  # that were not asked for
    unsendable: int = 0  # messages on channels of names that LCM does not carry
    damage: str = ""


def play(log: Path, bus: Any, channels: re.Pattern[str], speed: float) -> Played:
    """Publishes the messages on the channels at the distances in time of the log, by `speed`."""
    played = Played()
    with EventReader(log) as events:
        clock: _Clock | None = None
        for event in events:
            if not channels.fullmatch(event.channel):
                played.other_channels.add(event.channel)
                continue
            if not _is_sendable(event.channel):
                played.unsendable += 1
                continue
            clock = clock or _Clock(event, speed)
            clock.wait_for(event)
            data = events.data(event)
            bus.publish(event.channel, data)
            played.published += 1
            played.bytes += len(data)
        played.damage = events.damage()
    return played


def _is_sendable(channel: str) -> bool:
    """Whether LCM carries the name. In a damaged log any may stand."""
    return 0 < len(channel.encode()) <= LONGEST_NAME and "\0" not in channel


_LONGEST_GAP_S = 3600.0  # a longer one is a jump of the clock that stamped the log


class _Clock:
    """Turns times of the log into those of playing."""

    def __init__(self, first: Event, speed: float) -> None:
        self._first_us = self._last_us = first.time_us
        self._began = time.monotonic()
        self._speed = speed

    def wait_for(self, event: Event) -> None:
        """Returns when it is the event's turn; at once where the log's time jumps, back or far ahead."""
        since_s = (event.time_us - self._last_us) / 1e6
        self._last_us = event.time_us
        if not 0.0 <= since_s <= _LONGEST_GAP_S:
            self._first_us, self._began = event.time_us, time.monotonic()
        due = self._began + (event.time_us - self._first_us) / 1e6 / self._speed
        while (left := due - time.monotonic()) > 0.0:
            time.sleep(min(left, _LONGEST_GAP_S))
