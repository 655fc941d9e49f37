"""When a service comes back, after how long, and when it is given up."""

from __future__ import annotations

import pytest

from deixis_frontend.supervision.restart_policy import STABLE_AFTER_S, Ending, RestartPolicy

CRASH = Ending(-9, was_ready=True, ready_for_s=0.5)
FAILED_START = Ending(1, was_ready=False)
CLEAN_END = Ending(0, was_ready=True, ready_for_s=5.0)


def delays(policy: RestartPolicy, *endings: Ending) -> list[float | None]:
    return [policy.decide(ending).delay_s for ending in endings]


def test_a_service_that_has_worked_comes_back_for_ever_and_soon() -> None:
    waits = delays(RestartPolicy("on_failure", 3), *[CRASH] * 100)
    assert waits[:4] == pytest.approx([0.2, 0.4, 0.8, 1.0])
    assert max(wait for wait in waits if wait is not None) <= 1.0 and None not in waits


def test_a_service_that_was_stable_comes_back_at_once_again() -> None:
    stable = Ending(-11, was_ready=True, ready_for_s=STABLE_AFTER_S)
    assert delays(RestartPolicy("always", 3), CRASH, CRASH, stable) == [0.2, 0.4, 0.2]


def test_a_service_that_never_gets_ready_is_given_up() -> None:
    assert delays(RestartPolicy("always", 3), *[FAILED_START] * 3) == [0.2, 0.4, None]


def test_getting_ready_makes_failed_starts_count_anew() -> None:
    policy = RestartPolicy("always", 2)
    assert None not in delays(policy, FAILED_START, CRASH, FAILED_START)


def test_wrong_usage_is_given_up_at_once() -> None:
    assert delays(RestartPolicy("always", 3), Ending(2, was_ready=False)) == [None]


def test_a_clean_end_brings_back_only_what_should_always_run() -> None:
    assert delays(RestartPolicy("always", 3), CLEAN_END) == [0.2]
    verdict = RestartPolicy("on_failure", 3).decide(CLEAN_END)
    assert verdict.delay_s is None and not verdict.has_failed


def test_one_that_ends_cleanly_before_it_is_ready_does_not_loop() -> None:
    assert delays(RestartPolicy("always", 2), *[Ending(0, False)] * 2) == [0.2, None]


def test_never_means_never() -> None:
    verdict = RestartPolicy("never", 3).decide(CRASH)
    assert verdict.delay_s is None and verdict.has_failed
