"""Numbers of our messages in Foxglove's types."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from foxglove_schemas_protobuf.Color_pb2 import Color
from foxglove_schemas_protobuf.Point2_pb2 import Point2
from foxglove_schemas_protobuf.Point3_pb2 import Point3
from foxglove_schemas_protobuf.Pose_pb2 import Pose
from foxglove_schemas_protobuf.Quaternion_pb2 import Quaternion
from foxglove_schemas_protobuf.Vector3_pb2 import Vector3
from google.protobuf.timestamp_pb2 import Timestamp

_LATEST_US = 253_402_300_799_999_999  # the end of the year 9999, as of protobuf's time stamps
_CORNER = 0.5  # pixels from the corner of the top-left pixel to its centre

YELLOW = Color(r=1.0, g=0.85, b=0.1, a=1.0)
ORANGE = Color(r=1.0, g=0.5, b=0.1, a=1.0)
GREEN = Color(r=0.2, g=0.9, b=0.3, a=1.0)
BLUE = Color(r=0.3, g=0.6, b=1.0, a=1.0)
GREY = Color(r=0.6, g=0.6, b=0.6, a=0.5)
WHITE = Color(r=1.0, g=1.0, b=1.0, a=1.0)
SHADE = Color(r=0.0, g=0.0, b=0.0, a=0.5)


def stamp(utime: int) -> Timestamp:
    """A time in microseconds; ValueError if there is no such time."""
    if not 0 <= utime <= _LATEST_US:
        raise ValueError(f"time {utime} us is before 1970 or after 9999")
    return Timestamp(seconds=utime // 1_000_000, nanos=utime % 1_000_000 * 1000)


def point(position_m: Sequence[float]) -> Point3:
    """A position in metres."""
    return Point3(x=position_m[0], y=position_m[1], z=position_m[2])


def vector(numbers: Sequence[float]) -> Vector3:
    """Three numbers."""
    return Vector3(x=numbers[0], y=numbers[1], z=numbers[2])


def quaternion(wxyz: Sequence[float]) -> Quaternion:
    """A rotation given with w first."""
    return Quaternion(w=wxyz[0], x=wxyz[1], y=wxyz[2], z=wxyz[3])


def pose(position_m: Sequence[float]) -> Pose:
    """A place that is not turned."""
    return Pose(position=vector(position_m), orientation=Quaternion(w=1.0))


def pixel(point_px: Sequence[float]) -> Point2:
    """A place in a picture, which Foxglove counts from the corner of the top-left pixel."""
    return Point2(x=point_px[0] + _CORNER, y=point_px[1] + _CORNER)


def pixels(points_px: Iterable[Sequence[float]]) -> list[Point2]:
    """Places in a picture."""
    return [pixel(point_px) for point_px in points_px]
