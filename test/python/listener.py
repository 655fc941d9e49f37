"""Hears what programs say on a bus."""

from __future__ import annotations

from typing import Any

import lcm
from bench import becomes_true


class Listener:
    """What is said on some channels of a bus."""

    def __init__(self, url: str, **types: Any) -> None:
        self._bus = lcm.LCM(url)
        self.heard: dict[str, list[Any]] = {channel: [] for channel in types}
        for channel, message_type in types.items():
            self._bus.subscribe(channel, lambda name, data, decode=message_type.decode:
                                self.heard[name].append(decode(data)))

    def hears(self, channel: str, count: int, seconds: float = 20.0) -> bool:
        """True as soon as `count` more messages have come."""
        wanted = len(self.heard[channel]) + count

        def has_come() -> bool:
            self._bus.handle_timeout(50)
            return len(self.heard[channel]) >= wanted

        return becomes_true(has_come, seconds)
