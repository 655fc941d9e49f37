"""Converts an LCM log message by message; what cannot be converted is counted."""

from __future__ import annotations

import errno
import re
from collections import Counter
from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from deixis_frontend.errors import UserError
from deixis_frontend.export.converter import Converter
from deixis_frontend.export.mcap_file import McapFile
from deixis_frontend.export.times import utime_of
from deixis_frontend.output_files import UnfinishedFile
from deixis_frontend.self_test import CHANNELS as SELF_TEST_CHANNELS
from deixis_frontend.self_test import is_self_test
from deixis_lcm.log_events import Event, EventReader
from deixis_lcm.logs import decode, types_by_fingerprint

Progress = Callable[[int], None]  # bytes of the log that have been read


@dataclass
class Exported:
    """What became of a log."""

    read: int = 0  # messages on channels that were asked for
    written: int = 0
    refused: int = 0  # known types that do not decode, or whose numbers make no sense
    last_refusal: str = ""
    damage: str = ""
    left_out: Counter[str] = field(default_factory=Counter)
    other_channels: set[str] = field(default_factory=set)


def export(log: Path, output: UnfinishedFile, channels: re.Pattern[str],
           progress: Progress) -> Exported:
    """Writes the messages on `channels` to `output`; raises UserError when that fails."""
    try:
        with output.path.open("wb") as stream, EventReader(log) as events:
            return _Export(events, McapFile(stream)).run(channels, progress)
    except OSError as error:
        if error.errno in (errno.ENOSPC, errno.EDQUOT):
            raise UserError(f"{output.target} was not written: the disk is full: make room, or"
                            " name an --mcap on another disk") from None
        raise UserError(f"{output.target} was not written: {error.strerror or error}") from None


class _Export:
    def __init__(self, events: EventReader, file: McapFile) -> None:
        self._events = events
        self._file = file
        self._converter = Converter()
        self._types = types_by_fingerprint()
        self._done = Exported(left_out=self._converter.left_out)

    def run(self, channels: re.Pattern[str], progress: Progress) -> Exported:
        for event in self._events:
            if not self._is_self_test(event):
                self._count_and_take(event, channels)
            progress(event.end)
        self._file.finish()
        self._done.written = self._file.messages
        self._done.damage = self._events.damage()
        return self._done

    def _is_self_test(self, event: Event) -> bool:
        return (event.channel in SELF_TEST_CHANNELS  # First: most data need not be read for it.
                and is_self_test(event.channel, self._events.data(event)))

    def _count_and_take(self, event: Event, channels: re.Pattern[str]) -> None:
        if channels.fullmatch(event.channel):
            self._done.read += 1
            self._take(event)
        else:
            self._done.other_channels.add(event.channel)

    def _take(self, event: Event) -> None:
        try:
            if not 0 <= event.time_us <= _LATEST_US:
                raise ValueError(f"log time {event.time_us} us fits into no MCAP file")
            message = decode(self._events.data(event), self._types)
            for topic, converted in self._converter.convert(event.channel, message):
                self._file.write(topic, converted, event.time_us, _utime(message))
        except ValueError as error:
            self._done.refused += 1
            self._done.last_refusal = f"{event.channel} at {event.time_us} us: {error}"


_LATEST_US = (2**64 - 1) // 1000  # MCAP counts nanoseconds


def _utime(message: Any) -> int:
    """Its time in microseconds; ValueError if it fits into no MCAP file."""
    utime = utime_of(message)
    if not 0 <= utime <= _LATEST_US:
        raise ValueError(f"utime {utime} us fits into no MCAP file")
    return utime
