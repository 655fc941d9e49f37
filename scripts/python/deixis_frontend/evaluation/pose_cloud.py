"""A real man as a cloud of several depth cameras, seen from one virtual one: how well the fitted surface explains it.

There are no true joints. The cloud is mostly a half shell: the camera looks level from the side from which it bulges.
"""

from __future__ import annotations

import tempfile
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np

from deixis_frontend.evaluation import depth_logs, pose_chain
from deixis_frontend.evaluation.depth_logs import DepthCamera, DepthFrame
from deixis_frontend.evaluation.pose_chain import Chain
from deixis_frontend.evaluation.pose_results import rotation
from deixis_frontend.evaluation.pose_scores import percentile, share
from deixis_frontend.layout import Layout

NAME = "cloud_panoptic_pose1"
_FPS = 29.97
_FIRST = 118  # the frames from here on follow one another
_CAMERA = DepthCamera((285.0, 285.0), (159.5, 119.5), (320, 240))
_DISTANCE_M, _HEIGHT_M = 2.6, 1.0
_AZIMUTHS = 24
_SPLAT_PX = 2  # side of the square that a point covers
_BEND_PX = 4  # to each side of where a row is looked at
_STEP_MM = 50.0  # larger ones are no one surface
_EXPLAINED_M = 0.05
_MOST_POINTS = 4000


def is_in(folder: Path) -> bool:
    """Whether this is a folder of that kind."""
    return any(folder.glob("hd*.pcd"))


def evaluate(layout: Layout, folder: Path, _: str | None, chain: Chain) -> dict[str, Any]:
    """`sequences` (one) and `summary`; raises UserError when a program fails."""
    clouds = [read_pcd(path) for path in sorted(folder.glob("hd*.pcd")) if int(path.stem[2:]) >= _FIRST]
    pose_of_camera = best_view(clouds[0])
    depths = [render_mm(cloud, *pose_of_camera) for cloud in clouds]
    with tempfile.TemporaryDirectory() as scratch:
        log = Path(scratch) / "depth.lcmlog"
        depth_logs.write(layout, log, _CAMERA, (DepthFrame(round(k / _FPS * 1e6), depth)
                                                for k, depth in enumerate(depths)))
        fitted = pose_chain.fit(layout, log, chain, ("fitter.stature_m=0",))
    row = {"name": NAME, **_figures(_distances(fitted.messages, depths))}
    return {"sequences": [row], "summary": {k: v for k, v in row.items() if k != "name"}}


def lines(report: dict[str, Any]) -> Iterator[str]:
    """What is printed."""
    row = report["summary"]
    median = "lost" if row["surface_median_m"] is None else f"{1000 * row['surface_median_m']:.0f} mm"
    yield (f"frames {row['frames']}, lost {row['lost_frames_percent']} %; points off the surface by {median}"
           f" (median), within 5 cm {row['explained_percent']} %")


def read_pcd(path: Path) -> np.ndarray:
    """N x 3 of a binary PCD with fields x y z rgb."""
    head, data = path.read_bytes().split(b"DATA binary\n", 1)
    if b"FIELDS x y z rgb" not in head:
        raise ValueError(f"{path} has other fields than x y z rgb")
    return np.frombuffer(data, "<f4").reshape(-1, 4)[:, :3].astype(float)


