"""Hears SERVICE_STATUS on the bus, on the event loop of the supervisor."""

from __future__ import annotations

import asyncio
import re
from collections.abc import Callable
from typing import Any

from deixis_frontend.bus import open_bus
from deixis_frontend.layout import Layout
from deixis_frontend.lcm_url import LcmUrl
from deixis_frontend.received import ChannelDecoder
from deixis_frontend.service_facts import CHANNEL
from deixis_frontend.supervision.own_log import say

_MOST_PER_TURN = 100


class StatusListener:
    """Calls `on_status` with every service_status_t that decodes."""

    def __init__(self, url: LcmUrl, prefix: str, layout: Layout,
                 on_status: Callable[[Any], None]) -> None:
        layout.use_types()
        from deixis import service_status_t

        self._decode = ChannelDecoder(service_status_t, CHANNEL, say)
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
