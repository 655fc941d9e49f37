"""Hears SERVICE_STATUS on the bus, on the event loop of the supervisor."""

from __future__ import annotations

import asyncio
import math
import re
from collections.abc import Callable
from typing import Any

from deixis_frontend.bus import open_bus
from deixis_frontend.layout import Layout
from deixis_frontend.lcm_url import LcmUrl
from deixis_frontend.printable import printable
from deixis_frontend.received import Decoder, finite
from deixis_frontend.supervision.own_log import say

CHANNEL = "SERVICE_STATUS"
_MOST_PER_TURN = 100
STATES = ("starting", "running", "degraded", "stopping")


class StatusListener:
    """Calls `on_status` with every service_status_t that decodes."""

    def __init__(self, url: LcmUrl, prefix: str, layout: Layout,
                 on_status: Callable[[Any], None]) -> None:
        layout.use_types()
        from deixis import service_status_t

        self._decode = Decoder(service_status_t, CHANNEL, say)
        self._on_status = on_status
        self._bus = open_bus(url)
        self._bus.subscribe(re.escape(prefix + CHANNEL), self._handle)

    def attach(self, loop: asyncio.AbstractEventLoop) -> None:
        """Handles messages whenever the bus has some."""
        loop.add_reader(self._bus.fileno(), self._spin)

    def _spin(self) -> None:
        """A peer that floods must not keep the loop from its other work: it calls again."""
        for _ in range(_MOST_PER_TURN):
            if self._bus.handle_timeout(0) <= 0:
                return

    def _handle(self, _channel: str, data: bytes) -> None:
        message = self._decode(data)
        if message is not None:
            self._on_status(message)


def as_facts(message: Any) -> dict[str, Any]:
    """A service_status_t as plain values for JSON; -1 becomes None where it means unknown."""
    return {
        "version": printable(message.version),
        "text": printable(message.text),
        "channels": [_channel(channel) for channel in message.channels],
        "processing_ms": _percentiles(message.processing_ms_p50, message.processing_ms_p99),
        "age_ms": _percentiles(message.age_ms_p50, message.age_ms_p99),
        "receive_buffer_bytes": message.receive_buffer_bytes,
    }


def _channel(channel: Any) -> dict[str, Any]:
    return {
        "name": printable(channel.name),
        "direction": "out" if channel.direction == channel.OUT else "in",
        "messages": channel.messages,
        "rate_hz": finite(channel.rate_hz),
        "gaps": channel.gaps,
        "skipped": channel.skipped,
        "drops": {printable(drop.reason): drop.count for drop in channel.drops},
    }


def _percentiles(p50: float, p99: float) -> dict[str, float | None]:
    return {"p50": p50 if 0 <= p50 < math.inf else None,
            "p99": p99 if 0 <= p99 < math.inf else None}
