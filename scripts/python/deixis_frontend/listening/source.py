"""Where messages come from: the bus, as they arrive, or a log file, as fast as it can be read."""

from __future__ import annotations

import argparse
import math
import re
import select
import sys
import time
from collections import deque
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Protocol

from deixis_frontend import lcm_url
from deixis_frontend.bus import open_bus
from deixis_frontend.channel_patterns import any_of, channel_pattern
from deixis_frontend.errors import UserError
from deixis_frontend.lcm_tools import require_log
from deixis_frontend.lcm_url import LcmUrl
from deixis_frontend.number_options import above_zero
from deixis_frontend.printable import printable
from deixis_frontend.self_test import is_self_test
from deixis_lcm.log_events import EventReader

_TICK_S = 0.1
_QUEUE = 500  # messages that wait while the tool is busy; LCM drops what is more
_SILENT_S = 3.0  # without a message for so long, people wonder
MOST_CHANNELS = 1000  # more than any robot has: noise is not to fill the memory
OTHER_CHANNELS = "(other channels)"


@dataclass(frozen=True)
class Arrival:
    """A message as bytes. `time_us`: when it arrived here, or at the logger; wall clock.

    `channel` can be printed whatever was sent; see ChannelNames.
    """

    time_us: int
    channel: str
    data: bytes


class ChannelNames:
    """Names of channels as they are shown: printable, and those beyond a thousand under one."""

    def __init__(self) -> None:
        self._names: dict[str, str] = {}

    def shown(self, channel: str) -> str:
        """The name to show."""
        if channel not in self._names and len(self._names) >= MOST_CHANNELS:
            return OTHER_CHANNELS
        return self._names.setdefault(channel, printable(channel) or "(no name)")


class Source(Protocol):
    """Yields what arrives, and None now and then, so that whoever listens can do other things.

    LCM's self tests are left out.
    """

    name: str
    url: LcmUrl | None  # of a log: None

    def __iter__(self) -> Iterator[Arrival | None]: ...


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """The channels, and a log to be read in place of the bus."""
    parser.add_argument("channels", nargs="*", type=channel_pattern, metavar="CHANNEL",
                        help="channels or regular expressions of them (default: all)")
    add_log(parser)
    parser.add_argument("--seconds", type=above_zero, metavar="N",
                        help="stop after N seconds (of the log, with --log)")


def add_log(parser: argparse.ArgumentParser) -> None:
    """The log to be read in place of the bus."""
    parser.add_argument("--log", type=Path, metavar="FILE", help="read a log, not the bus")


def open_source(arguments: argparse.Namespace) -> Source:
    """What the arguments name; raises UserError when there is no such bus or log."""
    channels = any_of(getattr(arguments, "channels", []))
    if arguments.log is None:
        return Live(lcm_url.choose(arguments.lcm_url), channels, arguments.seconds)
    require_log(arguments.log)
    return Log(arguments.log, channels, arguments.seconds)


class Live:
    """The messages on the bus, for so many seconds or for ever. Subscribed from the beginning.

    Iterating raises UserError when the connection is lost.
    """

    def __init__(self, url: LcmUrl, channels: re.Pattern[str], seconds: float | None) -> None:
        self.name = str(url)
        self.url: LcmUrl | None = url
        self._channels = channels
        self._names = ChannelNames()
        self._seconds = seconds
        self._waiting: deque[Arrival] = deque()
        self._bus = open_bus(url)
        self._bus.subscribe(channels.pattern, self._take).set_queue_capacity(_QUEUE)

    def __iter__(self) -> Iterator[Arrival | None]:
        end = None if self._seconds is None else time.monotonic() + self._seconds
        while end is None or time.monotonic() < end:
            self._handle()
            while self._waiting:
                yield self._waiting.popleft()
            yield None

    def _handle(self) -> None:
        """Takes one message if one comes within a tick."""
        try:
            # Not in handle_timeout(): Ctrl-C ends a select at once.
            if select.select([self._bus.fileno()], [], [], _TICK_S)[0]:
                self._bus.handle_timeout(0)
        except (OSError, ValueError):  # ValueError: LCM has no descriptor any more.
            raise UserError(f"the connection to '{self.name}' is lost") from None

    def _take(self, channel: str, data: bytes) -> None:
        # LCM's expressions are of another dialect.
        if self._channels.fullmatch(channel) and not is_self_test(channel, data):
            arrived_us = time.time_ns() // 1000
            self._waiting.append(Arrival(arrived_us, self._names.shown(channel), data))


class Log:
    """The messages of a log file, for so many of its seconds or to its end."""

    url: LcmUrl | None = None

    def __init__(self, path: Path, channels: re.Pattern[str], seconds: float | None) -> None:
        self.name = str(path)
        self._path = path
        self._channels = channels
        self._names = ChannelNames()
        self._length_us = None if seconds is None else seconds * 1e6

    def __iter__(self) -> Iterator[Arrival | None]:
        with EventReader(self._path) as events:
            begin_us: int | None = None
            for event in events:
                begin_us = event.time_us if begin_us is None else begin_us
                if self._length_us is not None and event.time_us - begin_us > self._length_us:
                    break
                if not self._channels.fullmatch(event.channel):
                    continue
                data = events.data(event)
                if not is_self_test(event.channel, data):
                    yield Arrival(event.time_us, self._names.shown(event.channel), data)
            if events.damage():
                print(f"deixis: {self.name}: {events.damage()}", file=sys.stderr)


def telling_silence(messages: Source,
                    channels: list[re.Pattern[str]]) -> Iterator[Arrival | None]:
    """All of them; says once when none has come from the bus for some seconds."""
    silent_at = time.monotonic() + _SILENT_S if messages.url else math.inf
    for arrival in messages:
        if arrival is not None:
            silent_at = math.inf
        elif time.monotonic() >= silent_at:
            silent_at = math.inf
            print(f"deixis: {why_nothing(messages, channels, ' yet')}", file=sys.stderr, flush=True)
        yield arrival


def why_nothing(source: Source, channels: list[re.Pattern[str]], yet: str = "") -> str:
    """What to say when no message came, or none `yet`."""
    wanted = f" on {', '.join(channel.pattern for channel in channels)}" if channels else ""
    cure = ("`deixis topics` lists what is spoken there" if source.url
            else f"`deixis topics --log {source.name}` lists what it holds")
    return f"no message{wanted} from {source.name}{yet}: {cure}"
