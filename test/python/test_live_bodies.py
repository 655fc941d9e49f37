"""`evaluate live --bodies`: a camera that waits for nobody, and how old bodies are when they arrive."""

from __future__ import annotations

import itertools
import time
from typing import Any

import pytest
from deixis import body_pose_t, body_poses_t, limb_pose_t

from deixis_frontend.evaluation import live_camera
from deixis_frontend.evaluation.live_arrivals import Arrival, Arrivals, body_report, print_bodies


class Pair:
    """As images_t, as far as a camera touches it."""

    def __init__(self, number: int) -> None:
        self.number, self.utime, self.images = number, 0, [self, self]

    def encode(self) -> tuple[int, int]:
        """Which it is, and when it was taken."""
        return self.number, self.utime


def poses(utime: int, *bodies: body_pose_t) -> bytes:
    message = body_poses_t()
    message.utime, message.bodies, message.n_bodies = utime, list(bodies), len(bodies)
    message.floor_plane = [0.0] * 4
    return message.encode()


def body(person_id: int, state: int = body_pose_t.TRACKED, measured: int = 1, limbs: int = 2) -> body_pose_t:
    message = body_pose_t()
    message.person_id, message.state = person_id, state
    message.limbs = [limb_pose_t() for _ in range(limbs)]
    for number, limb in enumerate(message.limbs):
        limb.state = limb_pose_t.MEASURED if number < measured else limb_pose_t.HIDDEN
    message.n_limbs = limbs
    return message


def arrivals(*ages_ms: float) -> Arrivals:
    """Bodies 100 ms apart, whose depth was there 20 ms after it was taken."""
    times = [100_000 * number for number in range(len(ages_ms))]
    return Arrivals([Arrival(utime, 20.0) for utime in times],
                    [Arrival(utime, age, poses(utime, body(7))) for utime, age in zip(times, ages_ms)])


def test_a_recording_is_played_to_and_fro() -> None:
    assert list(itertools.islice(live_camera.to_and_fro(4), 9)) == [0, 1, 2, 3, 2, 1, 0, 1, 2]


class Enough(Exception):
    """Ends what would go on for ever."""


def sent(stall_at: int | None = None) -> list[tuple[int, int]]:
    """What a camera of 100 Hz sends, that is held up once for 45 ms."""
    heard: list[tuple[int, int]] = []

    def publish(pair: tuple[int, int]) -> None:
        heard.append(pair)
        if len(heard) == 8:
            raise Enough
        if len(heard) == stall_at:
            time.sleep(0.045)

    with pytest.raises(Enough):
        live_camera.send([Pair(number) for number in range(50)], publish, 100.0)
    return heard


def test_a_camera_keeps_its_rate_and_says_when_pairs_were_taken() -> None:
    heard = sent()
    assert [after[1] - before[1] for before, after in itertools.pairwise(heard)] == pytest.approx(
        [10_000 * (after[0] - before[0]) for before, after in itertools.pairwise(heard)], abs=2)


def test_a_camera_waits_for_nobody() -> None:
    numbers = [number for number, _ in sent(stall_at=3)]
    assert max(after - before for before, after in itertools.pairwise(numbers)) >= 3
    assert sorted(set(numbers)) == numbers


def test_ages_are_those_at_arrival() -> None:
    noted = Arrivals()
    now = time.time_ns() // 1000
    noted.note_bodies(poses(now - 250_000))
    noted.note_depth(poses(now - 40_000))
    noted.note_depth(b"short")
    assert 250.0 <= noted.bodies[0].age_ms < 350.0
    assert [40.0 <= arrival.age_ms < 140.0 for arrival in noted.depth] == [True]


@pytest.mark.parametrize(("ages", "is_met"), [([30.0] * 10, True), ([30.0] * 9 + [90.0], False)])
def test_the_goal_is_the_99th_percentile(ages: list[float], is_met: bool,
                                         capsys: pytest.CaptureFixture[str]) -> None:
    report = body_report(arrivals(*ages), 12)
    assert (report["goal_is_met"], report["passed_over"], report["age_ms"]["max"]) == (is_met, 2, max(ages))
    print_bodies(report)
    said = capsys.readouterr().out
    assert ("60 ms: met" in said, "60 ms: not met" in said) == (is_met, not is_met)
    assert "2 of 12 pictures were passed over" in said


def test_the_oldest_bodies_say_what_was_new_then() -> None:
    noted = arrivals(30.0, 80.0, 40.0)
    noted.bodies[1] = Arrival(100_000, 80.0, poses(100_000, body(7), body(8)))
    oldest: dict[str, Any] = body_report(noted, 3)["oldest"][0]
    assert oldest == {"at_s": 0.1, "age_ms": 80.0, "depth_age_ms": 20.0, "people": 2, "new_people": 1}


def test_a_body_that_is_lost_is_not_followed() -> None:
    noted = Arrivals([], [Arrival(0, 1.0, poses(0, body(1, body_pose_t.LOST))), Arrival(1, 1.0, poses(1)),
                          Arrival(2, 1.0, poses(2, body(1, measured=2))), Arrival(3, 1.0, poses(3, body(1)))])
    report = body_report(noted, 4)
    assert (report["with_body_share"], report["limbs_measured_mean"]) == (0.5, 1.5)


def test_nothing_that_arrives_is_no_goal_met() -> None:
    report = body_report(Arrivals(), 30)
    assert (report["goal_is_met"], report["age_ms"], report["passed_over"]) == (False, None, 30)
    print_bodies(report)