def best_view(cloud: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Rotation and translation, camera_from_world, of the level camera that sees most of the outside."""
    middle = np.median(cloud, axis=0)
    views = [_view(middle, azimuth) for azimuth in np.linspace(0, 2 * np.pi, _AZIMUTHS, endpoint=False)]
    return max(views, key=lambda view: _outside(render_mm(cloud, *view)))


def render_mm(cloud: np.ndarray, turn: np.ndarray, shift: np.ndarray) -> np.ndarray:
    """Nearest point per pixel, each as a small square."""
    points = cloud @ turn.T + shift
    points = points[np.argsort(-points[:, 2])]  # The nearest ones are written last.
    u, v = np.floor(_CAMERA.pixels(points) + 0.5).astype(int).T
    width, height = _CAMERA.size_px
    depth = np.zeros((height, width), np.uint16)
    shifts = range(_SPLAT_PX)
    all_u = np.concatenate([[u + du] for du in shifts for _ in shifts]).T.ravel()
    all_v = np.concatenate([[v + dv] for _ in shifts for dv in shifts]).T.ravel()
    z_mm = np.repeat(np.round(1000 * points[:, 2]), _SPLAT_PX**2)
    is_inside = (all_u >= 0) & (all_u < width) & (all_v >= 0) & (all_v < height)
    depth[all_v[is_inside], all_u[is_inside]] = z_mm[is_inside]
    return depth


def surface_distances_m(points: np.ndarray, body: Any, model: Any) -> np.ndarray:
    """Of each point (N x 3) to the nearest limb's surface."""
    return np.min([_to_limb(points, limb, pose.in_frame) for limb, pose in zip(model.limbs, body.limbs)], axis=0)


def _view(middle: np.ndarray, azimuth: float) -> tuple[np.ndarray, np.ndarray]:
    forward = np.array([np.sin(azimuth), 0.0, np.cos(azimuth)])
    down = np.array([0.0, 1.0, 0.0])  # y of the world points down, too.
    turn = np.stack([np.cross(down, forward), down, forward])
    place = np.array([middle[0], -_HEIGHT_M, middle[2]]) - _DISTANCE_M * forward
    return turn, -turn @ place


def _outside(depth_mm: np.ndarray) -> int:
    """Pixels where rows bulge towards the camera, less those where they are hollow: a shell seen from within is."""
    rows = np.where(depth_mm > 0, depth_mm.astype(float), np.nan)
    left, middle, right = (rows[:, i:i - 2 * _BEND_PX or None] for i in (0, _BEND_PX, 2 * _BEND_PX))
    is_one_surface = (np.abs(left - middle) < _STEP_MM) & (np.abs(right - middle) < _STEP_MM)
    bend = np.sign(left + right - 2 * middle)
    return int(bend[is_one_surface].sum())


def _distances(messages: list[tuple[str, Any]], depths: list[np.ndarray]) -> list[np.ndarray]:
    """Per frame those of its points to the person who explains them best; infinite where there is nobody."""
    models: dict[int, Any] = {}
    bodies: dict[int, list[Any]] = {}
    for channel, message in messages:
        if channel == "BODY_MODEL":
            models[message.model_id] = message
        else:
            bodies[round(message.utime * 1e-6 * _FPS)] = list(message.bodies)
    distances = []
    for k, depth in enumerate(depths):
        points = _points(depth)
        of_bodies = [surface_distances_m(points, body, models[body.model_id]) for body in bodies.get(k, [])
                     if body.model_id in models]
        distances.append(min(of_bodies, key=lambda d: float(np.median(d))) if of_bodies
                         else np.full(len(points), np.inf))
    return distances


def _points(depth_mm: np.ndarray) -> np.ndarray:
    v, u = np.nonzero(depth_mm)
    step = max(1, len(v) // _MOST_POINTS)
    v, u = v[::step], u[::step]
    z = depth_mm[v, u] / 1000.0
    return np.column_stack([(np.stack([u, v], axis=1) - _CAMERA.centre_px) / _CAMERA.focal_px * z[:, None], z])


def _to_limb(points: np.ndarray, limb: Any, in_frame: Any) -> np.ndarray:
    """Beside the limb, along the line from its axis; beyond its ends, to the flat ends."""
    local = (points - np.array(in_frame.translation_m)) @ rotation(in_frame.rotation_wxyz)
    along = np.clip(local[:, 2] / max(limb.length_m, 1e-6), 0.0, 1.0)[:, None]
    centre = (1 - along) * np.array(limb.centre0_m) + along * np.array(limb.centre1_m)
    axes = (1 - along) * (limb.a0_m, limb.b0_m) + along * (limb.a1_m, limb.b1_m)
    from_axis = local[:, :2] - centre
    distance = np.maximum(np.linalg.norm(from_axis, axis=1), 1e-9)
    rim = distance / np.maximum(np.linalg.norm(from_axis / axes, axis=1), 1e-9)
    beyond = local[:, 2] - along[:, 0] * limb.length_m
    outside = np.maximum(distance - rim, 0.0)
    return np.where(beyond == 0.0, np.abs(distance - rim), np.hypot(outside, beyond))


def _figures(distances: list[np.ndarray]) -> dict[str, Any]:
    together = np.concatenate(distances) if distances else np.zeros(0)
    lost = np.array([np.isinf(d).all() or np.median(d) > _EXPLAINED_M for d in distances], bool)
    return {"frames": len(distances), "lost_frames_percent": share(lost),
            "surface_median_m": percentile(together, 50), "surface_p95_m": percentile(together, 95),
            "explained_percent": share(together <= _EXPLAINED_M)}
