"""`deixis evaluate pose` on recordings of real people: made-up ones of each kind, with errors that are known."""

from __future__ import annotations

import math
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from deixis_frontend import layout
from deixis_frontend.cli import main
from deixis_frontend.evaluation import (
    depth_logs, pose_chain, pose_cloud, pose_mhad, pose_real, pose_results, pose_turning, pose_upper_body)
from deixis_frontend.evaluation.pose_chain import Chain
from deixis_frontend.evaluation.pose_joints import INDEX, NAMES
from deixis_frontend.evaluation.pose_results import MEASURED, FoundFrame, FoundPerson

Image = pytest.importorskip("PIL.Image")
FRAMES = 12


def _person(joints_m: np.ndarray, root_m: np.ndarray | None = None, turn: np.ndarray = np.eye(3)) -> FoundPerson:
    count = len(joints_m)
    return FoundPerson(1, 1, joints_m[0] if root_m is None else root_m, joints_m,
                       np.tile(1e-4 * np.eye(3), (count, 1, 1)), np.full(count, MEASURED),
                       np.tile(turn, (count, 1, 1)))


def _about_vertical(degrees: float) -> np.ndarray:
    c, s = math.cos(math.radians(degrees)), math.sin(math.radians(degrees))
    return np.array([[c, 0.0, s], [0.0, 1.0, 0.0], [-s, 0.0, c]])


# Logs of depth.


def test_a_log_of_depth_holds_what_was_written(tmp_path: Path) -> None:
    camera = depth_logs.DepthCamera((285.0, 286.0), (159.0, 119.0), (4, 3))
    depth = np.arange(12, dtype=np.uint16).reshape(3, 4) * 1000
    frames = [depth_logs.DepthFrame(0, depth), depth_logs.DepthFrame(33333, depth[::-1].copy())]
    depth_logs.write(layout.find(), tmp_path / "x.lcmlog", camera, frames)
    from deixis_lcm import images, logs

    events = list(logs.read(tmp_path / "x.lcmlog"))
    assert [channel for _, channel, _ in events] == ["STEREO_CALIBRATION", "STEREO", "STEREO"]
    calibration, first, second = (message for _, _, message in events)
    assert calibration.rectified.focal_px == (285.0, 286.0) and calibration.disparity_sigma_px == 0.0
    assert calibration.depth_sigma_m_at_1m > 0.0
    assert (images.depth_mm(first) == depth).all() and (images.depth_mm(second) == depth[::-1]).all()
    assert second.utime == 33333 and first.images[0].width == 4


def test_pictures_of_other_than_sixteen_bits_are_refused(tmp_path: Path) -> None:
    Image.fromarray(np.zeros((2, 2), np.uint8)).save(tmp_path / "grey.png")
    with pytest.raises(ValueError, match="no 16-bit picture"):
        depth_logs.read_depth_png(tmp_path / "grey.png")


# Kinect joints.

_KINECT = [joint.name for joint in pose_mhad._JOINTS]


def _write_mhad(folder: Path, subjects: int) -> dict[str, np.ndarray]:
    """Returns the true joints, frames x joints x 3, of each sequence in the un-mirrored camera's frame."""
    folder.mkdir(parents=True, exist_ok=True)
    chance = np.random.default_rng(1)
    truth, index = {}, ["name,action,subject,trial,depth_frames,skeleton_frames"]
    for subject in range(1, subjects + 1):
        name = f"a1_s{subject}_t1"
        joints = chance.uniform(-0.5, 0.5, (FRAMES, len(_KINECT), 3)) + (0.0, 0.0, 2.5)
        header = ",".join(["frame", *(f"{joint}_{axis}" for joint in _KINECT for axis in "xyz")])
        rows = [",".join(str(v) for v in (k, *np.ravel(joints[k]))) for k in range(FRAMES)]
        (folder / f"{name}_skeleton.csv").write_text("\n".join([header, *rows]) + "\n")
        Image.fromarray(np.zeros((240 * FRAMES, 320), np.uint16)).save(folder / f"{name}_depth.png")
        index.append(f"{name},1,{subject},1,{FRAMES},{FRAMES}")
        truth[name] = joints * (-1.0, -1.0, 1.0)
    (folder / "index.csv").write_text("\n".join(index) + "\n")
    return truth


