"""What is spoken on a bus: channels, types, who speaks and who listens, and what does not fit."""

from __future__ import annotations

import time
from collections import Counter
from contextlib import ExitStack, suppress
from dataclasses import dataclass, field
from typing import Any

from deixis_frontend.layout import Layout
from deixis_frontend.listening.decoder import Decoder
from deixis_frontend.listening.rates import Loss
from deixis_frontend.listening.source import Arrival, Source
from deixis_frontend.listening.udp_senders import Senders, SenderWatch
from deixis_frontend.printable import printable

STATUS_TYPE = "deixis.service_status_t"
# One publisher that begins anew steps back once; two that alternate do it again and again.
_STEPS_BACK_OF_TWO = 2
_MOST_SERVICES = 1000  # noise is not to fill the memory


@dataclass
class Channel:
    """What came on one channel, and who says to have to do with it."""

    name: str
    messages: int = 0
    bytes: int = 0
    types: Counter[str] = field(default_factory=Counter)
    loss: Loss = field(default_factory=Loss)
    publishers: list[str] = field(default_factory=list)
    subscribers: list[str] = field(default_factory=list)
    wrong_types: dict[str, int] = field(default_factory=dict)  # refused, by subscriber

    @property
    def is_interleaved(self) -> bool:
        """Whether sequence numbers run as only those of several publishers do."""
        return self.loss.steps_back >= _STEPS_BACK_OF_TWO

    @property
    def lost(self) -> int | None:
        """Missing messages; None when the numbers do not tell."""
        return self.loss.lost if self.loss.is_known and not self.is_interleaved else None

    @property
    def is_for_all(self) -> bool:
        """Whether the channel is made for many publishers."""
        return STATUS_TYPE in self.types


class Traffic:
    """Takes messages in, answers who speaks what."""

    def __init__(self, layout: Layout) -> None:
        self.decoder = Decoder(layout)
        from deixis_lcm import stamps

        self._stamps = stamps
        self._channels: dict[str, Channel] = {}
        self._statuses: dict[tuple[Any, ...], list[Any]] = {}  # first and last of each service
        self._first_us: int | None = None
        self._last_us = 0
        self.listened_s: float | None = None  # None: of a log

    def take(self, arrival: Arrival) -> None:
        """One message."""
        self._first_us = arrival.time_us if self._first_us is None else self._first_us
        self._last_us = max(self._last_us, arrival.time_us)
        channel = self._channel(arrival.channel)
        channel.messages += 1
        channel.bytes += len(arrival.data)
        message = self.decoder.decode(arrival)
        if message is None:
            return
        channel.types[message.type_name] += 1
        stamp = self._stamps.stamp_of(message.content)
        channel.loss.add(stamp.sequence, stamp.publisher)
        if message.type_name == STATUS_TYPE:
            self._hear(message.content)

    @property
    def seconds(self) -> float:
        """How long was listened; of a log: from the first message to the last."""
        if self.listened_s is not None:
            return self.listened_s
        return 0.0 if self._first_us is None else (self._last_us - self._first_us) / 1e6

    def statuses(self) -> list[tuple[Any, Any]]:
        """First and last service_status_t of every service that has not said that it stops."""
        return [(first, last) for first, last in self._statuses.values()
                if last.state != last.STOPPING]

    def channels(self) -> list[Channel]:
        """All, by name: those that were heard, and those that services know of."""
        for channel in self._channels.values():
            channel.publishers, channel.subscribers, channel.wrong_types = [], [], {}
        for _, status in self.statuses():
            for known in status.channels:
                self._note(self._channel(printable(known.name)), known, self.name_of(status))
        return sorted(self._channels.values(), key=lambda channel: channel.name)

    def name_of(self, status: Any) -> str:
        """The service's name; with host and pid when there are two of it."""
        name = printable(f"{status.service}/{status.instance}".removesuffix("/"))
        alike = [other for _, other in self.statuses()
                 if (other.service, other.instance) == (status.service, status.instance)]
        return name if len(alike) < 2 else f"{name} (pid {status.pid} on {printable(status.host)})"

    def _hear(self, status: Any) -> None:
        speaker = self._stamps.speaker_of(status)
        if speaker in self._statuses:
            self._statuses[speaker][1] = status
        elif len(self._statuses) < _MOST_SERVICES:
            self._statuses[speaker] = [status, status]

    def _channel(self, name: str) -> Channel:
        return self._channels.setdefault(name, Channel(name))

    @staticmethod
    def _note(channel: Channel, known: Any, service: str) -> None:
        if known.direction == known.OUT:
            channel.publishers.append(service)
            return
        channel.subscribers.append(service)
        wrong = sum(drop.count for drop in known.drops if drop.reason == "wrong_type")
        if wrong:
            channel.wrong_types[service] = wrong


def listen(messages: Source, traffic: Traffic) -> Senders:
    """Takes all in, or as much as came until Ctrl-C; returns who sent, where that can be told."""
    with ExitStack() as stack:
        senders = Senders()
        if messages.url and messages.url.provider == "udpm":
            senders = stack.enter_context(SenderWatch(messages.url)).senders
        began = time.monotonic()
        with suppress(KeyboardInterrupt):
            for arrival in messages:
                if arrival is not None:
                    traffic.take(arrival)
        traffic.listened_s = time.monotonic() - began if messages.url else None
    return senders
