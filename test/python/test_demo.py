"""The demonstration with stand-ins for the programs: live, in one process, and when it fails."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import fake_demo
import pytest
from deixis import body_poses_t

from deixis_frontend import layout
from deixis_frontend.demo.bodies import Bodies
from deixis_frontend.demo.clip import open_clip

HERE = Path(__file__).resolve().parent
PROGRAMS = ("camera-driver", "stereo-driver", "object-detector", "hand-tracker", "gesture-recogniser",
            "pose-fitter", "viewer", "offline")
LABELS = """start_frame,apex_frame,end_frame,hand,object_id,retract_end_frame,object_label
3,4,6,right,5,7,lamp
9,10,12,right,0,13,cup
"""


class Theatre:
    """Stand-ins for the programs and a clip, in a folder of their own."""

    def __init__(self, folder: Path, build: Path) -> None:
        self.output = folder / "output"
        self._folder = folder
        self._environment = {**os.environ, "DEIXIS_BUILD_DIR": str(folder),
                             "DEIXIS_RUN_DIR": str(folder / "run"),
                             "PYTHONPATH": os.pathsep.join(sys.path)}
        (folder / "python").symlink_to(build / "python")
        (folder / "bin").mkdir()
        for name in PROGRAMS:
            self._write_program(f"deixis-{name}")
        (folder / "clip").mkdir()
        (folder / "clip" / "left.mp4").touch()
        (folder / "clip" / "gestures.csv").write_text(LABELS, encoding="ascii")

    def add_second_camera(self) -> None:
        """From then on the clip is one of a stereo rig."""
        for name in ("right.mp4", "intrinsics.yml", "extrinsics.yml"):
            (self._folder / "clip" / name).touch()

    def play(self, *arguments: str, prefix: tuple[str, ...] = (),
             mode: str = "") -> subprocess.CompletedProcess[str]:
        """Runs `deixis demo` to its end."""
        command = [*prefix, sys.executable, "-m", "deixis_frontend", "demo", "--clip",
                   str(self._folder / "clip"), "--output", str(self.output), *arguments]
        return subprocess.run(command, env={**self._environment, "DEIXIS_FAKE": mode},
                              capture_output=True, text=True, check=False, timeout=60)

    def _write_program(self, name: str) -> None:
        program = self._folder / "bin" / name
        program.write_text(f"#!/bin/sh\nDEIXIS_FAKE_PROGRAM={name} exec {sys.executable}"
                           f" {HERE / 'fake_demo.py'} \"$@\"\n", encoding="ascii")
        program.chmod(0o755)


@pytest.fixture
def theatre(tmp_path_factory: pytest.TempPathFactory, build: Path, url: str) -> Theatre:
    """`url` is asked for only to be sure that there is multicast."""
    return Theatre(tmp_path_factory.mktemp("demo"), build)


def test_live_it_says_what_is_pointed_at_and_how_much_was_right(theatre: Theatre) -> None:
    result = theatre.play()
    assert result.returncode == 0, result.stdout + result.stderr
    assert "    0.2 s  pointing: lamp (88%), right hand\n" in result.stdout
    assert "    0.5 s  pointing: phone (88%), right hand\n" in result.stdout
    assert "1 of 2 pointing gestures were named right (2 gestures recognised" in result.stdout
    assert result.stdout.count("pointing:") == 2


def test_live_it_stops_after_the_seconds_that_are_given(theatre: Theatre) -> None:
    result = theatre.play("--seconds", "0.4")
    assert "lamp" in result.stdout
    assert "1 of 1 pointing gestures" in result.stdout


def test_what_the_seconds_cut_off_is_no_failure(theatre: Theatre) -> None:
    result = theatre.play("--seconds", "0.4", mode="blind")
    assert result.returncode == 0, result.stdout + result.stderr
    assert "0 of 0 pointing gestures" in result.stdout


def test_it_says_on_which_bus_it_plays(theatre: Theatre, url: str) -> None:
    assert f"on the bus {url}:" in theatre.play("--seconds", "0.2", "-l", url).stdout
    assert "on the bus udpm://239.255.76.67:" in theatre.play("--seconds", "0.2").stdout


def test_it_fails_when_nothing_is_recognised(theatre: Theatre) -> None:
    result = theatre.play(mode="blind")
    assert result.returncode == 1
    assert "no gesture was recognised" in result.stderr


def test_it_names_the_service_that_does_not_start(theatre: Theatre) -> None:
    result = theatre.play(mode="broken")
    assert result.returncode == 1
    assert "gesture_recogniser.yaml:1: nonsense" in result.stdout
    assert "not all services are ready" in result.stderr


def test_without_multicast_it_runs_in_one_process_and_names_the_cure(
        theatre: Theatre, without_multicast: list[str]) -> None:
    result = theatre.play(prefix=tuple(without_multicast))
    assert result.returncode == 0, result.stdout + result.stderr
    assert "ip route add 224.0.0.0/4 dev lo" in result.stdout
    assert "    0.2 s  pointing: lamp (88%), right hand\n" in result.stdout
    assert "1 of 2 pointing gestures were named right" in result.stdout


BODY = "1 person found (1 in all), somebody in 100% of "
LIMBS = " pictures; person 4: 1.0 of 2 limbs measured"


def test_a_clip_of_two_cameras_shows_bodies_and_how_old_they_were(theatre: Theatre) -> None:
    theatre.add_second_camera()
    result = theatre.play()
    assert result.returncode == 0, result.stdout + result.stderr
    assert BODY in result.stdout and LIMBS + "; bodies were " in result.stdout
    assert "1 of 2 pointing gestures were named right" in result.stdout
    assert "stereo_driver" in result.stdout and "camera_driver" not in result.stdout


def test_it_fails_when_no_body_is_found_where_one_could_be(theatre: Theatre) -> None:
    theatre.add_second_camera()
    result = theatre.play(mode="empty")
    assert result.returncode == 1
    assert "no body was fitted in " in result.stdout
    assert "no body was found: see the logs in" in result.stderr
    assert theatre.play("--seconds", "0.3", mode="empty").returncode == 0, "cut off before one can be expected"


def test_without_multicast_bodies_are_fitted_in_one_process(
        theatre: Theatre, without_multicast: list[str]) -> None:
    theatre.add_second_camera()
    result = theatre.play(prefix=tuple(without_multicast))
    assert result.returncode == 0, result.stdout + result.stderr
    assert BODY + "20" + LIMBS + "\n" in result.stdout
    assert "1 of 2 pointing gestures were named right" in result.stdout


@pytest.mark.parametrize(("age_us", "is_slow"), [(80_000, False), (2_000_000, True)])
def test_bodies_that_are_very_old_tell_of_a_slow_machine(age_us: int, is_slow: bool) -> None:
    bodies = Bodies(body_poses_t)
    for number in range(3):
        utime = 50_000 * number
        bodies.hear(fake_demo.fitted_to(fake_demo.picture(utime, number), ""), utime + age_us)
    assert f"bodies were {age_us // 1000} ms old" in bodies.verdict()
    assert ("too slow" in bodies.verdict()) == is_slow


def test_the_clip_that_is_shipped_has_two_cameras() -> None:
    clip = open_clip(None, layout.find())
    assert clip.is_stereo
    assert clip.watchers()["hand_tracker"] == {"image_channel": "STEREO"}


def test_another_video_beside_a_pair_is_one_of_one_camera(tmp_path: Path) -> None:
    for name in ("mine.mp4", "left.mp4", "right.mp4", "intrinsics.yml", "extrinsics.yml"):
        (tmp_path / name).touch()
    assert open_clip(tmp_path / "left.mp4", layout.find()).is_stereo
    clip = open_clip(tmp_path / "mine.mp4", layout.find())
    assert (clip.is_stereo, clip.driver, clip.channel) == (False, "camera_driver", "CAMERA")
    assert clip.driver_settings()["source.path"] == str(tmp_path / "mine.mp4")


def test_without_a_clip_it_says_which_one_is_missing(theatre: Theatre) -> None:
    result = theatre.play("--clip", "/nowhere/clip.mp4")
    assert result.returncode == 1
    assert "/nowhere/clip.mp4: no such video" in result.stderr
