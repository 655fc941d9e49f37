"""Says what is pointed at as it comes, and at the end how much of it was right."""

from __future__ import annotations

import math
import statistics
import struct
from typing import Any

from deixis_frontend.demo.clip import Clip, Label
from deixis_frontend.printable import printable
from deixis_frontend.received import ChannelDecoder

_LATE_S = 0.5  # a gesture may be named until so long after its end
_UTIME_END = 16  # bytes of a message up to there
_WARM_UP = 90  # pictures whose distances in time give the period
_SIDES = ("", ", left hand", ", right hand")


class Commentary:
    """Takes the bytes of messages with pictures, and of GESTURES."""

    def __init__(self, clip: Clip, gesture_type: Any, seconds: float | None = None) -> None:
        """With `seconds`, what lies beyond so much of the clip is passed over."""
        self._clip = clip
        self._limit_s = seconds or math.inf
        self._decode = ChannelDecoder(gesture_type, "GESTURES")
        self._picture_times: list[int] = []
        self._last_picture = 0
        self._events: dict[int, Any] = {}
        self.is_over = False  # the seconds that were asked for have been played

    @property
    def played_s(self) -> float:
        """Seconds of the clip so far."""
        return (self._last_picture - self._picture_times[0]) / 1e6 if self._picture_times else 0.0

    @property
    def count(self) -> int:
        """Gestures so far."""
        return len(self._events)

    def see_picture(self, data: bytes) -> None:
        """Notes the time of a message with a picture: the field after the fingerprint."""
        if len(data) < _UTIME_END:
            return
        (utime,) = struct.unpack_from(">q", data, 8)
        if self._clip_time(utime) > self._limit_s:
            self.is_over = True
            return
        self._last_picture = utime
        if len(self._picture_times) < _WARM_UP:
            self._picture_times.append(utime)

    def hear_gesture(self, data: bytes) -> None:
        """Prints a GESTURES message, unless it only tells the end of one that was printed."""
        event = self._decode(data)
        if event is None:
            return
        is_news = event.event_id not in self._events
        if is_news and self._clip_time(event.utime) <= self._limit_s:
            self._events[event.event_id] = event
            print(f"{self._clip_time(event.utime):7.1f} s  {printable(describe(event))}", flush=True)

    def verdict(self) -> str:
        """How many of the gestures that were played were named right."""
        right = [label for label in self._clip.labels if self._is_named(label)]
        played = [label for label in self._clip.labels
                  if label in right or self._was_played(label)]
        if not self._clip.labels:
            return f"{self.count} gestures recognised; the clip comes without labels"
        return (f"{len(right)} of {len(played)} pointing gestures were named right"
                f" ({self.count} gestures recognised in {self.played_s:.0f} s)")

    def _clip_time(self, utime: int) -> float:
        return (utime - self._picture_times[0]) / 1e6 if self._picture_times else 0.0

    def _frame_time(self, frame: int) -> float:
        pairs = zip(self._picture_times, self._picture_times[1:], strict=False)
        return frame * statistics.median([later - earlier for earlier, later in pairs]) / 1e6

    def _was_played(self, label: Label) -> bool:
        """True when the clip was not cut off before the gesture could be named."""
        late_s = _LATE_S if self.is_over else 0.0
        return (len(self._picture_times) > 1
                and self._frame_time(label.end_frame) + late_s <= self.played_s)

    def _is_named(self, label: Label) -> bool:
        if len(self._picture_times) < 2:
            return False
        begin = self._frame_time(label.start_frame)
        end = self._frame_time(label.end_frame) + _LATE_S
        return any(begin <= self._clip_time(event.utime) <= end
                   and event.object_label == label.object_label
                   for event in self._events.values())


def describe(event: Any) -> str:
    """A gesture_t in words."""
    side = _SIDES[event.side] if 0 <= event.side < len(_SIDES) else ""
    best = [f"{candidate.label} ({candidate.probability:.0%})" for candidate in event.candidates]
    if event.outcome == event.OBJECT:
        sure = next((c.probability for c in event.candidates if c.object_id == event.object_id), 1)
        return f"{event.name}: {event.object_label} ({sure:.0%}){side}"
    if event.outcome == event.AMBIGUOUS:
        return f"{event.name}: {' or '.join(best[:3])}{side}"
    return f"{event.name}: nothing that is known{side}"
