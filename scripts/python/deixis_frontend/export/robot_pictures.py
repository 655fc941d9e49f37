"""Pictures of dimos robots: sensor_msgs.Image and sensor_msgs.CompressedImage."""

from __future__ import annotations

from typing import Any

import numpy as np
from foxglove_schemas_protobuf.CompressedImage_pb2 import CompressedImage
from foxglove_schemas_protobuf.RawImage_pb2 import RawImage

from deixis_frontend.export import pictures
from deixis_frontend.export.times import of_header

_JPEGS = ("jpeg", "jpg")
_FORMATS = {"jpeg": "jpeg", "jpg": "jpeg", "png": "png"}  # word in `format` -> Foxglove's
_DEPTHS = ("16UC1", "32FC1")  # millimetres, metres
_SAMPLES = {"mono16": "u2", "16UC1": "u2", "32FC1": "f4"}  # wider than a byte


def is_depth(message: Any) -> bool:
    """Whether an Image is depth, in millimetres (16UC1) or metres (32FC1)."""
    return message.encoding in _DEPTHS


def picture(message: Any, frame: str) -> CompressedImage | RawImage:
    """An Image, low byte first; ValueError if its sizes or its encoding make no sense."""
    utime, data = of_header(message.header), bytes(message.data)
    if message.encoding in _JPEGS:
        return pictures.file(data, "jpeg", frame, utime)
    made = pictures.raw(message, message.encoding, data, frame, utime, step=message.step)
    if message.is_bigendian and message.encoding in _SAMPLES:
        made.data = _low_byte_first(made, _SAMPLES[message.encoding])
    return made


def compressed(message: Any, frame: str) -> CompressedImage:
    """A CompressedImage; ValueError if it is neither a JPEG nor a PNG file."""
    # "jpeg" alone, or as ROS has it: "rgb8; jpeg compressed bgr8".
    for word, name in _FORMATS.items():
        if word in message.format:
            return pictures.file(bytes(message.data), name, frame, of_header(message.header))
    raise ValueError(f"format '{message.format[:pictures.MOST_SHOWN]}' is neither JPEG nor PNG")


def _low_byte_first(image: RawImage, sample: str) -> bytes:
    shape, strides = (image.height, image.width), (image.step, np.dtype(sample).itemsize)
    data = bytearray(image.data)
    turned = np.ndarray(shape, f"<{sample}", data, strides=strides)
    turned[:] = np.ndarray(shape, f">{sample}", image.data, strides=strides)
    return bytes(data)
