"""Outlines of fitted limbs in the picture: what the two ellipses of each limb span, seen by a pinhole camera."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from deixis_frontend.evaluation.pose_results import rotation

_CORNERS = 16  # of an ellipse
_NEAREST_M = 0.1

Polygon = list[tuple[float, float]]


@dataclass(frozen=True)
class Pinhole:
    """Maps the rectified left camera's frame to pixels of its picture."""

    focal_px: tuple[float, float]
    centre_px: tuple[float, float]

    @staticmethod
    def of(calibration: Any) -> Pinhole:
        """From a camera_calibration_t."""
        return Pinhole(tuple(calibration.focal_px), tuple(calibration.principal_point_px))

    def cropped(self, box: tuple[int, int, int, int], width_px: int) -> Pinhole:
        """Of the part left, top, right, bottom of the picture, enlarged to a width."""
        scale = width_px / (box[2] - box[0])
        # The origin of pixels is the centre of the top-left one.
        (fx, fy), (cx, cy) = self.focal_px, self.centre_px
        return Pinhole((scale * fx, scale * fy),
                       (scale * (cx + 0.5 - box[0]) - 0.5, scale * (cy + 0.5 - box[1]) - 0.5))

    def pixels(self, points_m: np.ndarray) -> np.ndarray:
        """N x 2 of N x 3; what lies behind the camera is drawn as if close before it."""
        depth = np.maximum(points_m[:, 2], _NEAREST_M)
        return points_m[:, :2] / depth[:, None] * self.focal_px + self.centre_px


def limb_outlines(body: Any, model: Any, camera: Pinhole) -> list[tuple[int, Polygon]]:
    """State and outline of each limb of a body_pose_t, from its body_model_t; nothing for limbs behind the camera."""
    outlines = []
    for limb, pose in zip(model.limbs, body.limbs):
        points = rim_points(limb) @ rotation(pose.in_frame.rotation_wxyz).T + np.array(pose.in_frame.translation_m)
        if points[:, 2].min() > _NEAREST_M:
            outlines.append((pose.state, convex_hull(camera.pixels(points))))
    return outlines


def rim_points(limb: Any) -> np.ndarray:
    """Both ellipses of a limb_t in the limb's frame."""
    turns = np.linspace(0.0, 2.0 * np.pi, _CORNERS, endpoint=False)
    circle = np.stack([np.cos(turns), np.sin(turns), np.zeros(_CORNERS)], axis=1)
    ends = ((limb.a0_m, limb.b0_m, limb.centre0_m, 0.0), (limb.a1_m, limb.b1_m, limb.centre1_m, limb.length_m))
    return np.concatenate([circle * (a, b, 0.0) + (*centre, z) for a, b, centre, z in ends])


def convex_hull(points: np.ndarray) -> Polygon:
    """Corners in order (Andrew's monotone chain)."""
    ordered = sorted({(float(x), float(y)) for x, y in points})

    def chain(some: list[tuple[float, float]]) -> Polygon:
        hull: Polygon = []
        for p in some:
            while len(hull) >= 2 and _turn(hull[-2], hull[-1], p) <= 0:
                hull.pop()
            hull.append(p)
        return hull[:-1]

    return chain(ordered) + chain(ordered[::-1]) if len(ordered) > 2 else ordered


def _turn(a: tuple[float, float], b: tuple[float, float], c: tuple[float, float]) -> float:
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
