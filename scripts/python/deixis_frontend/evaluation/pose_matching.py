"""Sets what was found beside the truth, frame by frame: who is whom, and how far off each joint is."""

from __future__ import annotations

from collections import Counter
from dataclasses import dataclass

import numpy as np

from deixis_frontend.evaluation.pose_results import BODY_LOST, FoundFrame, FoundPerson
from deixis_frontend.evaluation.pose_truth import TruePerson, TrueScene

WRONG_M = 0.15  # a joint that is farther off is wrong
_GATE_M = 0.6  # between a true pelvis and the root of who stands for the person
_FALSE_AFTER_S = 0.2  # who is nobody for this long in all is a false person
MISSED = -1  # state of a joint of a person who is not in the message


@dataclass
class JudgedPerson:
    """One true person and who stood for them: an entry per frame (F), joints (J) in the order of the truth's."""

    name: str
    fps: float
    true_m: np.ndarray  # F x J x 3
    is_visible: np.ndarray  # F x J
    found_m: np.ndarray  # F x J x 3, NaN where missed
    covariances_m2: np.ndarray  # F x J x 3 x 3, NaN where missed
    states: np.ndarray  # F x J, of limb_pose_t, or MISSED
    rotations: np.ndarray  # F x J x 3 x 3, frame_from_limb of each joint's limb; identity where missed
    ids: np.ndarray  # F, -1 = nobody
    is_said_lost: np.ndarray  # F: who stands for the person is, as the message says, not to be relied upon

    @property
    def errors_m(self) -> np.ndarray:
        """F x J distances; infinite where missed, NaN where there is no truth."""
        distances = np.linalg.norm(self.found_m - self.true_m, axis=2)
        is_missed = np.isnan(distances) & np.isfinite(self.true_m).all(axis=2)
        return np.where(is_missed, np.inf, distances)

    def cut(self, frames: slice) -> JudgedPerson:
        """The same for some frames only."""
        return JudgedPerson(self.name, self.fps, *(
            getattr(self, name)[frames] for name in
            ("true_m", "is_visible", "found_m", "covariances_m2", "states", "rotations", "ids", "is_said_lost")))


@dataclass
class JudgedScene:
    """Everybody of one recording, and who was found without being there."""

    people: list[JudgedPerson]
    false_people: int
    minutes: float


def judge(scene: TrueScene, found: list[FoundFrame], begin_us: int = 0) -> JudgedScene:
    """Frame k of the truth is at begin_us + k / fps; a message farther than half a frame from all is of none."""
    people = [_blank(person, scene.fps) for person in scene.people]
    by_frame = _by_frame(found, scene.fps, begin_us)
    nobody: Counter[int] = Counter()
    for k in range(scene.people[0].frames):
        candidates = by_frame[k].people if k in by_frame else []
        pairs = _assign([person.pelvis_m[k] for person in scene.people], candidates)
        for judged, j in zip(people, pairs):
            if j is not None:
                _take(judged, k, candidates[j])
        nobody.update(c.id for j, c in enumerate(candidates) if j not in pairs)
    false_people = sum(1 for frames in nobody.values() if frames / scene.fps > _FALSE_AFTER_S)
    return JudgedScene(people, false_people, scene.people[0].frames / scene.fps / 60.0)


def _blank(person: TruePerson, fps: float) -> JudgedPerson:
    frames, joints = person.frames, person.joints_m.shape[1]
    return JudgedPerson(
        person.name, fps, person.joints_m, person.is_visible,
        np.full((frames, joints, 3), np.nan), np.full((frames, joints, 3, 3), np.nan),
        np.full((frames, joints), MISSED), np.tile(np.eye(3), (frames, joints, 1, 1)), np.full(frames, -1), np.zeros(frames, bool))


def _by_frame(found: list[FoundFrame], fps: float, begin_us: int) -> dict[int, FoundFrame]:
    return {round((frame.utime - begin_us) * 1e-6 * fps): frame for frame in found}


def _assign(pelves_m: list[np.ndarray], people: list[FoundPerson]) -> list[int | None]:
    """For each true person the index of who is nearest, nearest pairs first; None = nobody within the gate."""
    distances = sorted(
        (float(np.linalg.norm(person.root_m - pelvis)), i, j)
        for i, pelvis in enumerate(pelves_m) if np.isfinite(pelvis).all()
        for j, person in enumerate(people) if np.isfinite(person.root_m).all())
    pairs: list[int | None] = [None] * len(pelves_m)
    for distance, i, j in distances:
        if distance <= _GATE_M and pairs[i] is None and j not in pairs:
            pairs[i] = j
    return pairs


def _take(judged: JudgedPerson, frame: int, person: FoundPerson) -> None:
    judged.found_m[frame] = person.joints_m
    judged.covariances_m2[frame] = person.covariances_m2
    is_there = np.isfinite(person.joints_m).all(axis=1)
    judged.states[frame] = np.where(is_there, person.states, MISSED)
    judged.rotations[frame] = person.rotations
    judged.ids[frame] = person.id
    judged.is_said_lost[frame] = person.state == BODY_LOST
