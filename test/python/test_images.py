"""deixis_lcm.images: known answers, there and back, and one broken image per test."""
import zlib

import numpy as np
import pytest
from bot_core import image_t, images_t
from deixis_lcm import images

GRAY, BGR, RGB = image_t.PIXEL_FORMAT_GRAY, image_t.PIXEL_FORMAT_BGR, image_t.PIXEL_FORMAT_RGB
DEPTH = np.arange(12, dtype=np.uint16).reshape(3, 4) * 1000


def colours(rows=3, columns=4):
    return np.arange(rows * columns * 3, dtype=np.uint8).reshape(rows, columns, 3)


def stereo(depth=None):
    depth = images.from_depth_mm(DEPTH, 7) if depth is None else depth
    return images.bundle(7, [(images_t.LEFT, images.from_array(colours(), BGR, 7)),
                             (images_t.DEPTH_MM_ZIPPED, depth)])


@pytest.mark.parametrize("pixelformat, pixels", [
    (GRAY, colours()[:, :, 0]),
    (BGR, colours()),
    (RGB, colours()),
    (image_t.PIXEL_FORMAT_YUYV, colours()[:, :, :2]),
    (image_t.PIXEL_FORMAT_LE_GRAY16, DEPTH),
    (image_t.PIXEL_FORMAT_LE_GRAY16, DEPTH.astype(">u2")),
])
def test_pixels_go_there_and_back_over_the_wire(pixelformat, pixels):
    image = image_t.decode(images.from_array(pixels, pixelformat, 123, sequence=5).encode())
    assert (image.utime, images.sequence_of(image)) == (123, 5)
    np.testing.assert_array_equal(images.to_array(image), pixels)


def test_rows_may_be_padded():
    image = images.from_array(colours(2, 2), BGR, 0)
    image.data = image.data[:6] + b"??" + image.data[6:]
    image.row_stride, image.size = 8, 14
    np.testing.assert_array_equal(images.to_array(image), colours(2, 2))


def test_bgr_has_blue_first_whatever_the_format():
    np.testing.assert_array_equal(images.to_bgr(images.from_array(colours(), BGR, 0)), colours())
    np.testing.assert_array_equal(images.to_bgr(images.from_array(colours(), RGB, 0)), colours()[:, :, ::-1])
    gray = colours()[:, :, 0]
    np.testing.assert_array_equal(images.to_bgr(images.from_array(gray, GRAY, 0)), np.dstack([gray] * 3))


def test_view_is_read_only():
    assert not images.to_array(images.from_array(colours(), BGR, 0)).flags.writeable


def test_depth_is_little_endian_millimetres_zipped():
    image = images.from_depth_mm(DEPTH, 7)
    assert zlib.decompress(image.data) == DEPTH.astype("<u2").tobytes()
    assert image.pixelformat == image_t.PIXEL_FORMAT_INVALID
    np.testing.assert_array_equal(images.depth_mm(images_t.decode(stereo().encode())), DEPTH)


def test_depth_may_be_raw():
    image = images.from_array(DEPTH, image_t.PIXEL_FORMAT_LE_GRAY16, 7)
    image.pixelformat = image_t.PIXEL_FORMAT_INVALID
    np.testing.assert_array_equal(images.depth_mm(images.bundle(7, [(images_t.DEPTH_MM, image)])), DEPTH)


def test_jpeg_stays_bytes():
    image = image_t.decode(images.from_jpeg(b"\xff\xd8\xff\xd9", 640, 480, 9).encode())
    assert (image.width, image.height, image.row_stride, image.size) == (640, 480, 1920, 4)
    assert images.jpeg_bytes(image) == b"\xff\xd8\xff\xd9"
    with pytest.raises(ValueError, match="is a JPEG"):
        images.to_array(image)


def test_find_gives_none_where_there_is_no_such_image():
    assert images.find(stereo(), images_t.LEFT).width == 4
    assert images.find(stereo(), images_t.RIGHT) is None


