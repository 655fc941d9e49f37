"""Lenses and frames of dimos robots: sensor_msgs.CameraInfo and tf2_msgs.TFMessage."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

from foxglove_schemas_protobuf.CameraCalibration_pb2 import CameraCalibration
from foxglove_schemas_protobuf.FrameTransform_pb2 import FrameTransform
from foxglove_schemas_protobuf.FrameTransforms_pb2 import FrameTransforms

from deixis_frontend.export.drawing import quaternion, stamp, vector
from deixis_frontend.export.pictures import MOST_SHOWN
from deixis_frontend.export.times import of_header

# ROS's name -> Foxglove's and how many coefficients there may be; the orders are the same.
_DISTORTIONS = {"": ("plumb_bob", ()), "plumb_bob": ("plumb_bob", (4, 5)),
                "rational_polynomial": ("rational_polynomial", (8, 12, 14)),
                "equidistant": ("kannala_brandt", (4,))}
_UNDISTORTED = ("plumb_bob", [0.0] * 5)
_IDENTITY = [1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0]
_MOST_TRANSFORMS = 1024  # as services take
_UNIT_TOLERANCE = 1e-3  # of a quaternion's length, as services have it


def lens(message: Any, frame: str) -> CameraCalibration:
    """A CameraInfo of a whole picture; ValueError for other lenses than services take.

    R and P of zeros only, which nobody has filled in, follow from K.
    """
    _require_whole_picture(message)
    _require_pinhole(message.K)
    _require_finite([*message.K, *message.R, *message.P], "K, R or P")
    fx, _, cx, _, fy, cy = message.K[:6]
    model, coefficients = _distortion(message)
    return CameraCalibration(
        timestamp=stamp(of_header(message.header)), frame_id=frame, width=message.width,
        height=message.height, distortion_model=model, D=coefficients, K=message.K,
        R=message.R if any(message.R) else _IDENTITY,
        P=message.P if any(message.P) else [fx, 0.0, cx, 0.0, 0.0, fy, cy, 0.0, 0.0, 0.0, 1.0, 0.0])


def transforms(message: Any) -> FrameTransforms:
    """A TFMessage: parent_from_child of each; ValueError if one does not place a frame."""
    if len(message.transforms) > _MOST_TRANSFORMS:
        raise ValueError(f"{len(message.transforms)} transforms are more than {_MOST_TRANSFORMS}")
    return FrameTransforms(transforms=map(_transform, message.transforms))


def _transform(message: Any) -> FrameTransform:
    parent, child = message.header.frame_id, message.child_frame_id
    if not parent or not child or parent == child:
        raise ValueError(f"frame '{child[:MOST_SHOWN]}' cannot be in frame '{parent[:MOST_SHOWN]}'")
    place, turn = message.transform.translation, message.transform.rotation
    translation, rotation = (place.x, place.y, place.z), (turn.w, turn.x, turn.y, turn.z)
    _require_finite(translation, "a translation")
    if not abs(math.hypot(*rotation) - 1.0) <= _UNIT_TOLERANCE:
        raise ValueError(f"quaternion {rotation} (w x y z) is no rotation")
    return FrameTransform(
        timestamp=stamp(of_header(message.header)), parent_frame_id=parent, child_frame_id=child,
        translation=vector(translation), rotation=quaternion(rotation))


def _distortion(message: Any) -> tuple[str, Sequence[float]]:
    if message.distortion_model not in _DISTORTIONS:
        raise ValueError(
            f"distortion model '{message.distortion_model[:MOST_SHOWN]}' is not known")
    if not message.D:
        return _UNDISTORTED
    model, counts = _DISTORTIONS[message.distortion_model]
    if len(message.D) not in counts:
        raise ValueError(f"'{message.distortion_model}' has not {len(message.D)} coefficients")
    _require_finite(message.D, "D")
    return model, message.D


def _require_whole_picture(message: Any) -> None:
    """The lens is that of the full picture: a part of it, or one made smaller, has another."""
    width, height, roi = message.width, message.height, message.roi
    if width <= 0 or height <= 0:
        raise ValueError(f"size {width} x {height} is not positive")
    is_full = (roi.x_offset, roi.y_offset) == (0, 0) and roi.width in (0, width) and (
        roi.height in (0, height))
    if not is_full or message.binning_x not in (0, 1) or message.binning_y not in (0, 1):
        raise ValueError("the lens is that of another picture: of a part of it, or binned")


def _require_pinhole(k: Sequence[float]) -> None:
    is_pinhole = (k[1], k[3], k[6], k[7], k[8]) == (0.0, 0.0, 0.0, 0.0, 1.0)
    if not is_pinhole or not min(k[0], k[4]) >= 1.0:
        raise ValueError(f"K {list(k)} is none of a pinhole camera that is calibrated")


def _require_finite(numbers: Sequence[float], what: str) -> None:
    if not all(map(math.isfinite, numbers)):
        raise ValueError(f"{what} is not finite")
