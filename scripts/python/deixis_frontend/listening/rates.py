"""How regularly messages come: intervals, loss by sequence numbers, bytes."""

from __future__ import annotations

import math
from collections import deque
from dataclasses import dataclass, field

LARGEST_GAP = 100_000  # a larger step is a publisher that counts otherwise; as in publisher_sequences.cpp
MOST_PUBLISHERS = 200  # of a channel, whose numbers are known: noise is not to fill the memory
HEADER = ("channel", "Hz", "mean ms", "min ms", "max ms", "jitter ms", "lost", "longest gap ms",
          "kB/s", "messages")


@dataclass
class Intervals:
    """Statistics of the times between messages, microseconds."""

    count: int = 0
    mean_us: float = 0.0
    shortest_us: int = 0
    longest_us: int = 0
    _squares: float = 0.0

    def add(self, interval_us: int) -> None:
        """One more; Welford's recurrence."""
        self.count += 1
        self.shortest_us = interval_us if self.count == 1 else min(self.shortest_us, interval_us)
        self.longest_us = max(self.longest_us, interval_us)
        before = interval_us - self.mean_us
        self.mean_us += before / self.count
        self._squares += before * (interval_us - self.mean_us)

    @property
    def deviation_us(self) -> float:
        """Standard deviation."""
        return math.sqrt(self._squares / self.count) if self.count else 0.0


@dataclass
class Loss:
    """Messages that are missing by their sequence numbers; each publisher counts its own."""

    lost: int = 0
    steps_back: int = 0  # a publisher that began anew, or two of them on one channel
    is_known: bool = False
    _last: dict[str, int] = field(default_factory=dict)  # the latest heard at the end

    def add(self, sequence: int | None, publisher: str) -> None:
        """The number of the next message; None when it has none."""
        if sequence is None:
            return
        self.is_known = True
        step = sequence - self._last.pop(publisher, sequence - 1)
        if step <= 0:
            self.steps_back += 1
        elif step - 1 <= LARGEST_GAP:
            self.lost += step - 1
        self._last[publisher] = sequence
        if len(self._last) > MOST_PUBLISHERS:
            del self._last[next(iter(self._last))]


class ChannelRate:
    """What came on one channel: all of it, and what came within the window."""

    def __init__(self, channel: str, window_s: float) -> None:
        self.channel = channel
        self._window_us = window_s * 1e6
        self._recent: deque[tuple[int, int]] = deque()  # arrival, bytes
        self._all = Intervals()
        self._first_us = self._last_us = 0
        self._messages = self._bytes = self._first_bytes = 0
        self.loss = Loss()
        self.times_back = 0

    def add(self, time_us: int, size: int) -> None:
        """One message; `time_us` is its arrival. What `loss` is to know comes apart."""
        if not self._messages:
            self._first_us, self._first_bytes = time_us, size
        elif time_us < self._last_us:
            self.times_back += 1  # The clock was set back: that is no interval.
            self._recent.clear()
        else:
            self._all.add(time_us - self._last_us)
        self._last_us = time_us
        self._messages += 1
        self._bytes += size
        self._recent.append((time_us, size))
        self._forget_before(time_us - self._window_us)

    def recent_row(self, now_us: int) -> tuple[str, ...]:
        """Of the window, which ends now: what has stopped, shows."""
        self._forget_before(now_us - self._window_us)
        intervals = Intervals()
        times = [time_us for time_us, _ in self._recent]
        for earlier, later in zip(times, times[1:]):
            intervals.add(later - earlier)
        span_us = max(1, now_us - times[0]) if times else 0
        # The message that begins the span is not within it.
        size = sum(size for _, size in self._recent) - (self._recent[0][1] if times else 0)
        return self._row(intervals, span_us, size)

    def whole_row(self) -> tuple[str, ...]:
        """Of all that came, from the first message to the last."""
        span_us = round(self._all.mean_us * self._all.count)
        return self._row(self._all, span_us, self._bytes - self._first_bytes)

    def notes(self) -> list[str]:
        """What a table has no place for."""
        notes = []
        if self.loss.steps_back:
            notes.append(f"{self.loss.steps_back} sequence numbers went back: a publisher began"
                         " anew, or two share the channel (`deixis topics` tells)")
        if self.times_back:
            notes.append(f"the clock went back {self.times_back} times: these are no intervals")
        return [f"{self.channel}: {note}" for note in notes]

    def _forget_before(self, begin_us: float) -> None:
        while self._recent and self._recent[0][0] < begin_us:
            self._recent.popleft()

    def _row(self, intervals: Intervals, span_us: int, size: int) -> tuple[str, ...]:
        lost = str(self.loss.lost) if self.loss.is_known else "-"
        longest = _ms(self._all.longest_us) if self._all.count else "-"
        if not intervals.count or not span_us:
            rate, shown = "0.00" if self._messages > 1 else "-", ("-",) * 4
            return (self.channel, rate, *shown, lost, longest, "-", str(self._messages))
        shown = (_ms(intervals.mean_us), _ms(intervals.shortest_us), _ms(intervals.longest_us),
                 _ms(intervals.deviation_us))
        return (self.channel, f"{intervals.count / span_us * 1e6:.2f}", *shown, lost, longest,
                f"{size / span_us * 1e3:.1f}", str(self._messages))


def _ms(microseconds: float) -> str:
    return f"{microseconds / 1e3:.2f}"
