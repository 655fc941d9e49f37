"""Whatever way depth comes, the stereo driver ends in the same: picture and depth on STEREO."""

from __future__ import annotations

import subprocess
import zlib
from collections.abc import Iterator
from contextlib import contextmanager
from io import BytesIO
from pathlib import Path
from typing import Any

import lcm
import numpy as np
import pytest
from bench import becomes_true
from dimos_lcm.sensor_msgs import CameraInfo, Image
from dimos_lcm.std_msgs import Header, Time
from listener import Listener
from PIL import Image as Picture
from rig_files import BASELINE_M, FOCAL_PX, HEIGHT, WIDTH, write_rig

DISPARITY_PX = 16
DISTANCE_MM = 1000 * FOCAL_PX * BASELINE_M / DISPARITY_PX
MOST_ERROR_MM = 20  # A tenth of a pixel of the half-size pictures that are matched.
MOST_JPEG_ERROR = 10.0  # Mean, of 255; colours that are swapped differ by some 50.
UTIME = 1_700_000_000_000_000
PERIOD_US = 100_000
FRAMES = 5
COLOUR = "/color_image#sensor_msgs.Image"
DEPTH = "/depth_image#sensor_msgs.Image"
LENS = "/camera_info#sensor_msgs.CameraInfo"


def wall() -> np.ndarray:
    """What both cameras look at: patches of 16 pixels in colour, and grey ones of 2."""
    random = np.random.default_rng(3)
    coarse = random.integers(0, 160, (HEIGHT // 16, WIDTH // 16 + 1, 3)).repeat(16, 0).repeat(16, 1)
    fine = random.integers(0, 90, (HEIGHT // 2, WIDTH // 2 + 8, 1)).repeat(2, 0).repeat(2, 1)
    return (coarse + fine).astype(np.uint8)


def left() -> np.ndarray:
    return wall()[:, :WIDTH]


def right() -> np.ndarray:
    return wall()[:, DISPARITY_PX:]


def depth_mm() -> np.ndarray:
    return np.full((HEIGHT, WIDTH), DISTANCE_MM, np.uint16)


def write_folders(folder: Path, second: np.ndarray) -> list[str]:
    """The left picture and a second one, some times; returns the settings that name them."""
    for side, pixels in (("left", left()), ("right", second)):
        (folder / side).mkdir()
        for number in range(FRAMES):
            Picture.fromarray(pixels).save(folder / side / f"{number}.png")
    return [setting for side in ("left", "right") for setting in (
        f"source.{side}.kind=folder", f"source.{side}.path={folder / side}",
        f"source.{side}.rate_hz={1_000_000 / PERIOD_US}")] + [f"start_time_utime={UTIME}"]


class Driver:
    """The stereo driver at work, and what it says."""

    def __init__(self, url: str) -> None:
        from bot_core import images_t
        from deixis import service_status_t, stereo_calibration_t
        self._url = url
        self._listener = Listener(url, STEREO=images_t, STEREO_PAIR=images_t,
                                  STEREO_CALIBRATION=stereo_calibration_t,
                                  SERVICE_STATUS=service_status_t)
        self.heard = self._listener.heard

    def comes(self, channel: str) -> Any:
        """The next message on a channel."""
        assert self._listener.hears(channel, 1, 30.0), f"nothing on {channel}"
        return self.heard[channel][-1]

    def play(self, log: Path) -> None:
        """Replays a log once the driver listens."""
        self.comes("SERVICE_STATUS")
        with subprocess.Popen(["lcm-logplayer", f"--lcm-url={self._url}", log],
                              stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL):
            self.comes("STEREO")

    def publish(self, messages: dict[str, Any]) -> None:
        """Says what a robot would, until there is an answer."""
        robot = lcm.LCM(self._url)

        def answered() -> bool:
            for channel, message in messages.items():
                robot.publish(channel, message.lcm_encode())
            return self._listener.hears("STEREO", 1, 0.3)

        assert becomes_true(answered, 30.0)


@contextmanager
def driver(build: Path, url: str, settings: list[str]) -> Iterator[Driver]:
    """Runs the stereo driver; it has ended when the block has."""
    options = [word for setting in settings for word in ("--set", setting)]
    heard = Driver(url)
    with subprocess.Popen([build / "bin/deixis-stereo-driver", "-l", url, *options]) as process:
        try:
            yield heard
        finally:
            process.terminate()


def assert_is_the_wall(heard: Driver) -> None:
    """What all ways must end in: the left picture in colour, and the depth of the same view."""
    from bot_core import images_t
    images = heard.heard["STEREO"][-1]
    assert list(images.image_types) == [images_t.LEFT, images_t.DEPTH_MM_ZIPPED]
    picture, depth = images.images
    assert picture.utime == depth.utime == images.utime
    assert (images.utime - UTIME) % PERIOD_US == 0, "the time of the capture"
    pixels = np.asarray(Picture.open(BytesIO(picture.data)).convert("RGB"), dtype=float)
    assert np.abs(pixels - left()).mean() < MOST_JPEG_ERROR
    assert (depth.width, depth.height) == (WIDTH // 2, HEIGHT // 2)
    measured = np.frombuffer(zlib.decompress(depth.data), "<u2").reshape(depth.height, depth.width)
    middle = measured[10:-10, DISPARITY_PX:-10].astype(int)
    assert (middle > 0).mean() > 0.98
    assert np.abs(middle[middle > 0] - DISTANCE_MM).max() < MOST_ERROR_MM
    calibration = heard.heard["STEREO_CALIBRATION"][-1]
    assert calibration.rectified.focal_px[0] == pytest.approx(FOCAL_PX, rel=0.02)
    assert len(images.encode()) < 180_000


def record_pairs(build: Path, url: str, folder: Path) -> Path:
    """A log of the pairs of two recordings, as the driver passes them on."""
    recorded = folder / "recorded"
    recorded.mkdir()
    settings = [*write_rig(recorded), *write_folders(recorded, right()), "publishes_pairs=true"]
    with driver(build, url, settings) as heard:
        heard.comes("STEREO_PAIR")
        heard.comes("STEREO")
    return write_log(folder / "pairs.lcmlog", "STEREO_PAIR", heard.heard["STEREO_PAIR"][0].encode())


def kinect_frame() -> bytes:
    from kinect import depth_msg_t, frame_msg_t, image_msg_t
    message = frame_msg_t()
    message.timestamp = message.image.timestamp = message.depth.timestamp = UTIME
    image, depth = message.image, message.depth
    image.width, image.height, image.image_data_format = WIDTH, HEIGHT, image_msg_t.VIDEO_RGB
    image.image_data = left().tobytes()
    image.image_data_nbytes = len(image.image_data)
    depth.width, depth.height = WIDTH, HEIGHT
    depth.depth_data_format = depth_msg_t.DEPTH_REGISTERED
    depth.compression = depth_msg_t.COMPRESSION_ZLIB
    depth.depth_data = zlib.compress(depth_mm().tobytes())
    depth.depth_data_nbytes, depth.uncompressed_size = len(depth.depth_data), 2 * WIDTH * HEIGHT
    return bytes(message.encode())


def write_log(path: Path, channel: str, data: bytes) -> Path:
    log = lcm.EventLog(str(path), "w", overwrite=True)
    for number in range(FRAMES):
        log.write_event(UTIME + PERIOD_US * number, channel, data)
    log.close()
    return path


def robots_messages() -> dict[str, Any]:
    """What a dimos robot says of the wall."""
    header = Header(stamp=Time(sec=UTIME // 1_000_000, nsec=0), frame_id="camera_optical")

    def image(encoding: str, pixels: np.ndarray) -> Image:
        data = pixels.tobytes()
        return Image(header=header, height=HEIGHT, width=WIDTH, encoding=encoding, is_bigendian=0,
                     step=len(data) // HEIGHT, data=data, data_length=len(data))

    lens = CameraInfo(header=header, height=HEIGHT, width=WIDTH, distortion_model="plumb_bob",
                      D=[0.0] * 5, D_length=5,
                      K=[FOCAL_PX, 0, (WIDTH - 1) / 2, 0, FOCAL_PX, (HEIGHT - 1) / 2, 0, 0, 1],
                      R=[1.0, 0, 0, 0, 1.0, 0, 0, 0, 1.0])
    return {LENS: lens, COLOUR: image("rgb8", left()), DEPTH: image("16UC1", depth_mm())}


def test_two_recordings(build: Path, url: str, tmp_path: Path) -> None:
    with driver(build, url, [*write_rig(tmp_path), *write_folders(tmp_path, right())]) as heard:
        heard.comes("STEREO")
    assert_is_the_wall(heard)


def test_replayed_pairs(build: Path, url: str, tmp_path: Path) -> None:
    log = record_pairs(build, url, tmp_path)
    with driver(build, url, [*write_rig(tmp_path), "source.kind=pair_channel"]) as heard:
        heard.play(log)
    assert_is_the_wall(heard)


def test_folders_of_colour_and_depth(build: Path, url: str, tmp_path: Path) -> None:
    settings = write_folders(tmp_path, depth_mm())
    with driver(build, url, ["source.kind=colour_and_depth", *lens_file(tmp_path),
                             *settings]) as heard:
        heard.comes("STEREO")
    assert_is_the_wall(heard)


def test_a_kinects_log(build: Path, url: str, tmp_path: Path) -> None:
    log = write_log(tmp_path / "kinect.lcmlog", "KINECT_FRAME", kinect_frame())
    with driver(build, url, ["source.kind=kinect_channel", *lens_file(tmp_path)]) as heard:
        heard.play(log)
    assert_is_the_wall(heard)


def lens_file(folder: Path) -> list[str]:
    """The colour lens, as the left one of the rig."""
    write_rig(folder)
    return [f"depth_camera.calibration.file={folder}/intrinsics.yml"]


def test_a_dimos_robot(build: Path, url: str) -> None:
    with driver(build, url, ["source.kind=dimos"]) as heard:
        heard.publish(robots_messages())
    assert_is_the_wall(heard)
