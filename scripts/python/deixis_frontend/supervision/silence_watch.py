"""Which services hang: told by their silence, unless something else explains it."""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import dataclass

from deixis_frontend.supervision.supervised_service import SupervisedService

_FLOODED = ("the supervisor loses messages, more are sent than it can take: silent services are not"
            " restarted meanwhile; find who floods the bus")
_QUIET_AFTER_S = 1.5  # one that is well speaks every second
_SUSPENDED_AFTER_S = 3.0  # the watch is asked once a second


@dataclass(frozen=True)
class Judgement:
    """What follows from one look at all services."""

    hanging: tuple[SupervisedService, ...] = ()
    trouble: str = ""  # why all are silent, when that is no fault of theirs


class SilenceWatch:
    """Judges the services once a second."""

    def __init__(self, why_bus_fails: Callable[[], str | None], drops: Callable[[], int],
                 clock: Callable[[], float] = time.monotonic) -> None:
        self._why_bus_fails = why_bus_fails
        self._drops = drops
        self._dropped = 0
        self._clock = clock
        self._last = clock()

    def judge(self, services: list[SupervisedService]) -> Judgement:
        """The services that have been silent for longer than their entries allow.

        None when this process itself was suspended or has lost messages, since it has not heard
        all, and none when all services are silent at once or the bus does not carry a message:
        then it is the bus.
        """
        was_suspended, has_lost = self._was_suspended(), self._has_lost()
        if was_suspended or has_lost:
            for service in services:
                service.excuse_silence()
            return Judgement(trouble=_FLOODED if has_lost else "")
        silences = {s: silent for s in services if (silent := s.silent_s()) is not None}
        too_long = tuple(s for s, silent in silences.items()
                         if 0 < s.entry.restart_when_silent_s < silent)
        all_silent = all(silent > _QUIET_AFTER_S for silent in silences.values())
        if not too_long or not all_silent:
            return Judgement(too_long)
        return self._of_all_silent(too_long, len(silences))

    def _of_all_silent(self, too_long: tuple[SupervisedService, ...], count: int) -> Judgement:
        reason = self._why_bus_fails()
        if reason:
            return Judgement(trouble=f"no service is heard: {reason}")
        if count > 1:
            return Judgement(trouble=f"all {count} services are silent at once: none is killed;"
                                     " is the bus flooded, or are they all stopped?"
                                     " `deixis restart` starts them anew")
        return Judgement(too_long)

    def _has_lost(self) -> bool:
        before, self._dropped = self._dropped, self._drops()
        return self._dropped > before

    def _was_suspended(self) -> bool:
        now = self._clock()
        passed_s, self._last = now - self._last, now
        return passed_s > _SUSPENDED_AFTER_S
