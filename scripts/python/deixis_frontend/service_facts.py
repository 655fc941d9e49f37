"""What a service_status_t says, as plain values."""

from __future__ import annotations

import math
from typing import Any

from deixis_frontend.printable import printable
from deixis_frontend.received import finite

CHANNEL = "SERVICE_STATUS"  # behind any prefix
_STATES = ("starting", "running", "degraded", "stopping")  # by their numbers in service_status_t


def state_name(number: int) -> str:
    """The state in a word; "state 9" for one that is not known."""
    return _STATES[number] if 0 <= number < len(_STATES) else f"state {number}"


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
