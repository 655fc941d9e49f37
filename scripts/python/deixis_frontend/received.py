"""What comes from the bus: anyone may send anything there, and no command may stumble over it."""

from __future__ import annotations

import math
import sys
from collections.abc import Callable
from typing import Any


def _to_stderr(text: str) -> None:
    print(text, file=sys.stderr)


class ChannelDecoder:
    """Turns what comes on a channel into messages of one type."""

    def __init__(self, message_type: Any, channel: str,
                 say: Callable[[str], None] = _to_stderr) -> None:
        from deixis_lcm import decoding

        self._type = message_type
        self._decoding = decoding
        self._channel = channel
        self._say = say
        self.refused = 0

    def __call__(self, data: bytes) -> Any | None:
        """The message; None for bytes that are none, which is counted, and said once."""
        try:
            return self._decoding.decode_as(self._type, data)
        except self._decoding.DecodeError as error:
            self.refused += 1
            if self.refused == 1:
                self._say(f"{self._channel}: {error}")
        return None


def finite(value: float) -> float:
    """The number; 0 for one that is not finite, which JSON does not know."""
    return value if math.isfinite(value) else 0.0
