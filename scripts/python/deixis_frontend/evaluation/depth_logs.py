"""Writes logs of STEREO and STEREO_CALIBRATION from the pictures of a depth camera, as the stereo driver would."""

from __future__ import annotations

import io
from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from deixis_frontend.layout import Layout

CAMERA = "STEREO"
_SIGMA_M_AT_1M = 0.003  # of the depth cameras of these recordings: Kinect v1, RealSense D435


@dataclass(frozen=True)
class DepthCamera:
    """A pinhole; its depth has the size of its pictures."""

    focal_px: tuple[float, float]
    centre_px: tuple[float, float]
    size_px: tuple[int, int]  # width, height

    def pixels(self, points_m: np.ndarray) -> np.ndarray:
        """... x 2 of ... x 3 (x right, y down, z forward)."""
        return points_m[..., :2] / points_m[..., 2:] * self.focal_px + self.centre_px


@dataclass(frozen=True)
class DepthFrame:
    """One picture: millimetres along the optical axis (height x width, uint16, 0 = none), and what is seen."""

    utime: int
    depth_mm: np.ndarray
    jpeg: bytes | None = None  # None: the depth as shades


def write(layout: Layout, path: Path, camera: DepthCamera, frames: Iterable[DepthFrame]) -> None:
    """The calibration, then the pictures. UserError without message types; FileExistsError where there is a log."""
    layout.use_types()
    from deixis_lcm import logs

    with logs.Writer(path) as log:
        for number, frame in enumerate(frames):
            if number == 0:
                log.write(frame.utime, "STEREO_CALIBRATION", _calibration(camera, frame.utime))
            log.write(frame.utime, "STEREO", _stereo(frame, number))


def read_depth_png(path: Path) -> np.ndarray:
    """A 16-bit grey PNG as uint16; raises ValueError when it has another form."""
    from PIL import Image

    with Image.open(path) as picture:
        if not picture.mode.startswith("I"):
            raise ValueError(f"{path} is no 16-bit picture")
        return np.array(picture).astype(np.uint16)


def _stereo(frame: DepthFrame, number: int) -> Any:
    from bot_core import images_t
    from deixis_lcm import images

    height, width = frame.depth_mm.shape
    left = images.from_jpeg(frame.jpeg or _shades(frame.depth_mm), width, height, frame.utime, number,
                            camera=CAMERA)
    depth = images.from_depth_mm(frame.depth_mm, frame.utime)
    return images.bundle(frame.utime, [(images_t.LEFT, left), (images_t.DEPTH_MM_ZIPPED, depth)])


def _shades(depth_mm: np.ndarray) -> bytes:
    from PIL import Image

    file = io.BytesIO()
    Image.fromarray((depth_mm // 16).clip(0, 255).astype(np.uint8)).convert("RGB").save(file, "JPEG", quality=85)
    return file.getvalue()


def _calibration(camera: DepthCamera, utime: int) -> Any:
    from deixis import stereo_calibration_t, transform_t

    message = stereo_calibration_t()
    message.utime, message.camera = utime, CAMERA
    message.left, message.right, message.rectified = (_pinhole(camera, utime) for _ in range(3))
    message.right_from_left = transform_t()
    message.right_from_left.rotation_wxyz = [1.0, 0.0, 0.0, 0.0]
    message.disparity_sigma_px, message.depth_sigma_m_at_1m = 0.0, _SIGMA_M_AT_1M
    return message


def _pinhole(camera: DepthCamera, utime: int) -> Any:
    from deixis import camera_calibration_t, transform_t

    message = camera_calibration_t()
    message.utime, message.camera = utime, CAMERA
    message.width_px, message.height_px = camera.size_px
    message.distortion_model, message.is_calibrated = "none", True
    message.focal_px, message.principal_point_px = list(camera.focal_px), list(camera.centre_px)
    message.rectification = [1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0]
    message.parent_from_camera = transform_t()
    message.parent_from_camera.rotation_wxyz = [0.0, 0.0, 0.0, 0.0]
    return message