@pytest.mark.parametrize("field, value, message", [
    ("pixelformat", 1, "pixelformat 1 is not known"),
    ("pixelformat", image_t.PIXEL_FORMAT_INVALID, "a depth image"),
    ("width", 0, "size 0 x 3 is not positive"),
    ("height", -1, "size 4 x -1 is not positive"),
    ("row_stride", 11, "row_stride 11 is less than 4 pixels of 3 bytes"),
    ("height", 4, "data have 36 bytes"),
    ("size", 35, "size says 35"),
    ("data", b"", "data have 0 bytes"),
])
def test_rejects_an_image_that_does_not_fit_together(field, value, message):
    image = images.from_array(colours(), BGR, 0)
    setattr(image, field, value)
    with pytest.raises(ValueError, match=message):
        images.to_array(image)


@pytest.mark.parametrize("field, value, message", [
    ("data", b"nonsense", "does not unzip|size says"),
    ("height", 4, "to the 32 bytes of its geometry"),
    ("height", 2, "to the 16 bytes of its geometry"),
    ("height", -3, "are not positive"),
    ("row_stride", 4, "geometry"),
])
def test_rejects_depth_that_does_not_fit_together(field, value, message):
    depth = images.from_depth_mm(DEPTH, 7)
    setattr(depth, field, value)
    depth.size = len(depth.data)
    with pytest.raises(ValueError, match=message):
        images.depth_mm(stereo(depth))


def test_rejects_depth_that_is_cut_short():
    depth = images.from_depth_mm(DEPTH, 7)
    depth.data = depth.data[:-3]
    depth.size = len(depth.data)
    with pytest.raises(ValueError, match="geometry"):
        images.depth_mm(stereo(depth))


def test_rejects_images_without_depth():
    with pytest.raises(ValueError, match="no depth image"):
        images.depth_mm(images.bundle(0, []))


def test_rejects_counts_that_disagree():
    broken = stereo()
    broken.n_images = 1
    with pytest.raises(ValueError, match="n_images is 1"):
        images.find(broken, images_t.LEFT)


@pytest.mark.parametrize("pixels, pixelformat, message", [
    (colours().astype(float), BGR, "float64"),
    (colours()[:, :, 0], BGR, "shape"),
    (colours()[:, :, :2], BGR, "2 channels"),
    (colours(), GRAY, "shape"),
    (np.zeros((0, 4), np.uint8), GRAY, "shape"),
    (colours(), image_t.PIXEL_FORMAT_MJPEG, "is not a raw one"),
])
def test_rejects_pixels_that_are_none(pixels, pixelformat, message):
    with pytest.raises(ValueError, match=message):
        images.from_array(pixels, pixelformat, 0)


def test_rejects_what_is_no_jpeg():
    with pytest.raises(ValueError, match="JPEG"):
        images.from_jpeg(b"GIF89a", 1, 1, 0)
    with pytest.raises(ValueError, match="not MJPEG"):
        images.jpeg_bytes(images.from_array(colours(), BGR, 0))


@pytest.mark.parametrize("image", [
    images.from_array(colours(), BGR, 7, sequence=3, camera="left"),
    images.from_jpeg(b"\xff\xd8\xff\xd9", 640, 480, 7, sequence=3, camera="left"),
])
def test_camera_and_sequence_go_with_the_image(image):
    image = image_t.decode(image.encode())
    assert (images.camera_of(image), images.sequence_of(image)) == ("left", 3)


def test_camera_is_none_without_metadata_and_an_error_if_no_text():
    assert images.camera_of(images.from_array(colours(), BGR, 0, sequence=1)) is None
    image = images.from_array(colours(), BGR, 0, camera="left")
    assert images.sequence_of(image) is None
    image.metadata[0].value = b"\xff"
    with pytest.raises(ValueError, match="no UTF-8"):
        images.camera_of(image)


def test_sequence_is_none_without_metadata_and_an_error_if_no_number():
    image = images.from_array(colours(), BGR, 0)
    assert images.sequence_of(image) is None
    image = images.from_array(colours(), BGR, 0, sequence=1)
    image.metadata[0].value = b"one"
    with pytest.raises(ValueError, match="no number"):
        images.sequence_of(image)
