"""How cameras see and where they are."""

from __future__ import annotations

from typing import Any

from foxglove_schemas_protobuf.CameraCalibration_pb2 import CameraCalibration
from foxglove_schemas_protobuf.FrameTransform_pb2 import FrameTransform

from deixis_frontend.export.drawing import quaternion, stamp, vector

# Our name -> Foxglove's; the orders of the coefficients are the same.
_DISTORTIONS = {"none": "plumb_bob", "plumb_bob": "plumb_bob", "rational": "rational_polynomial",
                "fisheye": "kannala_brandt"}
_UNDISTORTED = [0.0] * 5


def calibration(message: Any, frame: str, utime: int) -> CameraCalibration:
    """A camera_calibration_t; ValueError for a distortion model that is not known."""
    if message.distortion_model not in _DISTORTIONS:
        raise ValueError(f"distortion model '{message.distortion_model}' is not known")
    (fx, fy), (cx, cy) = message.focal_px, message.principal_point_px
    is_plain = message.distortion_model == "none"
    return CameraCalibration(
        timestamp=stamp(utime), frame_id=frame, width=message.width_px, height=message.height_px,
        distortion_model=_DISTORTIONS[message.distortion_model],
        D=_UNDISTORTED if is_plain else message.distortion,
        K=[fx, 0.0, cx, 0.0, fy, cy, 0.0, 0.0, 1.0],
        R=message.rectification,
        P=[fx, 0.0, cx, 0.0, 0.0, fy, cy, 0.0, 0.0, 0.0, 1.0, 0.0])


def mount(message: Any, parent: str, frame: str, utime: int) -> FrameTransform:
    """parent_from_camera of a camera_calibration_t that has a mount."""
    transform = message.parent_from_camera
    return FrameTransform(
        timestamp=stamp(utime), parent_frame_id=parent, child_frame_id=frame,
        translation=vector(transform.translation_m), rotation=quaternion(transform.rotation_wxyz))


def camera_pose(message: Any, parent: str, frame: str) -> FrameTransform:
    """A rigid_transform_t on CAMERA_POSE: parent_from_camera."""
    return FrameTransform(
        timestamp=stamp(message.utime), parent_frame_id=parent, child_frame_id=frame,
        translation=vector(message.trans), rotation=quaternion(message.quat))
