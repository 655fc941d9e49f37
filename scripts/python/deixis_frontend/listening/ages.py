"""How old messages are when they arrive: arrival minus capture time."""

from __future__ import annotations

import itertools
from collections import deque

OLDEST_S = 10.0  # what is older was not taken now, or by another clock
KEPT = 100_000  # ages that the percentile of a long run is taken of
HEADER = ("channel", "min ms", "mean ms", "p99 ms", "max ms", "messages")


class ChannelAge:
    """The ages on one channel: all of them, and those within the window."""

    def __init__(self, channel: str, window_s: float) -> None:
        self.channel = channel
        self._window_us = window_s * 1e6
        self._kept: deque[tuple[int, int]] = deque(maxlen=KEPT)  # arrival, age
        self._messages = self._not_of_this_clock = 0
        self._least_us = self._most_us = self._sum_us = 0

    def add(self, time_us: int, utime: int) -> None:
        """One message: its arrival and the capture time that it carries, microseconds."""
        age_us = time_us - utime
        self._least_us = min(self._least_us, age_us) if self._messages else age_us
        self._most_us = max(self._most_us, age_us) if self._messages else age_us
        self._sum_us += age_us
        self._messages += 1
        self._not_of_this_clock += not 0 <= age_us <= OLDEST_S * 1e6
        self._kept.append((time_us, age_us))

    def recent_row(self, now_us: int) -> tuple[str, ...]:
        """Of the window, which ends now."""
        begin_us = now_us - self._window_us
        recent = itertools.takewhile(lambda kept: kept[0] >= begin_us, reversed(self._kept))
        ages_us = sorted(age for _, age in recent)
        if not ages_us:
            return (self.channel, "-", "-", "-", "-", str(self._messages))
        return self._row(ages_us[0], sum(ages_us) / len(ages_us), ages_us, ages_us[-1])

    def whole_row(self) -> tuple[str, ...]:
        """Of all that came; the percentile, of the last hundred thousand."""
        kept_us = sorted(age for _, age in self._kept)
        return self._row(self._least_us, self._sum_us / self._messages, kept_us, self._most_us)

    def notes(self) -> list[str]:
        """Whether the ages are some."""
        if not self._not_of_this_clock:
            return []
        share = ("no stamp is" if self._not_of_this_clock == self._messages else
                 f"{self._not_of_this_clock} of {self._messages} stamps are not")
        return [f"{self.channel}: {share} of this clock (in the future, or older than"
                f" {OLDEST_S:.0f} s): a replayed log, or a host whose clock differs"]

    def _row(self, least_us: int, mean_us: float, sorted_us: list[int],
             most_us: int) -> tuple[str, ...]:
        p99_us = sorted_us[min(len(sorted_us) - 1, len(sorted_us) * 99 // 100)]
        shown = (least_us, mean_us, p99_us, most_us)
        return (self.channel, *(f"{age / 1e3:.2f}" for age in shown), str(self._messages))
