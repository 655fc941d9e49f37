"""`deixis spy`: what it says when it cannot start, and what its windows show on a virtual display."""

from __future__ import annotations

import io
import os
import shutil
import signal
import subprocess
import threading
from collections.abc import Callable, Iterator
from pathlib import Path

import matplotlib.image
import numpy as np
import pytest
from bench import becomes_true, killed_after
from spy_screen import (Spy, command, driven_java, environment, places, read_screen,
                        virtual_display)

RED, GREEN, BLUE = (255, 0, 0), (0, 255, 0), (0, 0, 255)
MEASURED, INFERRED = (40, 210, 90), (255, 190, 0)
HIDDEN, LOST = (90, 140, 255), (235, 60, 60)
FAULT = (200, 30, 40)
PICTURE_BOX = (0, 620, 480, 420)
STEREO_BOX = (500, 620, 900, 420)
BODY_BOX = (810, 0, 680, 600)
PATIENCE_S = 60.0


def run_spy(**changes: str | None) -> subprocess.CompletedProcess[str]:
    """`deixis spy` to its end; None takes a variable out."""
    return subprocess.run(command(), check=False, env=environment(**changes), capture_output=True,
                          text=True, timeout=PATIENCE_S)


@pytest.fixture
def jars(build: Path) -> None:
    """Skips where the build could make no Java."""
    for name in ("deixis_spy.jar", "deixis_spy_tests.jar"):
        if not (build / "java" / name).exists():
            pytest.skip(f"this build has no {name}: it found no JDK or no lcm.jar")


@pytest.fixture
def display(jars: None) -> Iterator[str]:
    """A display that nobody sees; skips where this machine has none, or Java opens no windows."""
    if shutil.which("Xvfb") is None:
        pytest.skip("no Xvfb here: scripts/setup --spy installs it")
    if not java_opens_windows():
        pytest.skip("this Java opens no windows: scripts/setup --spy installs one that does")
    with virtual_display() as name:
        yield name


def java_opens_windows() -> bool:
    """False for a headless runtime."""
    said = subprocess.run(["java", "-XshowSettings:properties", "-version"], check=False,
                          capture_output=True, text=True).stderr
    homes = [line.partition("=")[2].strip() for line in said.splitlines() if "java.home" in line]
    return any((Path(home) / "lib" / "libawt_xawt.so").exists() for home in homes)


@pytest.fixture
def spy(display: str, url: str, build: Path, tmp_path: Path) -> Iterator[Spy]:
    """`deixis spy` with a driver in it, on a display and a bus of its own."""
    driven_java(tmp_path)
    spy = Spy(url, environment(
        DISPLAY=display, DEIXIS_BUILD_DIR=str(build), JAVA_HOME=None,
        PATH=f"{tmp_path}:{os.environ['PATH']}",
        CLASSPATH=str(build / "java" / "deixis_spy_tests.jar")))
    yield spy
    spy.end()


@pytest.fixture
def publish(url: str) -> Iterator[Callable[[str, object], None]]:
    """Publishes messages ten times a second each, the last one given per channel."""
    import lcm

    bus = lcm.LCM(url)
    messages: dict[str, bytes] = {}
    is_over = threading.Event()

    def repeat() -> None:
        while not is_over.wait(0.1):
            for channel, data in list(messages.items()):
                bus.publish(channel, data)

    thread = threading.Thread(target=repeat)
    thread.start()
    yield lambda channel, message: messages.update(
        {channel: message if isinstance(message, bytes) else message.encode()})
    is_over.set()
    thread.join()


def jpeg_image(pixels: np.ndarray) -> object:
    """A picture as bot_core.image_t, JPEG."""
    from deixis_lcm import images

    file = io.BytesIO()
    matplotlib.image.imsave(file, pixels, format="jpeg")
    return images.from_jpeg(file.getvalue(), pixels.shape[1], pixels.shape[0], utime=1)


def red_and_blue() -> np.ndarray:
    """A picture whose left half is red and whose right half is blue."""
    pixels = np.zeros((240, 320, 3), np.uint8)
    pixels[:, :160, 0] = 255
    pixels[:, 160:, 2] = 255
    return pixels


def stereo_pair() -> object:
    """A green picture and a depth image: 1 m at the top, 4 m at the bottom, nothing between."""
    from bot_core import images_t

    from deixis_lcm import images

    green = np.zeros((240, 320, 3), np.uint8)
    green[:, :, 1] = 255
    depth = np.zeros((120, 160), np.uint16)
    depth[:40], depth[80:] = 1000, 4000
    return images.bundle(1, [(images_t.LEFT, jpeg_image(green)),
                             (images_t.DEPTH_MM_ZIPPED, images.from_depth_mm(depth, 1))])


