"""A dimos robot's own package publishes; the camera driver gives its pictures and its lens to Deixis."""

from __future__ import annotations

import subprocess
from collections.abc import Iterator
from contextlib import contextmanager
from io import BytesIO
from pathlib import Path
from typing import Any

import lcm
import numpy as np
import pytest
from bench import becomes_true
from dimos_lcm.sensor_msgs import CameraInfo, CompressedImage, Image
from dimos_lcm.std_msgs import Header, Time
from listener import Listener
from PIL import Image as Picture

IMAGES = "/color_image#sensor_msgs.Image"
COMPRESSED = "/color_image/compressed"
LENS = "/camera_info#sensor_msgs.CameraInfo"
UTIME = 1_700_000_000_123_456
WIDTH, HEIGHT = 64, 48
MOST_JPEG_ERROR = 6.0  # Mean, of 255; colours that are swapped differ by far more.


def header() -> Header:
    seconds, microseconds = divmod(UTIME, 1_000_000)
    return Header(stamp=Time(sec=seconds, nsec=1000 * microseconds + 789), frame_id="camera_optical")


def rgb() -> np.ndarray:
    """A picture with no symmetry in place or colour."""
    rows, columns = np.mgrid[0:HEIGHT, 0:WIDTH]
    return np.dstack([3 * columns, 4 * rows, np.full_like(rows, 40)]).astype(np.uint8)


def raw(encoding: str, pixels: np.ndarray) -> Image:
    data = pixels.tobytes()
    return Image(header=header(), height=HEIGHT, width=WIDTH, encoding=encoding, is_bigendian=0,
                 step=len(data) // HEIGHT, data=data, data_length=len(data))


def jpeg() -> bytes:
    file = BytesIO()
    Picture.fromarray(rgb()).save(file, "JPEG", quality=95)
    return file.getvalue()


def compressed() -> CompressedImage:
    return CompressedImage(header=header(), format="jpeg", data=jpeg(), data_length=len(jpeg()))


def jpeg_as_image() -> Image:
    message = raw("jpeg", rgb())
    message.data, message.step = jpeg(), 0
    message.data_length = len(message.data)
    return message


def lens() -> CameraInfo:
    return CameraInfo(header=header(), height=HEIGHT, width=WIDTH, distortion_model="plumb_bob",
                      D=[0.1, -0.2, 0.001, 0.002, 0.03], D_length=5,
                      K=[70.0, 0.0, 31.5, 0.0, 71.0, 23.5, 0.0, 0.0, 1.0],
                      R=[1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0])


@contextmanager
def driver(build: Path, url: str, *settings: str) -> Iterator[None]:
    """The camera driver, listening to the robot's channels."""
    options = [word for setting in ("source.kind=dimos", *settings) for word in ("--set", setting)]
    with subprocess.Popen([build / "bin/deixis-camera-driver", "-l", url, *options]) as process:
        try:
            yield
        finally:
            process.terminate()


def ask(url: str, listener: Listener, messages: dict[str, Any], wanted: str) -> Any:
    """Publishes until there is an answer: the program subscribes at some time after its start."""
    robot = lcm.LCM(url)

    def answered() -> bool:
        for channel, message in messages.items():
            robot.publish(channel, message.lcm_encode())
        return listener.hears(wanted, 1, 0.3)

    assert becomes_true(answered, 30.0)
    return listener.heard[wanted][-1]


PICTURES = {
    "rgb8": (IMAGES, lambda: raw("rgb8", rgb())),
    "bgr8": (IMAGES, lambda: raw("bgr8", rgb()[..., ::-1])),
    "jpeg": (IMAGES, jpeg_as_image),
    "compressed": (COMPRESSED, compressed),
}


@pytest.mark.parametrize("kind", PICTURES)
def test_picture_of_a_robot_is_published_with_its_time(build: Path, url: str, kind: str) -> None:
    from bot_core import image_t
    channel, make = PICTURES[kind]
    listener = Listener(url, CAMERA=image_t)
    with driver(build, url, f"dimos.image_channel={channel}"):
        image = ask(url, listener, {channel: make()}, "CAMERA")
    assert (image.utime, image.width, image.height) == (UTIME, WIDTH, HEIGHT)
    assert image.pixelformat == image.PIXEL_FORMAT_MJPEG
    pixels = np.asarray(Picture.open(BytesIO(image.data)).convert("RGB"), dtype=float)
    assert np.abs(pixels - rgb()).mean() < MOST_JPEG_ERROR


def test_lens_of_a_robot_is_published(build: Path, url: str) -> None:
    from deixis import camera_calibration_t
    listener = Listener(url, CAMERA_CALIBRATION=camera_calibration_t)

    def has_lens(answer: camera_calibration_t) -> bool:
        return bool(answer.is_calibrated)

    with driver(build, url, "camera=HEAD"):
        messages = {LENS: lens(), IMAGES: raw("rgb8", rgb())}
        assert becomes_true(
            lambda: has_lens(ask(url, listener, messages, "CAMERA_CALIBRATION")), 30.0)
    answer = listener.heard["CAMERA_CALIBRATION"][-1]
    assert (answer.camera, answer.utime) == ("HEAD", UTIME)
    assert (answer.width_px, answer.height_px) == (WIDTH, HEIGHT)
    assert (answer.focal_px, answer.principal_point_px) == ((70.0, 71.0), (31.5, 23.5))
    assert (answer.distortion_model, tuple(answer.distortion)) == (
        "plumb_bob", (0.1, -0.2, 0.001, 0.002, 0.03))


def test_silence_of_a_robot_is_said(build: Path, url: str) -> None:
    from deixis import service_status_t
    listener = Listener(url, SERVICE_STATUS=service_status_t)

    def says_so() -> bool:
        listener.hears("SERVICE_STATUS", 1, 2.0)
        return any(f"no picture yet on '{IMAGES}'" in status.text and status.state == status.DEGRADED
                   for status in listener.heard["SERVICE_STATUS"])

    with driver(build, url):
        assert becomes_true(says_so, 30.0)
