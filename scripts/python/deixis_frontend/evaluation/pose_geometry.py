"""Angles, bone lengths and squared Mahalanobis distances of judged people."""

from __future__ import annotations

import numpy as np

from deixis_frontend.evaluation.pose_joints import BALLS, BONES, HINGES, INDEX, SIDES, index
from deixis_frontend.evaluation.pose_matching import JudgedPerson

__all__ = ["ANGLES", "BONES", "angle_errors_deg", "length_errors_m", "mahalanobis2", "trunk_axes"]
ANGLES = (*HINGES, *BALLS)
_LEAST_VARIANCE_M2 = 1e-12  # below this an ellipsoid is flat, and nothing lies in it


def angle_errors_deg(person: JudgedPerson, joint: str) -> np.ndarray:
    """Of both sides, in the frames where all joints concerned are visible; infinite where missed."""
    of = _hinge_errors if joint in HINGES else _ball_errors
    return np.concatenate([of(person, side, joint) for side in SIDES])


def length_errors_m(person: JudgedPerson, bone: str) -> np.ndarray:
    """Found minus true length, of both sides and all frames in which the person was found."""
    parts = []
    for side in SIDES:
        a, b = (index(side, joint) for joint in BONES[bone])
        found = np.linalg.norm(person.found_m[:, b] - person.found_m[:, a], axis=1)
        true = np.linalg.norm(person.true_m[:, b] - person.true_m[:, a], axis=1)
        parts.append(found - true)
    errors = np.concatenate(parts)
    return errors[np.isfinite(errors)]


def mahalanobis2(person: JudgedPerson) -> np.ndarray:
    """Frames x joints; infinite where missed or where the covariance is none."""
    offsets = person.found_m - person.true_m
    is_usable = np.isfinite(offsets).all(axis=2) & np.isfinite(person.covariances_m2).all(axis=(2, 3))
    covariances = np.where(is_usable[..., None, None], person.covariances_m2, np.eye(3))
    is_usable &= np.linalg.eigvalsh(covariances)[..., 0] > _LEAST_VARIANCE_M2
    covariances = np.where(is_usable[..., None, None], covariances, np.eye(3))
    known = np.where(is_usable[..., None], offsets, 0.0)
    weighted = np.linalg.solve(covariances, known[..., None])[..., 0]
    return np.where(is_usable, (known * weighted).sum(axis=2), np.inf)


def trunk_axes(joints_m: np.ndarray) -> np.ndarray:
    """Frames x 3 x 3, rows = anterior, left, cranial of the trunk, from shoulders, hips and neck."""
    left = joints_m[:, INDEX["l_shoulder"]] - joints_m[:, INDEX["r_shoulder"]]
    hips = 0.5 * (joints_m[:, INDEX["l_hip"]] + joints_m[:, INDEX["r_hip"]])
    up = _unit(joints_m[:, INDEX["neck"]] - hips)
    left = _unit(left - (left * up).sum(axis=1, keepdims=True) * up)
    return np.stack([np.cross(left, up), left, up], axis=1)


def _hinge_errors(person: JudgedPerson, side: str, joint: str) -> np.ndarray:
    a, b, c = (index(side, name) for name in HINGES[joint])

    def angles(joints_m: np.ndarray) -> np.ndarray:
        return _angle_deg(joints_m[:, b] - joints_m[:, a], joints_m[:, c] - joints_m[:, b])

    errors = np.abs(angles(person.found_m) - angles(person.true_m))
    return _judged(person, errors, (a, b, c))


def _ball_errors(person: JudgedPerson, side: str, joint: str) -> np.ndarray:
    a, b = (index(side, name) for name in BALLS[joint])

    def bones(joints_m: np.ndarray) -> np.ndarray:
        return np.einsum("fij,fj->fi", trunk_axes(joints_m), joints_m[:, b] - joints_m[:, a])

    return _judged(person, _angle_deg(bones(person.found_m), bones(person.true_m)), (a, b))


def _judged(person: JudgedPerson, errors: np.ndarray, joints: tuple[int, ...]) -> np.ndarray:
    has_truth = np.isfinite(person.true_m[:, list(joints)]).all(axis=(1, 2))
    is_asked = person.is_visible[:, list(joints)].all(axis=1) & has_truth
    return np.where(np.isnan(errors), np.inf, errors)[is_asked]


def _unit(vectors: np.ndarray) -> np.ndarray:
    return vectors / np.maximum(np.linalg.norm(vectors, axis=1, keepdims=True), 1e-9)


def _angle_deg(a: np.ndarray, b: np.ndarray) -> np.ndarray:
    cosine = (_unit(a) * _unit(b)).sum(axis=1)
    return np.degrees(np.arccos(np.clip(cosine, -1.0, 1.0)))
