"""bot_core.image_t and bot_core.images_t as numpy arrays and back. JPEG stays bytes: no codec is needed here.

Shapes are (rows, columns[, channels]). Depth is uint16, millimetres along the optical axis, 0 = none. Times are
microseconds. What does not fit together raises ValueError.
"""
import zlib

import numpy as np
from bot_core import image_metadata_t, image_t, images_t

CAMERA_KEY = "deixis.camera"
SEQUENCE_KEY = "deixis.sequence"
DEPTH_TYPES = (images_t.DEPTH_MM, images_t.DEPTH_MM_ZIPPED)

# pixelformat -> (element type, channels)
_LAYOUTS = {
    image_t.PIXEL_FORMAT_GRAY: (np.dtype("u1"), 1),
    image_t.PIXEL_FORMAT_RGB: (np.dtype("u1"), 3),
    image_t.PIXEL_FORMAT_BGR: (np.dtype("u1"), 3),
    image_t.PIXEL_FORMAT_YUYV: (np.dtype("u1"), 2),
    image_t.PIXEL_FORMAT_LE_GRAY16: (np.dtype("<u2"), 1),
}


def to_array(image):
    """The pixels of a raw image as a read-only view, channels in stored order.

    GRAY (rows, columns) uint8; RGB and BGR (rows, columns, 3) uint8; YUYV (rows, columns, 2) uint8;
    LE_GRAY16 (rows, columns) uint16. ValueError for JPEG, for a format that is not known, and where
    width, height, row_stride and size do not fit together.
    """
    if image.pixelformat == image_t.PIXEL_FORMAT_MJPEG:
        raise ValueError("image is a JPEG: take jpeg_bytes() and decode it")
    if image.pixelformat not in _LAYOUTS:
        raise ValueError(f"pixelformat {image.pixelformat} is not known" + (
            " (a depth image: take depth_mm())" if image.pixelformat == image_t.PIXEL_FORMAT_INVALID else ""))
    return _pixels(image, bytes(image.data), *_LAYOUTS[image.pixelformat])


def to_bgr(image):
    """A raw BGR, RGB or GRAY image as (rows, columns, 3) uint8, blue first; a read-only view. ValueError otherwise."""
    pixels = to_array(image)
    if image.pixelformat == image_t.PIXEL_FORMAT_BGR:
        return pixels
    if image.pixelformat == image_t.PIXEL_FORMAT_RGB:
        return pixels[:, :, ::-1]
    if image.pixelformat == image_t.PIXEL_FORMAT_GRAY:
        return np.broadcast_to(pixels[:, :, np.newaxis], (*pixels.shape, 3))
    raise ValueError(f"pixelformat {image.pixelformat} is neither BGR, RGB nor GRAY")


def from_array(pixels, pixelformat, utime, sequence=None, camera=None):
    """image_t from pixels of the shape and type that to_array() returns for `pixelformat`.

    `utime` is the capture time, microseconds; `sequence` and `camera` (which one the pixels belong to), where
    given, become the metadata deixis.sequence and deixis.camera. ValueError if shape, type and format do not
    fit.
    """
    if pixelformat not in _LAYOUTS:
        raise ValueError(f"pixelformat {pixelformat} is not a raw one that is known")
    element, channels = _LAYOUTS[pixelformat]
    _check_array(pixels, element, (2,) if channels == 1 else (3,))
    if channels != 1 and pixels.shape[2] != channels:
        raise ValueError(f"pixels have {pixels.shape[2]} channels, pixelformat {pixelformat} has {channels}")
    return _image(pixels.shape, element.itemsize * channels, pixelformat,
                  np.ascontiguousarray(pixels, element).tobytes(), utime, sequence, camera)


def from_jpeg(jpeg, width, height, utime, sequence=None, channels=3, camera=None):
    """image_t from one JPEG file (bytes); width and height are those of the picture, pixels.

    `utime`, `sequence` and `camera` as in from_array(). ValueError if it is no JPEG.
    """
    if not bytes(jpeg[:2]) == b"\xff\xd8":
        raise ValueError("data do not begin like a JPEG file")
    if width <= 0 or height <= 0:
        raise ValueError(f"size {width} x {height} is not positive")
    return _image((height, width), channels, image_t.PIXEL_FORMAT_MJPEG, bytes(jpeg), utime, sequence,
                  camera)


def jpeg_bytes(image):
    """The JPEG file in an MJPEG image, bytes. ValueError if the image is no JPEG or cut short."""
    if image.pixelformat != image_t.PIXEL_FORMAT_MJPEG:
        raise ValueError(f"pixelformat {image.pixelformat} is not MJPEG")
    data = bytes(image.data)
    if len(data) != image.size or data[:2] != b"\xff\xd8":
        raise ValueError(f"data ({len(data)} bytes, size says {image.size}) are no JPEG file")
    return data


def sequence_of(image):
    """The metadata deixis.sequence as int; None where there is none. ValueError if it is no number."""
    value = _metadata(image, SEQUENCE_KEY)
    try:
        return None if value is None else int(value)
    except ValueError:
        raise ValueError(f"metadata {SEQUENCE_KEY} is {value!r}, no number") from None


