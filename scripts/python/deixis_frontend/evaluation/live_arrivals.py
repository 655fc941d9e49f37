"""When depth and bodies arrive: how old they are then, and what made the oldest ones so old."""

from __future__ import annotations

import struct
import time
from dataclasses import dataclass, field
from typing import Any

import numpy as np

GOAL_P99_MS = 60.0
_UTIME_END = 16  # bytes of a message up to the end of its capture time, which follows the fingerprint
_SHOWN = 10  # oldest bodies in the report
_QUEUE = 1000


@dataclass(frozen=True)
class Arrival:
    """A message as it came: its capture time and how much later that was, and the message."""

    utime: int
    age_ms: float
    data: bytes = b""


@dataclass
class Arrivals:
    """Notes STEREO and BODY_POSES as they come; what is in them is read later, so that it delays none."""

    depth: list[Arrival] = field(default_factory=list)
    bodies: list[Arrival] = field(default_factory=list)

    def listen(self, bus: Any) -> None:
        """Subscribes on a bus that somebody else handles."""
        for channel, note in (("STEREO", self.note_depth), ("BODY_POSES", self.note_bodies)):
            bus.subscribe(channel, lambda _, data, note=note: note(data)).set_queue_capacity(_QUEUE)

    def note_depth(self, data: bytes) -> None:
        """Keeps the times of a STEREO message."""
        if len(data) >= _UTIME_END:
            self.depth.append(_arrival(data))

    def note_bodies(self, data: bytes) -> None:
        """Keeps a BODY_POSES message with its times."""
        if len(data) >= _UTIME_END:
            self.bodies.append(_arrival(data, data))


def _arrival(data: bytes, kept: bytes = b"") -> Arrival:
    now = time.time_ns() // 1000
    (utime,) = struct.unpack_from(">q", data, 8)
    return Arrival(utime, (now - utime) / 1e3, kept)


def body_report(arrivals: Arrivals, wanted: int) -> dict[str, Any]:
    """Of `wanted` pictures: how many were passed over, ages at arrival, how many people were found how well, and the oldest bodies with what is known of them."""
    from deixis import body_pose_t, body_poses_t, limb_pose_t

    poses = [body_poses_t.decode(arrival.data) for arrival in arrivals.bodies]
    tracked = [[body for body in pose.bodies if body.state == body_pose_t.TRACKED] for pose in poses]
    measured = [sum(limb.state == limb_pose_t.MEASURED for limb in body.limbs) for bodies in tracked for body in bodies]
    ages = _ages(arrivals.bodies)
    return {"depth_age_ms": _ages(arrivals.depth), "age_ms": ages, "goal_p99_ms": GOAL_P99_MS,
            "pictures_wanted": wanted, "passed_over": max(0, wanted - len(poses)),
            "goal_is_met": ages is not None and ages["p99"] <= GOAL_P99_MS,
            "with_body_share": float(np.mean([bool(bodies) for bodies in tracked])) if poses else 0.0,
            "limbs_measured_mean": float(np.mean(measured)) if measured else None,
            "oldest": _oldest(arrivals, poses)}


def _ages(arrivals: list[Arrival]) -> dict[str, float] | None:
    if not arrivals:
        return None
    ages = np.array([arrival.age_ms for arrival in arrivals])
    return {"count": len(ages), "p50": float(np.percentile(ages, 50)), "p90": float(np.percentile(ages, 90)),
            "p99": float(np.percentile(ages, 99)), "max": float(ages.max())}


def _oldest(arrivals: Arrivals, poses: list[Any]) -> list[dict[str, Any]]:
    """By age: when, how much of it the depth had already, how many people, and who came or went then."""
    if not poses:
        return []
    depth = {arrival.utime: arrival.age_ms for arrival in arrivals.depth}
    begin = min(arrival.utime for arrival in (*arrivals.depth, *arrivals.bodies))
    ids = [{body.person_id for body in pose.bodies} for pose in poses]
    news = _news(ids)
    order = sorted(range(len(poses)), key=lambda number: -arrivals.bodies[number].age_ms)[:_SHOWN]
    return [{"at_s": (arrivals.bodies[n].utime - begin) / 1e6, "age_ms": arrivals.bodies[n].age_ms,
             "depth_age_ms": depth.get(arrivals.bodies[n].utime), "people": len(ids[n]),
             "new_people": news[n]} for n in order]


def _news(ids: list[set[int]]) -> list[int]:
    """How many of each were in none before."""
    known: set[int] = set()
    news = []
    for some in ids:
        news.append(len(some - known))
        known |= some
    return news


def print_bodies(report: dict[str, Any]) -> None:
    """A table of ages, and the oldest bodies."""
    print(f"\n{'age at arrival, ms':<20}{'count':>8}{'p50':>8}{'p90':>8}{'p99':>8}{'max':>8}")
    for name, ages in (("STEREO", report["depth_age_ms"]), ("BODY_POSES", report["age_ms"])):
        if ages:
            print(f"{name:<20}{ages['count']:>8}" + "".join(f"{ages[key]:>8.1f}" for key in ("p50", "p90", "p99", "max")))
    print(f"{report['passed_over']} of {report['pictures_wanted']} pictures were passed over")
    print(f"goal: p99 of BODY_POSES <= {report['goal_p99_ms']:g} ms: {'met' if report['goal_is_met'] else 'not met'};"
          f" somebody is followed in {report['with_body_share']:.0%} of them"
          + (f", {report['limbs_measured_mean']:.1f} limbs of each measured" if report["limbs_measured_mean"] else ""))
    for row in report["oldest"]:
        depth = "-" if row["depth_age_ms"] is None else f"{row['depth_age_ms']:.0f}"
        print(f"  at {row['at_s']:6.1f} s: {row['age_ms']:6.1f} ms, {depth} of them before the fit;"
              f" {row['people']} people, {row['new_people']} of them new")
