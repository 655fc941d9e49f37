"""A dimos robot's own package publishes; the drivers give what its camera sees, and where it is, to Deixis."""

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
from dimos_lcm.geometry_msgs import Quaternion, Transform, TransformStamped, Vector3
from dimos_lcm.sensor_msgs import CameraInfo, CompressedImage, Image
from dimos_lcm.std_msgs import Header, Time
from dimos_lcm.tf2_msgs import TFMessage
from listener import Listener
from PIL import Image as Picture

IMAGES = "/color_image#sensor_msgs.Image"
COMPRESSED = "/color_image/compressed"
DEPTH = "/depth_image#sensor_msgs.Image"
LENS = "/camera_info#sensor_msgs.CameraInfo"
TRANSFORMS = "/tf#tf2_msgs.TFMessage"
UTIME = 1_700_000_000_123_456
WIDTH, HEIGHT = 64, 48
MOST_JPEG_ERROR = 6.0  # Mean, of 255; colours that are swapped differ by far more.


def header(frame: str = "camera_optical", utime: int = UTIME) -> Header:
    seconds, microseconds = divmod(utime, 1_000_000)
    return Header(stamp=Time(sec=seconds, nsec=1000 * microseconds + 789), frame_id=frame)


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


def transform(parent: str, child: str, place_m: tuple[float, float, float],
              wxyz: tuple[float, float, float, float], utime: int) -> TransformStamped:
    w, x, y, z = wxyz
    return TransformStamped(
        header=header(parent, utime), child_frame_id=child,
        transform=Transform(translation=Vector3(*place_m), rotation=Quaternion(x, y, z, w)))


def transforms(*links: TransformStamped) -> TFMessage:
    return TFMessage(transforms=list(links), transforms_length=len(links))


def robot() -> TFMessage:
    """base_link stands 1 m ahead of world; the camera, 1.2 m above base_link, looks ahead."""
    return transforms(
        transform("world", "base_link", (1.0, 0.0, 0.0), (1.0, 0.0, 0.0, 0.0), UTIME + 5),
        transform("base_link", "camera_link", (0.1, 0.0, 1.2), (1.0, 0.0, 0.0, 0.0), UTIME + 2),
        transform("camera_link", "camera_optical", (0.0, 0.0, 0.0), (0.5, -0.5, 0.5, -0.5), UTIME))


@contextmanager
def driver(build: Path, url: str, *settings: str, name: str = "camera") -> Iterator[None]:
    """The camera driver, or the stereo driver, listening to the robot's channels."""
    options = [word for setting in ("source.kind=dimos", *settings) for word in ("--set", setting)]
    with subprocess.Popen([build / f"bin/deixis-{name}-driver", "-l", url, *options]) as process:
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


DRIVERS = {
    "camera": ("calibration.mount", {IMAGES: lambda: raw("rgb8", rgb())}),
    "stereo": ("depth_camera.calibration.mount",
               {IMAGES: lambda: raw("rgb8", rgb()),
                DEPTH: lambda: raw("16UC1", np.full((HEIGHT, WIDTH), 1500, np.uint16))}),
}


@pytest.mark.parametrize("name", DRIVERS)
def test_transforms_of_a_robot_become_the_pose_of_its_camera(build: Path, url: str, name: str) -> None:
    from bot_core import rigid_transform_t
    mount, pictures = DRIVERS[name]
    listener = Listener(url, CAMERA_POSE=rigid_transform_t)
    messages = {channel: make() for channel, make in pictures.items()} | {TRANSFORMS: robot()}
    with driver(build, url, f"{mount}.parent_frame=base_link", name=name):
        pose = ask(url, listener, messages, "CAMERA_POSE")
    assert pose.utime == UTIME + 2  # world is not in the chain.
    assert pose.trans == pytest.approx((0.1, 0.0, 1.2))
    assert pose.quat == pytest.approx((0.5, -0.5, 0.5, -0.5))


def test_chain_may_go_up_and_down(build: Path, url: str) -> None:
    from bot_core import rigid_transform_t
    listener = Listener(url, CAMERA_POSE=rigid_transform_t)
    messages = {TRANSFORMS: transforms(
        transform("world", "base_link", (1.0, 0.0, 0.0), (1.0, 0.0, 0.0, 0.0), UTIME),
        transform("world", "wall_camera", (4.0, 2.0, 1.0), (1.0, 0.0, 0.0, 0.0), UTIME))}
    with driver(build, url, "calibration.mount.parent_frame=base_link",
                "dimos.camera_frame=wall_camera"):
        pose = ask(url, listener, messages, "CAMERA_POSE")
    assert pose.trans == pytest.approx((3.0, 2.0, 1.0))


def test_mount_is_published_with_the_lens_of_a_robot(build: Path, url: str) -> None:
    from deixis import camera_calibration_t
    listener = Listener(url, CAMERA_CALIBRATION=camera_calibration_t)
    with driver(build, url, "calibration.mount.parent_frame=base_link",
                "calibration.mount.translation_m=[0.1, 0, 1.2]",
                "calibration.mount.rotation_wxyz=[0.5, -0.5, 0.5, -0.5]"):
        answer = ask(url, listener, {LENS: lens(), IMAGES: raw("rgb8", rgb())}, "CAMERA_CALIBRATION")
    assert (answer.has_mount, answer.parent_frame) == (True, "base_link")
    assert answer.parent_from_camera.translation_m == (0.1, 0.0, 1.2)
    assert answer.parent_from_camera.rotation_wxyz == (0.5, -0.5, 0.5, -0.5)


def test_link_that_lacks_is_said(build: Path, url: str) -> None:
    from deixis import service_status_t
    listener = Listener(url, SERVICE_STATUS=service_status_t)
    bus = lcm.LCM(url)
    broken = robot()
    del broken.transforms[1]
    broken.transforms_length = 2

    def says_so() -> bool:
        bus.publish(IMAGES, raw("rgb8", rgb()).lcm_encode())
        bus.publish(TRANSFORMS, broken.lcm_encode())
        listener.hears("SERVICE_STATUS", 1, 2.0)
        return any("no transform leads from 'world' (above 'base_link') to 'camera_link'"
                   " (above 'camera_optical')" in status.text and status.state == status.DEGRADED
                   for status in listener.heard["SERVICE_STATUS"])

    with driver(build, url, "calibration.mount.parent_frame=base_link"):
        assert becomes_true(says_so, 30.0)


def test_mount_that_is_none_is_refused_by_its_key(build: Path) -> None:
    refused = subprocess.run(
        [build / "bin/deixis-camera-driver", "--set", "source.kind=dimos", "--set",
         "calibration.mount.parent_frame=base_link", "--set",
         "calibration.mount.rotation_wxyz=[1, 1, 0, 0]"],
        capture_output=True, text=True, timeout=30, check=False)
    assert refused.returncode == 1
    assert "calibration.mount.rotation_wxyz" in refused.stderr
    assert "[0.5, -0.5, 0.5, -0.5]" in refused.stderr
