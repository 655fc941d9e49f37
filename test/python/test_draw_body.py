"""The example that draws bodies, with messages that the C++ side has made of the shipped models."""

from __future__ import annotations

import importlib.util
import os
import subprocess
import sys
import time
from pathlib import Path
from types import ModuleType
from typing import Any

import lcm
import numpy as np
import pytest
from deixis import body_model_t, body_poses_t
from deixis_lcm import logs

image = pytest.importorskip("matplotlib.image")

MODELS = ("right_arm", "upper_body", "whole_body", "whole_body_detailed", "clothed_body")
FRAMES = 3  # standing, pointing, any
DPI = 120
Frame = list[tuple[Any, Any]]  # (body_model_t, body_pose_t) of each person


@pytest.fixture(scope="module")
def example(repository: Path) -> ModuleType:
    """The example as a module."""
    path = repository / "scripts/python/examples/draw_body.py"
    spec = importlib.util.spec_from_file_location("draw_body", path)
    assert spec and spec.loader
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


@pytest.fixture(scope="module")
def body_logs(build: Path, tmp_path_factory: pytest.TempPathFactory) -> dict[str, Path]:
    """A log for each model, written by the C++ side."""
    folder = tmp_path_factory.mktemp("bodies")
    written = {name: folder / f"{name}.lcmlog" for name in MODELS}
    for name, log in written.items():
        subprocess.run([build / "test/support/write_body_messages", name, log], check=True)
    return written


def frames_of(example: ModuleType, log: Path) -> list[Frame]:
    frames = list(example.known_bodies(example.received(log)))
    assert len(frames) == FRAMES
    return frames


def run(repository: Path, build: Path, *arguments: object, url: str = "memq://") -> subprocess.CompletedProcess[str]:
    return subprocess.run(command(repository, *arguments), capture_output=True, text=True, check=False,
                          timeout=60, env=environment(repository, build, url))


def command(repository: Path, *arguments: object) -> list[str]:
    return [sys.executable, str(repository / "scripts/python/examples/draw_body.py"), *map(str, arguments)]


def environment(repository: Path, build: Path, url: str) -> dict[str, str]:
    return {**os.environ, "PYTHONPATH": f"{build / 'python'}:{repository / 'scripts/python'}", "LCM_DEFAULT_URL": url}


@pytest.mark.parametrize("model", MODELS)
def test_angles_put_limbs_where_the_message_says_that_they_are(
        example: ModuleType, body_logs: dict[str, Path], model: str) -> None:
    for frame in frames_of(example, body_logs[model]):
        for body, pose in frame:
            assert example.disagreement_m(body, pose) < 1e-6
            for made, said in zip(example.limb_frames(body, pose), pose.limbs):
                assert np.allclose(made, example.matrix(said.in_frame), atol=1e-6)
                assert np.allclose(made[:3, 3], said.proximal_m, atol=1e-6)


def test_every_angle_moves_something(example: ModuleType, body_logs: dict[str, Path]) -> None:
    (body, pose), = frames_of(example, body_logs["whole_body_detailed"])[0]
    for angle in range(pose.n_angles):
        angles = list(pose.angles_rad)
        pose.angles_rad = [value + 0.1 * (index == angle) for index, value in enumerate(angles)]
        assert example.disagreement_m(body, pose) > 1e-3, angle
        pose.angles_rad = angles


def test_wires_lie_on_the_degenerate_cylinder(example: ModuleType, body_logs: dict[str, Path]) -> None:
    (body, _), = frames_of(example, body_logs["whole_body_detailed"])[0]
    for limb in body.limbs:
        for x_m, y_m, z_m in np.concatenate(example.wires(limb)):
            share = z_m / limb.length_m
            centre_m = np.array(limb.centre0_m) + share * (np.array(limb.centre1_m) - limb.centre0_m)
            a_m, b_m = limb.a0_m + share * (limb.a1_m - limb.a0_m), limb.b0_m + share * (limb.b1_m - limb.b0_m)
            assert np.hypot((x_m - centre_m[0]) / a_m, (y_m - centre_m[1]) / b_m) == pytest.approx(1.0)
            assert -1e-9 < share < 1.0 + 1e-9


def inked(example: ModuleType, frame: Frame, file: Path) -> tuple[np.ndarray, Any]:
    """Which pixels of a drawing without axes are not white, a pixel wider; and the figure."""
    figure = example.figure_of(frame)
    for axes in figure.axes:
        axes.set_axis_off()
        axes.set_title("")
    figure.savefig(file, dpi=DPI)
    ink = (image.imread(file)[:, :, :3] < 0.9).any(axis=2)
    wide = ink.copy()
    for shift in (-1, 1):
        for axis in (0, 1):
            wide |= np.roll(ink, shift, axis)
    return wide, figure