@pytest.fixture(name="kinect")
def kinect_fixture(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Any:
    """Runs the evaluation on people whom the fitter finds moved by what is asked for."""

    def run(subjects: int, moved: Any) -> dict[str, Any]:
        truth = iter(_write_mhad(tmp_path, subjects).items())
        monkeypatch.setattr(pose_chain, "fit", lambda *_: pose_chain.Fitted([]))

        def read(*_: Any) -> list[FoundFrame]:
            name, joints = next(truth)
            return [FoundFrame(round(k / 30 * 1e6), moved(name, k, joints[k])) for k in range(FRAMES)]

        monkeypatch.setattr(pose_results, "read", read)
        return pose_mhad.evaluate(layout.find(), tmp_path, None, Chain())

    return run


def test_an_offset_that_all_people_share_is_no_error(kinect: Any) -> None:
    turns = [_about_vertical(30.0 * k) for k in range(FRAMES)]

    def moved(_: str, frame: int, joints: np.ndarray) -> list[FoundPerson]:
        offset = turns[frame] @ (0.06, 0.0, 0.03)  # The same in the frame of the limb.
        return [_person(joints - offset, turn=turns[frame])]

    report = kinect(3, moved)
    summary = report["summary"]
    assert summary["median_m"] == pytest.approx(math.hypot(0.06, 0.03), abs=1e-4)
    assert summary["median_with_offsets_m"] == 0.0 and summary["sequences_lost"] == 0
    assert summary["people"] == 3 and summary["joints"]["left_wrist"]["median_with_offsets_m"] == 0.0


def test_an_offset_of_one_person_alone_stays_an_error(kinect: Any) -> None:
    report = kinect(2, lambda name, _, joints: [_person(joints + ((0.08, 0, 0) if "_s1_" in name else (0, 0, 0)))])
    rows = {row["name"]: row for row in report["sequences"]}
    assert rows["a1_s1_t1"]["median_with_offsets_m"] == pytest.approx(0.08, abs=1e-4)
    assert rows["a1_s2_t1"]["median_with_offsets_m"] == pytest.approx(0.08, abs=1e-4)  # Learned from the other one.


def test_a_sequence_without_anybody_is_lost_and_teaches_nothing(kinect: Any) -> None:
    report = kinect(2, lambda name, _, joints: [] if "_s1_" in name else [_person(joints)])
    assert report["summary"]["sequences_lost"] == 1 and report["summary"]["lost_frames_percent"] == 50.0
    rows = {row["name"]: row for row in report["sequences"]}
    assert report["summary"]["found_p95_with_offsets_m"] == 0.0 and report["summary"]["p95_with_offsets_m"] is None
    assert rows["a1_s1_t1"]["found_median_with_offsets_m"] is None
    assert rows["a1_s1_t1"]["median_m"] is None and rows["a1_s2_t1"]["median_with_offsets_m"] == 0.0
    assert any("sequences lost: 1 of 2" in line for line in pose_mhad.lines(report))


def test_a_joint_that_is_wrong_teaches_nothing(kinect: Any) -> None:
    def moved(name: str, _: int, joints: np.ndarray) -> list[FoundPerson]:
        places = joints.copy()
        if "_s1_" in name:
            places[:, 0][_KINECT.index("right_wrist")] += 0.4
        return [_person(places)]

    joints = kinect(2, moved)["summary"]["joints"]
    assert joints["left_wrist"]["found_p95_with_offsets_m"] == 0.0
    assert joints["right_wrist"]["found_p95_with_offsets_m"] == pytest.approx(0.4, abs=1e-4)
    assert joints["right_wrist"]["median_with_offsets_m"] == pytest.approx(0.2, abs=1e-4)  # One of two has none.


# A man who turns.


def _facing_camera() -> np.ndarray:
    joints = np.zeros((len(NAMES), 3))
    for joint, x, y in (("shoulder", 0.2, -0.4), ("hip", 0.1, 0.1)):
        joints[INDEX[f"l_{joint}"]], joints[INDEX[f"r_{joint}"]] = (x, y, 0.0), (-x, y, 0.0)
    joints[INDEX["neck"]] = (0.0, -0.5, 0.0)
    return joints


@pytest.mark.parametrize("off_deg", [0.0, 20.0, -170.0])
def test_the_yaw_is_off_by_what_was_turned_too_far(off_deg: float) -> None:
    middle = np.array([0.0, 0.0, 1.0])
    found, cameras = {}, []
    for k, degrees in enumerate((0.0, 90.0, 180.0, 270.0)):
        joints = _facing_camera() @ _about_vertical(degrees + off_deg).T + middle
        found[k] = FoundFrame(k, [_person(joints)])
        cameras.append((_about_vertical(-degrees), np.zeros(3)))
    errors = pose_turning.yaw_errors_deg(found, cameras, [middle] * 4)
    assert errors == pytest.approx([off_deg] * 4, abs=1e-6)
    del found[2]
    assert np.isinf(pose_turning.yaw_errors_deg(found, cameras, [middle] * 4)[2])


# Joints in the picture.


def test_pixels_are_counted_where_the_network_saw_a_joint() -> None:
    camera = depth_logs.DepthCamera((600.0, 600.0), (320.0, 240.0), (640, 480))
    joints = np.tile((0.0, 0.0, 2.0), (len(NAMES), 1))
    joints[INDEX["r_wrist"]] = (0.1, 0.0, 2.0)
    true = np.tile((320.0, 240.0), (2, 8, 1))
    true[:, 1] = np.nan
    errors = pose_upper_body.errors_px(true, {0: FoundFrame(0, [_person(joints)])}, camera)
    assert math.isnan(errors[0, 1]) and errors[0, 0] == 0.0
    assert errors[0, pose_upper_body._JOINTS.index("right_wrist")] == pytest.approx(30.0)
    assert np.isinf(errors[1, 0]) and math.isnan(errors[1, 1])


# A cloud.


def _pillar(radius_m: float = 0.2, length_m: float = 1.0) -> tuple[Any, Any]:
    limb = SimpleNamespace(a0_m=radius_m, b0_m=radius_m, a1_m=radius_m, b1_m=radius_m, centre0_m=(0.0, 0.0),
                           centre1_m=(0.0, 0.0), length_m=length_m)
    pose = SimpleNamespace(in_frame=SimpleNamespace(rotation_wxyz=(1.0, 0.0, 0.0, 0.0), translation_m=(0.0, 0.0, 0.0)))
    return SimpleNamespace(limbs=[limb]), SimpleNamespace(limbs=[pose])


def test_points_are_as_far_from_the_surface_as_they_were_put() -> None:
    model, body = _pillar()
    points = np.array([(0.25, 0.0, 0.5), (0.0, -0.17, 0.5), (0.0, 0.0, 1.04), (0.23, 0.0, -0.04)])
    assert pose_cloud.surface_distances_m(points, body, model) == pytest.approx([0.05, 0.03, 0.04, 0.05])


def test_the_virtual_camera_looks_at_the_side_that_the_cloud_has() -> None:
    angles = np.linspace(0, np.pi, 60)  # Half a pillar, with z > 0.
    heights = np.linspace(-1.8, 0.0, 90)
    cloud = np.array([(0.2 * math.cos(a), y, 0.2 * math.sin(a)) for a in angles for y in heights])
    turn, shift = pose_cloud.best_view(cloud)
    place = -turn.T @ shift
    assert place[2] > 1.0 and place[1] == pytest.approx(-1.0)
    depth = pose_cloud.render_mm(cloud, turn, shift)
    nearest = depth[depth > 0].min() / 1000.0
    assert nearest == pytest.approx(2.6 - 0.2, abs=0.15)
    assert np.linalg.det(turn) == pytest.approx(1.0)


# The command.


def test_a_kind_is_known_by_its_files_and_a_broken_one_is_named(tmp_path: Path,
                                                               capsys: pytest.CaptureFixture[str]) -> None:
    folder = tmp_path / "cloud"
    folder.mkdir()
    (folder / "hd00000118.pcd").write_bytes(b"FIELDS x y z\nDATA binary\n")
    assert [(kind.NAME, found) for kind, found, _ in pose_real.find(tmp_path, None)] == [
        ("cloud_panoptic_pose1", folder)]
    assert pose_real.find(tmp_path, "other*") == []
    assert main(["evaluate", "pose", "--data", str(tmp_path)]) == 1
    assert "not run: cloud_panoptic_pose1 (" in capsys.readouterr().out
