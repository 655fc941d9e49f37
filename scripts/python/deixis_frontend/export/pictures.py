"""Pictures: JPEG as it is, raw pixels and depth as foxglove.RawImage."""

from __future__ import annotations

from typing import Any

from bot_core import image_t, images_t
from foxglove_schemas_protobuf.CompressedImage_pb2 import CompressedImage
from foxglove_schemas_protobuf.RawImage_pb2 import RawImage

from deixis_frontend.export.drawing import stamp
from deixis_lcm import images

MOST_SHOWN = 40  # characters of a word that is not known
_LARGEST_DEPTH_BYTES = 1 << 27  # unzipped; a few bytes can claim gigabytes
_ENCODINGS = {
    image_t.PIXEL_FORMAT_GRAY: "mono8",
    image_t.PIXEL_FORMAT_RGB: "rgb8",
    image_t.PIXEL_FORMAT_BGR: "bgr8",
    image_t.PIXEL_FORMAT_YUYV: "yuv422_yuy2",
    image_t.PIXEL_FORMAT_LE_GRAY16: "mono16",
}
# Foxglove's and ROS's name -> bytes of a pixel, pixels that share their bytes.
_PIXELS = {
    "mono8": (1, 1), "8UC1": (1, 1), "rgb8": (3, 1), "bgr8": (3, 1), "8UC3": (3, 1),
    "rgba8": (4, 1), "bgra8": (4, 1), "yuv422": (2, 2), "uyvy": (2, 2), "yuv422_yuy2": (2, 2),
    "yuyv": (2, 2), "bayer_rggb8": (1, 2), "bayer_bggr8": (1, 2), "bayer_gbrg8": (1, 2),
    "bayer_grbg8": (1, 2), "mono16": (2, 1), "16UC1": (2, 1), "32FC1": (4, 1),
}
_BEGINNINGS = {"jpeg": b"\xff\xd8", "png": b"\x89PNG\r\n\x1a\n"}


def picture(message: Any, frame: str) -> CompressedImage | RawImage:
    """An image_t; ValueError if its sizes do not fit together or its format is not known."""
    if message.pixelformat == image_t.PIXEL_FORMAT_MJPEG:
        return CompressedImage(timestamp=stamp(message.utime), frame_id=frame, format="jpeg",
                               data=images.jpeg_bytes(message))
    images.to_array(message)  # Refuses what does not fit together.
    return RawImage(timestamp=stamp(message.utime), frame_id=frame, width=message.width,
                    height=message.height, step=message.row_stride, data=bytes(message.data),
                    encoding=_ENCODINGS[message.pixelformat])


def raw(size: Any, encoding: str, data: bytes, frame: str, utime: int, *,
        step: int = 0) -> RawImage:
    """Pixels of a known encoding; `size` has width and height, a `step` of 0 is that of the width.

    ValueError if encoding, sizes and data do not fit together.
    """
    if encoding not in _PIXELS:
        raise ValueError(f"encoding '{encoding[:MOST_SHOWN]}' is not known")
    pixel_bytes, shared = _PIXELS[encoding]
    width, height, row = size.width, size.height, size.width * pixel_bytes
    if width <= 0 or height <= 0 or width % shared:
        raise ValueError(f"size {width} x {height} is none of a picture of {encoding}")
    step = step or row
    if step < row:
        raise ValueError(f"step {step} is less than {width} pixels of {pixel_bytes} bytes")
    if len(data) < (needed := step * (height - 1) + row):
        raise ValueError(f"data have {len(data)} bytes, {width} x {height} needs {needed}")
    return RawImage(timestamp=stamp(utime), frame_id=frame, width=width, height=height, step=step,
                    encoding=encoding, data=data)


def file(data: bytes, kind: str, frame: str, utime: int) -> CompressedImage:
    """A JPEG or PNG file, by `kind`; ValueError if it does not begin like one."""
    if not data.startswith(_BEGINNINGS[kind]):
        raise ValueError(f"data do not begin like a {kind} file")
    return CompressedImage(timestamp=stamp(utime), frame_id=frame, format=kind, data=data)


def depth(message: Any, frame: str) -> RawImage:
    """The depth image of an images_t, unzipped: 16 bit, millimetres, 0 = none.

    ValueError if it does not unzip, does not fit its geometry or is larger than 128 MiB.
    """
    for kind, image in zip(message.image_types, message.images):
        size = image.row_stride * image.height
        if kind in images.DEPTH_TYPES and size > _LARGEST_DEPTH_BYTES:
            raise ValueError(f"depth of {size} bytes is larger than {_LARGEST_DEPTH_BYTES}")
    pixels = images.depth_mm(message)
    return RawImage(timestamp=stamp(message.utime), frame_id=frame, width=pixels.shape[1],
                    height=pixels.shape[0], step=2 * pixels.shape[1], encoding="16UC1",
                    data=pixels.tobytes())


def is_depth(kind: int) -> bool:
    """Whether a role in images_t is that of a depth image that depth() reads."""
    return kind in images.DEPTH_TYPES


SIDES = {images_t.LEFT: "left", images_t.RIGHT: "right"}  # role in images_t -> what in the topic