@pytest.mark.parametrize("view, across", [(0, 0), (1, 2)])
def test_there_is_ink_where_limbs_are_and_none_beside_them(
        example: ModuleType, body_logs: dict[str, Path], tmp_path: Path, view: int, across: int) -> None:
    frame = frames_of(example, body_logs["whole_body_detailed"])[1]
    ink, figure = inked(example, frame, tmp_path / "body.png")
    axes, (body, pose) = figure.axes[view], frame[0]

    def is_inked(points_m: np.ndarray) -> np.ndarray:
        figure.set_dpi(DPI)  # Drawing puts it back.
        columns, rows = axes.transData.transform(points_m[:, [across, 1]]).T
        return ink[np.round(ink.shape[0] - 1 - rows).astype(int), np.round(columns).astype(int)]

    for limb, said in zip(body.limbs, pose.limbs):
        for wire in example.wires(limb):
            assert is_inked(example.placed(example.matrix(said.in_frame), wire)).all(), limb.name
    head = pose.limbs[next(i for i, limb in enumerate(body.limbs) if limb.name == "head")]
    beside_m = np.array(head.distal_m) + [[0.2, 0.0, 0.2], [-0.2, 0.0, -0.2]]
    assert not is_inked(beside_m).any()


def test_a_log_becomes_a_picture(repository: Path, build: Path, body_logs: dict[str, Path], tmp_path: Path) -> None:
    output = tmp_path / "body.png"
    result = run(repository, build, output, "--log", body_logs["whole_body_detailed"], "--skip", 2)
    assert result.returncode == 0, result.stderr
    assert result.stdout == "1 people; limbs lie within 0.000 mm of where the message has them\n"
    assert result.stderr == ""
    assert image.imread(output).shape[:2] == (840, 1080)


def test_limbs_that_do_not_follow_from_the_angles_are_warned_of(
        repository: Path, build: Path, body_logs: dict[str, Path], tmp_path: Path) -> None:
    moved = tmp_path / "moved.lcmlog"
    with logs.Writer(moved) as writer:
        for log_time_us, channel, message in logs.read(body_logs["whole_body"]):
            if isinstance(message, body_poses_t):
                frame = message.bodies[0].limbs[4].in_frame
                frame.translation_m = [frame.translation_m[0] + 0.002, *frame.translation_m[1:]]
            writer.write(log_time_us, channel, message)
    result = run(repository, build, tmp_path / "body.png", "--log", moved)
    assert "within 2.000 mm" in result.stdout
    assert "warning: angles and limbs of the message do not belong together" in result.stderr


def test_poses_without_their_model_are_passed_over(
        repository: Path, build: Path, body_logs: dict[str, Path], tmp_path: Path) -> None:
    poses_only = tmp_path / "poses.lcmlog"
    with logs.Writer(poses_only) as writer:
        for log_time_us, channel, message in logs.read(body_logs["whole_body"]):
            if not isinstance(message, body_model_t):
                writer.write(log_time_us, channel, message)
    result = run(repository, build, tmp_path / "body.png", "--log", poses_only)
    assert (result.returncode, result.stdout) == (1, "")
    assert "poses came without their models" in result.stderr


def test_a_pose_that_lies_about_its_model_is_refused(
        repository: Path, build: Path, body_logs: dict[str, Path], tmp_path: Path) -> None:
    lying = tmp_path / "lying.lcmlog"
    with logs.Writer(lying) as writer:
        for log_time_us, channel, message in logs.read(body_logs["whole_body"]):
            if isinstance(message, body_poses_t):
                message.bodies[0].limbs.pop()
                message.bodies[0].n_limbs -= 1
            writer.write(log_time_us, channel, message)
    result = run(repository, build, tmp_path / "body.png", "--log", lying)
    assert result.returncode == 1
    assert result.stderr == "draw_body: its angles or limbs are not as many as its model's\n"


def test_what_comes_over_the_bus_is_drawn(
        repository: Path, build: Path, body_logs: dict[str, Path], tmp_path: Path, url: str) -> None:
    output, bus = tmp_path / "body.png", lcm.LCM(url)
    messages = list(logs.read(body_logs["upper_body"]))
    with subprocess.Popen(command(repository, output), env=environment(repository, build, url),
                          stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True) as drawing:
        deadline = time.monotonic() + 60
        while drawing.poll() is None and time.monotonic() < deadline:
            bus.publish("BODY_POSES", b"of another type")  # is to be passed over
            for _, channel, message in messages:
                bus.publish(channel, message.encode())
            time.sleep(0.05)
        drawing.kill()
        said, complaints = drawing.communicate()
    assert said.startswith("1 people; limbs lie within 0.000 mm"), complaints
    assert output.stat().st_size > 10_000


def test_without_the_types_it_says_how_to_run_it(repository: Path, tmp_path: Path) -> None:
    result = subprocess.run(command(repository, tmp_path / "a.png"), check=False, capture_output=True, text=True,
                            env={**os.environ, "PYTHONPATH": ""}, cwd=tmp_path)
    assert result.returncode == 1
    assert "PYTHONPATH=build/release/python" in result.stderr and "Traceback" not in result.stderr
