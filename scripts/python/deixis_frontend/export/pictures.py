"""Pictures: JPEG as it is, raw pixels and depth as foxglove.RawImage."""

from __future__ import annotations

from typing import Any

from bot_core import image_t, images_t
from foxglove_schemas_protobuf.CompressedImage_pb2 import CompressedImage
from foxglove_schemas_protobuf.RawImage_pb2 import RawImage

from deixis_frontend.export.drawing import stamp
from deixis_lcm import images

_LARGEST_DEPTH_BYTES = 1 << 27  # unzipped; a few bytes can claim gigabytes
_ENCODINGS = {
    image_t.PIXEL_FORMAT_GRAY: "mono8",
    image_t.PIXEL_FORMAT_RGB: "rgb8",
    image_t.PIXEL_FORMAT_BGR: "bgr8",
    image_t.PIXEL_FORMAT_YUYV: "yuv422_yuy2",
    image_t.PIXEL_FORMAT_LE_GRAY16: "mono16",
}


def picture(message: Any, frame: str) -> CompressedImage | RawImage:
    """An image_t; ValueError if its sizes do not fit together or its format is not known."""
    if message.pixelformat == image_t.PIXEL_FORMAT_MJPEG:
        return CompressedImage(timestamp=stamp(message.utime), frame_id=frame, format="jpeg",
                               data=images.jpeg_bytes(message))
    images.to_array(message)  # Refuses what does not fit together.
    return RawImage(timestamp=stamp(message.utime), frame_id=frame, width=message.width,
                    height=message.height, step=message.row_stride, data=bytes(message.data),
                    encoding=_ENCODINGS[message.pixelformat])


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
