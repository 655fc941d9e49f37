"""Decodes what arrives; counts, and says once, what cannot be."""

from __future__ import annotations

import sys
from collections import Counter
from dataclasses import dataclass
from typing import Any

from deixis_frontend.layout import Layout
from deixis_frontend.listening.source import MOST_CHANNELS, OTHER_CHANNELS, Arrival

_MOST_SAID = 20  # lines on kinds of messages that do not decode
_MOST_WORDS = 20  # kinds of them in a summary


@dataclass(frozen=True)
class Message:
    """A decoded message and the name of its type (package.struct)."""

    type_name: str
    content: Any


class Decoder:
    """Turns bytes into messages of the generated types; needs no knowledge of the channel."""

    def __init__(self, layout: Layout) -> None:
        layout.use_types()
        from deixis_lcm import decoding

        self._decoding = decoding
        self._types = decoding.types_by_fingerprint()
        self.unknown: Counter[tuple[str, str]] = Counter()  # channel, fingerprint in hex
        self.damaged: Counter[tuple[str, str]] = Counter()  # channel, reason

    def decode(self, arrival: Arrival) -> Message | None:
        """The message; None when its type is not known or it does not fit its type."""
        try:
            content = self._decoding.decode(arrival.data, self._types)
        except self._decoding.DecodeError as error:
            self._count_damaged(arrival.channel, error.reason, str(error))
            return None
        if content is None:
            self._count_unknown(arrival)
            return None
        return Message(self._decoding.type_name(type(content)), content)

    def words(self) -> str:
        """What was not decoded, for a summary; empty when nothing was."""
        parts = [f"{count} of unknown type on {channel}" for (channel, _), count in
                 self.unknown.items()]
        parts += [f"{count} damaged on {channel} ({reason})" for (channel, reason), count in
                  self.damaged.items()]
        more = [f"and {len(parts) - _MOST_WORDS} kinds more"] if len(parts) > _MOST_WORDS else []
        return ", ".join([*parts[:_MOST_WORDS], *more])

    def damaged_on(self, channel: str) -> int:
        """How many messages of a channel did not fit their type."""
        return sum(count for (name, _), count in self.damaged.items() if name == channel)

    def _count_unknown(self, arrival: Arrival) -> None:
        size = len(arrival.data)
        if size < self._decoding.FINGERPRINT_BYTES:
            self._count_damaged(arrival.channel, "truncated", f"{size} bytes are no message")
            return
        fingerprint = arrival.data[:self._decoding.FINGERPRINT_BYTES].hex()
        self._count(self.unknown, (arrival.channel, fingerprint),
                    f"{arrival.channel}: type not known: fingerprint {fingerprint}, {size} bytes")

    def _count_damaged(self, channel: str, reason: str, text: str) -> None:
        self._count(self.damaged, (channel, reason), f"{channel}: {text}")

    @staticmethod
    def _count(counts: Counter[tuple[str, str]], kind: tuple[str, str], text: str) -> None:
        """Says the first of a kind. Noise has no end of kinds: only so many are told apart."""
        if kind not in counts and len(counts) >= MOST_CHANNELS:
            kind = (OTHER_CHANNELS, "other")
        counts[kind] += 1
        if counts[kind] == 1 and len(counts) <= _MOST_SAID:
            print(f"deixis: {text}", file=sys.stderr, flush=True)
