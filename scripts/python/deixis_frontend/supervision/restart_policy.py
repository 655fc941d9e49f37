"""When a service that ended is started again."""

from __future__ import annotations

from dataclasses import dataclass

FIRST_DELAY_S = 0.2
LONGEST_CRASH_DELAY_S = 1.0  # a service that has worked is back within two seconds
LONGEST_START_DELAY_S = 5.0
STABLE_AFTER_S = 10.0  # a service that was ready for so long starts counting anew
WRONG_USAGE = 2  # exit code that no second try can cure


@dataclass(frozen=True)
class Ending:
    """How one run of a service ended; a negative exit code is a signal."""

    exit_code: int
    was_ready: bool
    ready_for_s: float = 0.0


@dataclass(frozen=True)
class Verdict:
    """What to do: start again after delay_s, or not at all (None)."""

    delay_s: float | None
    has_failed: bool


class RestartPolicy:
    """Starts a crashed service again for ever, but one that never gets ready a few times only.

    Most start-ups that fail do so for a wrong configuration or a missing device, which trying does
    not cure; a crash in the middle of work (a bad datagram, a bug) is cured by starting again.
    """

    def __init__(self, mode: str, give_up_after: int) -> None:
        self._mode = mode
        self._give_up_after = give_up_after
        self._failed_starts = 0
        self._crashes = 0

    def decide(self, ending: Ending) -> Verdict:
        """What follows from this ending."""
        if ending.exit_code == 0 and self._mode != "always":
            return Verdict(None, has_failed=False)
        if self._mode == "never":
            return Verdict(None, has_failed=True)
        if not ending.was_ready:
            return self._after_failed_start(ending)
        if ending.exit_code == 0:
            return Verdict(FIRST_DELAY_S, has_failed=False)
        return self._after_crash(ending)

    def _after_crash(self, ending: Ending) -> Verdict:
        self._failed_starts = 0
        self._crashes = 1 if ending.ready_for_s >= STABLE_AFTER_S else self._crashes + 1
        return Verdict(_delay(self._crashes, LONGEST_CRASH_DELAY_S), has_failed=True)

    def _after_failed_start(self, ending: Ending) -> Verdict:
        self._failed_starts += 1
        if ending.exit_code == WRONG_USAGE or self._failed_starts >= self._give_up_after:
            return Verdict(None, has_failed=True)
        return Verdict(_delay(self._failed_starts, LONGEST_START_DELAY_S), has_failed=True)


def _delay(count: int, longest_s: float) -> float:
    return min(FIRST_DELAY_S * 2.0 ** min(count - 1, 20), longest_s)
