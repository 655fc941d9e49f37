"""What the pose fitter published, as arrays: joints of the judged kinds per message and person."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from typing import Any

import numpy as np

from deixis_frontend.evaluation.pose_joints import JOINTS, JointPlace

MEASURED, INFERRED, HIDDEN, LOST = range(4)  # limb_pose_t
BODY_LOST = 2  # body_pose_t
_AVERAGE_STATURE_M = 1.72  # of offsets, where the model tells none


@dataclass(frozen=True)
class FoundPerson:
    """One person of one message; joints in the order of `JOINTS`, NaN where the model has no such limb."""

    id: int
    state: int
    root_m: np.ndarray  # 3
    joints_m: np.ndarray  # J x 3, in the message's frame
    covariances_m2: np.ndarray  # J x 3 x 3
    states: np.ndarray  # J, of limb_pose_t; LOST where there is no such limb
    rotations: np.ndarray  # J x 3 x 3, frame_from_limb of the limb that the joint is taken from


@dataclass(frozen=True)
class FoundFrame:
    """One message."""

    utime: int
    people: list[FoundPerson]


def read(messages: Iterable[tuple[str, Any]], joints: tuple[JointPlace, ...] = JOINTS,
         ) -> list[FoundFrame]:
    """Frames in order of (channel, message) pairs that hold BODY_MODEL and BODY_POSES. People whose model was
    not published before are left out, as any receiver would."""
    models: dict[int, Any] = {}
    frames = []
    for channel, message in messages:
        if channel == "BODY_MODEL":
            models[message.model_id] = message
        elif channel == "BODY_POSES":
            people = [_person(body, models[body.model_id], joints) for body in message.bodies
                      if body.model_id in models]
            frames.append(FoundFrame(message.utime, people))
    return frames


def _person(body: Any, model: Any, joints: tuple[JointPlace, ...]) -> FoundPerson:
    limbs = {limb.name: pose for limb, pose in zip(model.limbs, body.limbs)}
    stature = model.stature_m or _AVERAGE_STATURE_M
    count = len(joints)
    places, covariances = np.full((count, 3), np.nan), np.full((count, 3, 3), np.nan)
    states, rotations = np.full(count, LOST), np.tile(np.eye(3), (count, 1, 1))
    for index, joint in enumerate(joints):
        limb = limbs.get(joint.limb)
        if limb is None:
            continue
        places[index] = getattr(limb, f"{joint.end}_m")
        rotations[index] = rotation(limb.in_frame.rotation_wxyz)
        if any(joint.offset):
            places[index] += stature * rotations[index] @ np.array(joint.offset)
        covariances[index] = symmetric(getattr(limb, f"{joint.end}_covariance_m2"))
        states[index] = limb.state
    return FoundPerson(body.person_id, body.state, np.array(body.root_in_frame.translation_m), places,
                       covariances, states, rotations)


def symmetric(lower: Any) -> np.ndarray:
    """3 x 3 from a lower triangle row by row."""
    xx, yx, yy, zx, zy, zz = lower
    return np.array([[xx, yx, zx], [yx, yy, zy], [zx, zy, zz]])


def rotation(wxyz: Any) -> np.ndarray:
    """3 x 3 from a unit quaternion, w first."""
    w, x, y, z = wxyz
    return np.array([[1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
                     [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
                     [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)]])
