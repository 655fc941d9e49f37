"""Counts fitted bodies as they come: people, what of them was measured, and how old it was."""

from __future__ import annotations

from collections import Counter
from typing import Any

import numpy as np

from deixis_frontend.received import ChannelDecoder


_MUCH_MS = 1000.0  # older bodies tell of a clip that is played late


class Bodies:
    """Takes the bytes of BODY_POSES messages."""

    def __init__(self, poses_type: Any) -> None:
        self._decode = ChannelDecoder(poses_type, "BODY_POSES")
        self._pictures = 0
        self._with_somebody = 0
        self._most_at_once = 0
        self._seen: Counter[int] = Counter()  # pictures in which each person was followed
        self._measured: Counter[int] = Counter()  # limbs of each that were measured, of all these pictures
        self._limbs: dict[int, int] = {}
        self._ages_ms: list[float] = []

    @property
    def count(self) -> int:
        """People who were followed, if only for a picture."""
        return len(self._seen)

    def hear(self, data: bytes, arrived_us: int | None = None) -> None:
        """Notes a message; with the wall clock at its arrival its age, too."""
        poses = self._decode(data)
        if poses is None:
            return
        if arrived_us is not None:
            self._ages_ms.append((arrived_us - poses.utime) / 1e3)
        tracked = [body for body in poses.bodies if body.state == body.TRACKED]
        self._pictures += 1
        self._with_somebody += bool(tracked)
        self._most_at_once = max(self._most_at_once, len(tracked))
        for body in tracked:
            self._seen[body.person_id] += 1
            self._measured[body.person_id] += sum(limb.state == limb.MEASURED for limb in body.limbs)
            self._limbs[body.person_id] = body.n_limbs

    def verdict(self) -> str:
        """People found, limbs measured of the one who was followed longest, and ages."""
        if not self._seen:
            return f"no body was fitted in {self._pictures} pictures with depth"
        person, pictures = self._seen.most_common(1)[0]
        people = "1 person" if self._most_at_once == 1 else f"up to {self._most_at_once} people at once"
        return (f"{people} found ({self.count} in all), somebody in {self._with_somebody / self._pictures:.0%} of"
                f" {self._pictures} pictures; person {person}: {self._measured[person] / pictures:.1f} of"
                f" {self._limbs[person]} limbs measured{self._ages()}")

    def _ages(self) -> str:
        if not self._ages_ms:
            return ""
        middle, high = np.percentile(self._ages_ms, [50, 99])
        slow = ": this machine is too slow to play the clip at its rate" if middle > _MUCH_MS else ""
        return f"; bodies were {middle:.0f} ms old when they came, 99 of 100 within {high:.0f} ms{slow}"
