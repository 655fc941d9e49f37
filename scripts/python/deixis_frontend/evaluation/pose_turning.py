"""A real man who turns once about himself before a Kinect: does the trunk turn with him?

The recording gives R and t of each frame, X_body = R X_camera + t, in one frame of his body; in the first frame he faces
the camera. It has no times: the rate is a setting.
"""

from __future__ import annotations

import re
import tempfile
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np

from deixis_frontend.evaluation import depth_logs, pose_chain, pose_results
from deixis_frontend.evaluation.depth_logs import DepthCamera, DepthFrame
from deixis_frontend.evaluation.pose_chain import Chain
from deixis_frontend.evaluation.pose_geometry import trunk_axes
from deixis_frontend.evaluation.pose_results import FoundFrame
from deixis_frontend.evaluation.pose_scores import percentile, share
from deixis_frontend.layout import Layout

NAME = "rgbd_person_turning_kinect"
_FPS = 15.0
_SIZE_PX = (640, 480)
_NEAR_M = 1.0  # of the trunk to the middle of the person's mask
_WRONG_DEG = 45.0


def is_in(folder: Path) -> bool:
    """Whether this is a folder of that kind."""
    return (folder / "000_camera.xml").is_file() and (folder / "000_mask.jpg").is_file()


def evaluate(layout: Layout, folder: Path, _: str | None, chain: Chain) -> dict[str, Any]:
    """`sequences` (one) and `summary`; raises UserError when a program fails."""
    names = sorted(path.name.removesuffix("_camera.xml") for path in folder.glob("*_camera.xml"))
    cameras = [_matrices(folder / f"{name}_camera.xml") for name in names]
    lens = cameras[0]["intrinsic"]
    camera = DepthCamera((lens[0, 0], lens[1, 1]), (lens[0, 2], lens[1, 2]), _SIZE_PX)
    with tempfile.TemporaryDirectory() as scratch:
        log = Path(scratch) / "depth.lcmlog"
        depth_logs.write(layout, log, camera, _frames(folder, names))
        fitted = pose_chain.fit(layout, log, chain, ("fitter.stature_m=0",))
    found = {round(f.utime * 1e-6 * _FPS): f for f in pose_results.read(fitted.messages)}
    errors = yaw_errors_deg(found, [(c["R"], c["t"][:, 0]) for c in cameras],
                            [_middle_m(folder, name, camera) for name in names])
    row = {"name": NAME, **_figures(errors)}
    return {"sequences": [row], "summary": {k: v for k, v in row.items() if k != "name"}}


def lines(report: dict[str, Any]) -> Iterator[str]:
    """What is printed."""
    row = report["summary"]
    yield (f"frames {row['frames']}, lost {row['lost_frames_percent']} %; trunk's yaw off by"
           f" {row['yaw_error_median_deg']} deg (median), {row['yaw_error_p95_deg']} (p95); more than"
           f" {_WRONG_DEG:.0f} deg in {row['wrong_percent']} % (lost ones are)")


def yaw_errors_deg(found: dict[int, FoundFrame], body_from_camera: list[tuple[np.ndarray, np.ndarray]],
                   middles_m: list[np.ndarray]) -> np.ndarray:
    """Per frame, with sign; infinite where nobody stands near the person's middle. What was found must face the
    camera in the body's frame of the first picture, whatever way the man is turned."""
    errors = np.full(len(body_from_camera), np.inf)
    facing = body_from_camera[0][0] @ np.array([0.0, 0.0, -1.0])
    for k, (rotation, _) in enumerate(body_from_camera):
        people = [p for p in found[k].people if np.isfinite(p.joints_m).all()] if k in found else []
        near = [p for p in people if np.linalg.norm(p.joints_m[0] - middles_m[k]) < _NEAR_M]
        if near:
            nearest = min(near, key=lambda p: float(np.linalg.norm(p.joints_m[0] - middles_m[k])))
            anterior = rotation @ trunk_axes(nearest.joints_m[None])[0, 0]
            errors[k] = _yaw_deg(facing, anterior)
    return errors


def _yaw_deg(a: np.ndarray, b: np.ndarray) -> float:
    """About the vertical, y, from a to b; -180..180."""
    angle = np.degrees(np.arctan2(b[0], b[2]) - np.arctan2(a[0], a[2]))
    return float((angle + 180.0) % 360.0 - 180.0)


def _figures(errors: np.ndarray) -> dict[str, Any]:
    return {"frames": len(errors), "lost_frames_percent": share(np.isinf(errors)),
            "yaw_error_median_deg": percentile(np.abs(errors), 50, 1),
            "yaw_error_p95_deg": percentile(np.abs(errors), 95, 1),
            "wrong_percent": share(np.abs(errors) > _WRONG_DEG)}


def _frames(folder: Path, names: list[str]) -> Iterator[DepthFrame]:
    for number, name in enumerate(names):
        yield DepthFrame(round(number / _FPS * 1e6), depth_logs.read_depth_png(folder / f"{name}_depth.png"),
                         (folder / f"{name}.jpg").read_bytes())


def _middle_m(folder: Path, name: str, camera: DepthCamera) -> np.ndarray:
    """Median point of what the mask shows."""
    from PIL import Image

    depth_m = depth_logs.read_depth_png(folder / f"{name}_depth.png") / 1000.0
    with Image.open(folder / f"{name}_mask.jpg") as picture:
        is_person = np.array(picture.convert("L")) > 127
    v, u = np.nonzero(is_person & (depth_m > 0))
    z = depth_m[v, u]
    rays = (np.stack([u, v], axis=1) - camera.centre_px) / camera.focal_px
    return np.median(np.column_stack([rays * z[:, None], z]), axis=0)


def _matrices(path: Path) -> dict[str, np.ndarray]:
    """Of a file that cv::FileStorage wrote as XML."""
    pattern = r'<(\w+) type_id="opencv-matrix">\s*<rows>(\d+)</rows>\s*<cols>(\d+)</cols>.*?<data>(.*?)</data>'
    return {name: np.array([float(v) for v in data.split()]).reshape(int(rows), int(columns))
            for name, rows, columns, data in re.findall(pattern, path.read_text(encoding="ascii"), re.S)}
