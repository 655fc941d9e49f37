"""The skeletons of the public kinect-lcm types."""

from __future__ import annotations

from typing import Any

from foxglove_schemas_protobuf.LinePrimitive_pb2 import LinePrimitive
from foxglove_schemas_protobuf.SceneEntity_pb2 import SceneEntity
from google.protobuf.duration_pb2 import Duration

from deixis_frontend.export.drawing import GREEN, point, pose, stamp

_LINE_M = 0.02
_SECONDS = 1  # nobody says when a person has gone


def skeleton(message: Any, frame: str) -> SceneEntity:
    """The links of a skeleton_msg_t; it names no frame."""
    ends = [(end.x, end.y, end.z) for link in message.links for end in (link.source, link.dest)]
    lines = LinePrimitive(type=LinePrimitive.LINE_LIST, pose=pose((0.0, 0.0, 0.0)), color=GREEN,
                          thickness=_LINE_M, points=[point(end) for end in ends])
    return SceneEntity(timestamp=stamp(message.utime), frame_id=frame,
                       id=f"person {message.user_id}", lifetime=Duration(seconds=_SECONDS),
                       frame_locked=True, lines=[lines])