def limb(proximal: tuple[float, ...], distal: tuple[float, ...], state: int) -> object:
    """A limb between two points, metres."""
    import deixis

    limb = deixis.limb_pose_t()
    limb.in_parent, limb.in_frame = deixis.transform_t(), deixis.transform_t()
    limb.proximal_m, limb.distal_m, limb.state = proximal, distal, state
    return limb


def standing_person() -> object:
    """Body poses of one person, 2.5 m away, one limb or more per state, the left arm forwards."""
    import deixis

    kind = deixis.limb_pose_t
    body = deixis.body_pose_t()
    body.person_id, body.state, body.root_in_frame = 3, body.TRACKED, deixis.transform_t()
    shoulders, hips, z = -0.5, 0.05, 2.5
    body.limbs = [
        limb((0, hips, z), (0, shoulders, z), kind.MEASURED),
        limb((0, shoulders, z), (0, shoulders - 0.3, z), kind.MEASURED),
        limb((-0.2, shoulders, z), (-0.5, -0.2, z), kind.INFERRED),
        limb((0.2, shoulders, z), (0.3, -0.3, z - 0.5), kind.MEASURED),
        limb((-0.1, hips, z), (-0.15, 0.5, z), kind.HIDDEN),
        limb((0.1, hips, z), (0.15, 0.5, z), kind.MEASURED),
        limb((-0.15, 0.5, z), (-0.15, 0.9, z), kind.LOST),
        limb((0.15, 0.5, z), (0.15, 0.9, z), kind.MEASURED)]
    body.n_limbs = len(body.limbs)
    poses = deixis.body_poses_t()
    poses.frame, poses.bodies, poses.n_bodies = "camera", [body], 1
    return poses


def open_window(spy: Spy, channel: str, box: tuple[int, int, int, int]) -> None:
    """Waits until the channel is in the table and opens its window by a double click."""
    assert becomes_true(lambda: spy.ask(f"row {channel}") != "none", PATIENCE_S), spy.said
    assert spy.ask(f"open {channel} {' '.join(map(str, box))}") == "done", spy.said


def comes_up(spy: Spy, file: Path, holds: Callable[[np.ndarray], bool]) -> bool:
    """True as soon as the screen is as it should be."""
    return becomes_true(lambda: holds(spy.screen(file)), PATIENCE_S)


def test_pictures_depth_and_people_are_on_the_screen(
        spy: Spy, publish: Callable[[str, object], None], tmp_path: Path) -> None:
    publish("CAMERA", jpeg_image(red_and_blue()))
    publish("STEREO", stereo_pair())
    publish("BODY_POSES", standing_person())
    open_window(spy, "CAMERA", PICTURE_BOX)
    open_window(spy, "STEREO", STEREO_BOX)
    open_window(spy, "BODY_POSES", BODY_BOX)
    file = tmp_path / "screen.png"
    for holds in (shows_red_beside_blue, shows_picture_and_depth, shows_person):
        assert comes_up(spy, file, holds), f"{holds.__name__}: {file}\n" + "\n".join(spy.said)


def shows_red_beside_blue(screen: np.ndarray) -> bool:
    """Both halves of the picture on CAMERA, red to the left."""
    red, blue = places(screen, PICTURE_BOX, RED), places(screen, PICTURE_BOX, BLUE)
    return min(len(red), len(blue)) > 10_000 and red[:, 1].max() < blue[:, 1].min()


def shows_picture_and_depth(screen: np.ndarray) -> bool:
    """The green picture to the left of the depth, which is red (near) above blue (far)."""
    left, right = split(STEREO_BOX)
    green = places(screen, left, GREEN)
    near, far = places(screen, right, RED, 4), places(screen, right, BLUE, 4)
    return (len(green) > 20_000 and min(len(near), len(far)) > 5_000
            and np.median(near[:, 0]) + 100 < np.median(far[:, 0]))


