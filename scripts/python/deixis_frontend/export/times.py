"""When messages were taken, in microseconds; each package of types says it in its own way."""

from __future__ import annotations

from typing import Any

import kinect
import tf2_msgs

_NANOSECONDS = 1_000_000_000  # of a second


def utime_of(message: Any) -> int:
    """The time of a message that can be converted; of transforms, the latest.

    ValueError if a std_msgs.Time is none.
    """
    if isinstance(message, kinect.frame_msg_t):
        return own_or(message.timestamp, message.image.timestamp)
    if isinstance(message, tf2_msgs.TFMessage):
        return max((of_header(part.header) for part in message.transforms), default=0)
    return of_header(message.header) if hasattr(message, "header") else int(message.utime)


def of_header(header: Any) -> int:
    """The stamp of a std_msgs.Header, to the microsecond below, as services take it.

    So pictures have the time of what services say of them. ValueError if it is none.
    """
    seconds, nanoseconds = header.stamp.sec, header.stamp.nsec
    if seconds < 0 or not 0 <= nanoseconds < _NANOSECONDS:
        raise ValueError(f"{seconds} s and {nanoseconds} ns are no time")
    return int(seconds * 1_000_000 + nanoseconds // 1000)


def own_or(own: int, other: int) -> int:
    """A time of kinect's, or another where it is not set."""
    return own if own != 0 else other
