"""The pictures of kinect.frame_msg_t: colour as it is, depth in millimetres."""

from __future__ import annotations

from typing import Any

import numpy as np
from bot_core import image_t, images_t
from foxglove_schemas_protobuf.CompressedImage_pb2 import CompressedImage
from foxglove_schemas_protobuf.RawImage_pb2 import RawImage
from kinect import depth_msg_t, image_msg_t

from deixis_frontend.export import pictures
from deixis_frontend.export.times import own_or
from deixis_lcm import images

_CAMERA = "kinect"  # as services call it
_DEPTH_CAMERA = "kinect_depth"  # another place and lens; registered depth is in the colour camera
_ENCODINGS = {
    image_msg_t.VIDEO_RGB: "rgb8",
    image_msg_t.VIDEO_BAYER: "bayer_grbg8",
    image_msg_t.VIDEO_IR_8BIT: "mono8",
    image_msg_t.VIDEO_IR_10BIT: "mono16",
    image_msg_t.VIDEO_YUV_RAW: "uyvy",
}
_COLOURS = {image_msg_t.VIDEO_RGB_JPEG, *_ENCODINGS}
_DEPTHS = {depth_msg_t.DEPTH_MM, depth_msg_t.DEPTH_REGISTERED, depth_msg_t.DEPTH_11BIT}
_ROLES = {depth_msg_t.COMPRESSION_NONE: images_t.DEPTH_MM,
          depth_msg_t.COMPRESSION_ZLIB: images_t.DEPTH_MM_ZIPPED}
_NO_READING = 2047  # of 11 bits


def has_colour(message: Any) -> bool:
    """Whether colour() reads what the frame_msg_t has."""
    return message.image.image_data_format in _COLOURS


def has_depth(message: Any) -> bool:
    """Whether depth() reads what the frame_msg_t has."""
    return message.depth.depth_data_format in _DEPTHS


def unread(message: Any) -> list[str]:
    """What the frame_msg_t has and nothing here reads, or that it has nothing, for people."""
    colour, depth_format = message.image.image_data_format, message.depth.depth_data_format
    has_no_colour, has_no_depth = (colour == image_msg_t.VIDEO_NONE,
                                   depth_format == depth_msg_t.DEPTH_NONE)
    if has_no_colour and has_no_depth:
        return ["frame_msg_t without pictures"]
    words = []
    if not (has_no_colour or has_colour(message)):
        words.append(f"colour images of format {colour}")
    if not (has_no_depth or has_depth(message)):
        words.append(f"depth images of format {depth_format}")
    return words


def colour(message: Any) -> CompressedImage | RawImage:
    """The colour or infrared image; ValueError if its sizes do not fit together."""
    image = message.image
    utime = own_or(image.timestamp, message.timestamp)
    data = bytes(image.image_data)
    if image.image_data_format == image_msg_t.VIDEO_RGB_JPEG:
        return pictures.file(data, "jpeg", _CAMERA, utime)
    return pictures.raw(image, _ENCODINGS[image.image_data_format], data, _CAMERA, utime)


def depth(message: Any) -> RawImage:
    """The depth image, unzipped: 16 bit, millimetres, 0 = none; ValueError as pictures.depth().

    The sensor's own 11 bits become millimetres.
    """
    source = message.depth
    is_registered = source.depth_data_format == depth_msg_t.DEPTH_REGISTERED
    made = pictures.depth(_as_bundle(source, own_or(source.timestamp, message.timestamp)),
                          _CAMERA if is_registered else _DEPTH_CAMERA)
    if source.depth_data_format == depth_msg_t.DEPTH_11BIT:
        readings = np.frombuffer(made.data, "<u2")
        made.data = _MILLIMETRES[np.minimum(readings, _NO_READING)].tobytes()
    return made


def _as_bundle(depth_image: Any, utime: int) -> images_t:
    if depth_image.compression not in _ROLES:
        raise ValueError(f"compression {depth_image.compression} of depth is not known")
    image = image_t()
    image.width, image.height = depth_image.width, depth_image.height
    image.row_stride = 2 * image.width
    image.data, image.size = depth_image.depth_data, len(depth_image.depth_data)
    return images.bundle(utime, [(_ROLES[depth_image.compression], image)])


def _millimetres_of_11_bits() -> np.ndarray:
    """S. Magnenat's fit, z = 0.1236 m * tan(raw / 2842.5 + 1.1863), as OpenKinect publishes it."""
    z_mm = 123.6 * np.tan(np.arange(_NO_READING + 1) / 2842.5 + 1.1863)
    is_depth = (z_mm > 0.0) & (z_mm <= np.iinfo(np.uint16).max)
    is_depth[_NO_READING] = False
    return np.where(is_depth, np.floor(z_mm + 0.5), 0.0).astype("<u2")


_MILLIMETRES = _millimetres_of_11_bits()