def shows_person(screen: np.ndarray) -> bool:
    """Limbs in the colours of their states, in the front view above each other as on the body."""
    x, y, width, height = BODY_BOX
    front = (x, y + 40, width // 3, height // 2)
    rows = [places(screen, front, colour, 8)[:, 0] for colour in (INFERRED, HIDDEN, LOST)]
    if any(len(found) < 50 for found in (*rows, places(screen, front, MEASURED, 8))):
        return False
    arm, thigh, shank = (found.mean() for found in rows)
    return arm < thigh < shank


def split(box: tuple[int, int, int, int]) -> list[tuple[int, int, int, int]]:
    """Left and right half."""
    x, y, width, height = box
    return [(x, y, width // 2, height), (x + width // 2, y, width // 2, height)]


def test_all_types_are_known_and_the_menu_offers_the_windows(
        spy: Spy, publish: Callable[[str, object], None]) -> None:
    publish("BODY_POSES", standing_person())
    publish("CAMERA", jpeg_image(red_and_blue()))
    assert becomes_true(lambda: "none" not in (spy.ask("row CAMERA"), spy.ask("row BODY_POSES")),
                        PATIENCE_S)
    assert spy.ask("row CAMERA").split("|")[:2] == ["CAMERA", "image_t"]
    assert spy.ask("row BODY_POSES").split("|")[:2] == ["BODY_POSES", "body_poses_t"]
    assert spy.ask("menu CAMERA") == "Structure Viewer...|Pictures..."
    assert spy.ask("menu BODY_POSES") == "Structure Viewer...|Bodies..."


def test_a_damaged_picture_is_said_and_the_next_good_one_shown(
        spy: Spy, publish: Callable[[str, object], None], tmp_path: Path) -> None:
    good, bad = jpeg_image(red_and_blue()), jpeg_image(red_and_blue())
    bad.data = bad.data[:200]
    bad.size = len(bad.data)
    publish("CAMERA", bad)
    open_window(spy, "CAMERA", PICTURE_BOX)
    assert comes_up(spy, tmp_path / "bad.png",
                    lambda screen: len(places(screen, PICTURE_BOX, FAULT, 8)) > 3_000)
    publish("CAMERA", good)
    assert comes_up(spy, tmp_path / "good.png", shows_red_beside_blue)
    assert len(places(read_screen(tmp_path / "good.png"), PICTURE_BOX, FAULT, 8)) < 100


def test_a_closed_window_leaves_nothing_behind_and_can_be_opened_again(
        spy: Spy, publish: Callable[[str, object], None], tmp_path: Path) -> None:
    publish("CAMERA", jpeg_image(red_and_blue()))
    open_window(spy, "CAMERA", PICTURE_BOX)
    assert spy.ask("feeds CAMERA") == "1"
    assert spy.ask("close CAMERA") == "done"
    assert becomes_true(lambda: spy.ask("feeds CAMERA") == "0", PATIENCE_S)
    open_window(spy, "CAMERA", PICTURE_BOX)
    assert comes_up(spy, tmp_path / "screen.png", shows_red_beside_blue)


def test_it_starts_with_the_real_java_and_ends_when_told(display: str, url: str,
                                                         build: Path) -> None:
    process = subprocess.Popen(command("-l", url),
                               env=environment(DISPLAY=display, DEIXIS_BUILD_DIR=str(build)),
                               stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True)
    try:
        assert process.stdout is not None
        said = []
        with killed_after(PATIENCE_S, process):
            for line in process.stdout:
                said.append(line.strip())
                if line.strip().startswith("pictures: bot_core.image_t"):
                    break
        assert "Found 2 plugins" in said
        assert not [line for line in said if "Error" in line]
    finally:
        process.send_signal(signal.SIGTERM)
        assert process.wait(timeout=PATIENCE_S) == 128 + signal.SIGTERM


@pytest.mark.usefixtures("jars")
@pytest.mark.parametrize(("changes", "fault"), [
    ({"DISPLAY": None}, "DISPLAY is not set"),
    ({"DISPLAY": ":9", "PATH": "/nowhere", "JAVA_HOME": None}, "scripts/setup --spy"),
    ({"DISPLAY": ":9", "LCM_JVM_OPT": "'"}, "LCM_JVM_OPT"),
    ({"DISPLAY": ":9", "LCM_DEFAULT_URL": "memq://"}, "leads to no other process")])
def test_what_is_missing_is_named_before_the_start(changes: dict[str, str | None], fault: str,
                                                   build: Path) -> None:
    done = run_spy(**{"DEIXIS_BUILD_DIR": str(build), **changes})
    assert done.returncode == 1
    [line] = done.stderr.splitlines()
    assert line.startswith("deixis: ") and fault in line


@pytest.mark.parametrize(("options", "fault"), [
    ("-Djava.awt.headless=true", "scripts/setup --spy"), ("-Xmx512m", "on the display :987")])
def test_a_window_that_cannot_be_opened_is_one_line(options: str, fault: str, url: str, jars: None,
                                                    build: Path) -> None:
    done = run_spy(DISPLAY=":987", LCM_DEFAULT_URL=url, DEIXIS_BUILD_DIR=str(build),
                   LCM_JVM_OPT=options)
    assert done.returncode == 1
    if not shutil.which("Xvfb"):  # Nor is there a Java that opens windows: setup brings both.
        fault = "scripts/setup --spy"
    assert any(line.startswith("deixis: ") and fault in line for line in done.stderr.splitlines())
    assert "Exception" not in done.stderr and "\tat " not in done.stderr


def test_a_build_without_java_says_what_it_lacked(tmp_path: Path) -> None:
    done = run_spy(DISPLAY=":9", DEIXIS_BUILD_DIR=str(tmp_path))
    assert done.returncode == 1
    [line] = done.stderr.splitlines()
    assert "deixis_spy.jar not found" in line and "default-jdk-headless" in line