def camera_of(image):
    """The metadata deixis.camera as str; None where there is none. ValueError if it is no UTF-8."""
    value = _metadata(image, CAMERA_KEY)
    try:
        return None if value is None else value.decode()
    except UnicodeDecodeError:
        raise ValueError(f"metadata {CAMERA_KEY} is {value!r}, no UTF-8") from None


def find(images, image_type):
    """The first image of a type (images_t.LEFT, ...) in images_t; None where there is none."""
    _check_images(images)
    for kind, image in zip(images.image_types, images.images):
        if kind == image_type:
            return image
    return None


def depth_mm(images):
    """The depth image of images_t, DEPTH_MM or DEPTH_MM_ZIPPED, as (rows, columns) uint16, millimetres, 0 = none.

    Read-only. ValueError if there is none, if it does not unzip, or if its sizes do not fit together.
    """
    _check_images(images)
    for kind, image in zip(images.image_types, images.images):
        if kind == images_t.DEPTH_MM:
            return _pixels(image, bytes(image.data), np.dtype("<u2"), 1)
        if kind == images_t.DEPTH_MM_ZIPPED:
            return _pixels(image, _unzip(image), np.dtype("<u2"), 1, is_zipped=True)
    raise ValueError(f"images hold no depth image (types {list(images.image_types)})")


def from_depth_mm(depth, utime, level=1):
    """A DEPTH_MM_ZIPPED image from (rows, columns) uint16 millimetres; `level` is zlib's, 1 (fast) to 9."""
    _check_array(depth, np.dtype("u2"), (2,))
    packed = zlib.compress(np.ascontiguousarray(depth, "<u2").tobytes(), level)
    return _image(depth.shape, 2, image_t.PIXEL_FORMAT_INVALID, packed, utime)


def bundle(utime, typed_images):
    """images_t from pairs (type, image_t), as in bundle(t, [(images_t.LEFT, left), (images_t.DEPTH_MM_ZIPPED, d)])."""
    images = images_t()
    images.utime = utime
    images.image_types = [kind for kind, _ in typed_images]
    images.images = [image for _, image in typed_images]
    images.n_images = len(images.images)
    return images


def _pixels(image, data, element, channels, *, is_zipped=False):
    rows, columns, stride = image.height, image.width, image.row_stride
    pixel = element.itemsize * channels
    if rows <= 0 or columns <= 0:
        raise ValueError(f"size {columns} x {rows} is not positive")
    if stride < columns * pixel:
        raise ValueError(f"row_stride {stride} is less than {columns} pixels of {pixel} bytes")
    if not is_zipped and len(data) != image.size:
        raise ValueError(f"data have {len(data)} bytes, size says {image.size}")
    needed = (rows - 1) * stride + columns * pixel
    if len(data) < needed:
        raise ValueError(f"data have {len(data)} bytes, {columns} x {rows} at row_stride {stride} needs {needed}")
    shape, strides = (rows, columns), (stride, pixel)
    if channels > 1:
        shape, strides = (*shape, channels), (*strides, element.itemsize)
    return np.ndarray(shape, element, data, strides=strides)


def _unzip(image):
    # Never more than the geometry asks for: a few bytes can unzip to gigabytes.
    expected = image.row_stride * image.height
    if expected <= 0:
        raise ValueError(f"row_stride {image.row_stride} and height {image.height} are not positive")
    if len(image.data) != image.size:
        raise ValueError(f"data have {len(image.data)} bytes, size says {image.size}")
    try:
        unzip = zlib.decompressobj()
        data = unzip.decompress(bytes(image.data), expected + 1)
    except zlib.error as error:
        raise ValueError(f"depth does not unzip: {error}") from None
    if len(data) != expected or not unzip.eof:
        raise ValueError(f"depth does not unzip to the {expected} bytes of its geometry")
    return data


def _check_array(pixels, element, dimensions):
    if pixels.ndim not in dimensions or 0 in pixels.shape:
        raise ValueError(f"shape {pixels.shape} does not fit")
    if pixels.dtype.newbyteorder("=") != element.newbyteorder("="):
        raise ValueError(f"pixels are {pixels.dtype}, must be {element}")


def _check_images(images):
    if not images.n_images == len(images.image_types) == len(images.images):
        raise ValueError(f"n_images is {images.n_images}, but there are {len(images.image_types)} types "
                         f"and {len(images.images)} images")


def _metadata(image, key):
    return next((bytes(metadata.value) for metadata in image.metadata if metadata.key == key), None)


def _add_metadata(image, key, value):
    metadata = image_metadata_t()
    metadata.key, metadata.value, metadata.n = key, value, len(value)
    image.metadata = [*image.metadata, metadata]
    image.nmetadata = len(image.metadata)


def _image(shape, pixel_bytes, pixelformat, data, utime, sequence=None, camera=None):
    image = image_t()
    image.utime = utime
    image.height, image.width = shape[:2]
    image.row_stride = image.width * pixel_bytes
    image.pixelformat = pixelformat
    image.data, image.size = data, len(data)
    if sequence is not None:
        _add_metadata(image, SEQUENCE_KEY, str(sequence).encode())
    if camera is not None:
        _add_metadata(image, CAMERA_KEY, camera.encode())
    return image
