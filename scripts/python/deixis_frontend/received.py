"""What comes from the bus: anyone may send anything there, and no command may stumble over it."""

from __future__ import annotations

import math
import struct
import sys
from typing import Any


class Decoder:
    """Turns what comes on a channel into messages of one type."""

    def __init__(self, message_type: Any, channel: str) -> None:
        from deixis_lcm.logs import decode

        self._types = {message_type._get_packed_fingerprint(): message_type}
        self._decode = decode
        self._channel = channel
        self.refused = 0

    def __call__(self, data: bytes) -> Any | None:
        """The message; None for bytes that are none, which is counted, and said once."""
        try:
            message = self._decode(data, self._types)
            if isinstance(message, bytes):
                return self._refuse("of another type")
            # The generated code takes negative lengths, and texts that end too early.
            if message.encode() != data:
                return self._refuse("its lengths or texts are no honest ones")
        except (ValueError, IndexError, struct.error) as error:
            return self._refuse(str(error))
        return message

    def _refuse(self, why: str) -> None:
        self.refused += 1
        if self.refused == 1:
            print(f"a message on {self._channel} does not decode: {why}", file=sys.stderr)


def printable(text: str) -> str:
    """Text without what would steer a terminal."""
    return "".join(character if character.isprintable() else "?" for character in text)


def finite(value: float) -> float:
    """The number; 0 for one that is not finite, which JSON does not know."""
    return value if math.isfinite(value) else 0.0
