"""`deixis evaluate pose`: figures of synthetic poses whose errors are known, and what is said when there is no data."""

from __future__ import annotations

import json
import math
import re
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from deixis_frontend import layout
from deixis_frontend.cli import main
from deixis_frontend.errors import UserError
from deixis_frontend.evaluation import (
    pose, pose_chain, pose_geometry, pose_matching, pose_outlines, pose_overlays, pose_plots, pose_real, pose_report,
    pose_results, pose_scores)
from deixis_frontend.evaluation.pose_joints import INDEX, JOINTS, NAMES, JointPlace
from deixis_frontend.evaluation.pose_matching import JudgedPerson, JudgedScene
from deixis_frontend.evaluation.pose_results import HIDDEN, INFERRED, LOST, MEASURED, FoundFrame, FoundPerson
from deixis_frontend.evaluation.pose_truth import TruePerson, TrueScene

FPS = 30.0
FRAMES = 60
PELVIS_M = np.array([0.1, 0.0, 2.5])
# Standing, facing the camera (x right, y down, z forward): the person's left is at the camera's right.
_SIDED = {"shoulder": (0.18, -0.47, 0.0), "elbow": (0.25, -0.2, 0.0), "wrist": (0.27, 0.05, -0.05),
          "hip": (0.1, 0.0, 0.0), "knee": (0.11, 0.42, -0.02), "ankle": (0.12, 0.84, 0.0)}
_MIDDLE = {"neck": (0.0, -0.55, 0.0), "head": (0.0, -0.65, -0.02)}


def _standing() -> np.ndarray:
    places = dict(_MIDDLE)
    for joint, (x, y, z) in _SIDED.items():
        places[f"l_{joint}"], places[f"r_{joint}"] = (x, y, z), (-x, y, z)
    return PELVIS_M + np.array([places[name] for name in NAMES])


def _true(name: str = "one", shift: tuple[float, float, float] = (0, 0, 0)) -> TruePerson:
    joints = np.tile(_standing() + shift, (FRAMES, 1, 1))
    return TruePerson(name, joints, np.ones((FRAMES, len(JOINTS)), bool), np.tile(PELVIS_M + shift, (FRAMES, 1)))


def _found(person: TruePerson, frame: int, number: int = 1, sigma_m: float = 0.05) -> FoundPerson:
    count = len(JOINTS)
    return FoundPerson(number, 1, person.pelvis_m[frame].copy(), person.joints_m[frame].copy(),
                       np.tile(sigma_m**2 * np.eye(3), (count, 1, 1)), np.full(count, MEASURED),
                       np.tile(np.eye(3), (count, 1, 1)))


def _frames(*people: TruePerson) -> list[FoundFrame]:
    return [FoundFrame(round(k / FPS * 1e6), [_found(p, k, i + 1) for i, p in enumerate(people)])
            for k in range(FRAMES)]


def _judge(found: list[FoundFrame], *people: TruePerson) -> JudgedScene:
    return pose_matching.judge(TrueScene(list(people or (_true(),)), [], FPS), found)


def _figures(found: list[FoundFrame], *people: TruePerson) -> dict[str, Any]:
    return pose_scores.of_scenes([_judge(found, *people)])


def test_the_truth_itself_has_no_error() -> None:
    figures = _figures(_frames(_true()))
    assert figures["visible_median_m"] == figures["visible_p95_m"] == 0.0
    assert figures["within_10cm_percent"] == 100.0 and figures["lost_frames_percent"] == 0.0
    assert figures["angle_p95_deg"] == 0.0
    assert figures["restart_frames_median"] == 0.0 and figures["id_switches"] == 0
    assert figures["false_people_per_min"] == 0.0 and figures["overclaim_percent"] is None
    assert figures["visible_count"] == FRAMES * len(JOINTS) and figures["frames"] == FRAMES


def test_a_joint_that_is_off_shows_in_its_row_and_axis_only() -> None:
    found = _frames(_true())
    for frame in found:
        frame.people[0].joints_m[INDEX["r_wrist"]] += (0.0, 0.12, 0.0)
    joints = _figures(found)["joints"]
    assert joints["wrist"]["p95_m"] == pytest.approx(0.12)
    assert joints["wrist"]["within_10cm_percent"] == 50.0
    assert joints["wrist"]["y_bias_m"] == pytest.approx(0.06) and joints["wrist"]["x_bias_m"] == 0.0
    assert joints["elbow"]["p95_m"] == 0.0


def test_missed_frames_are_infinitely_wrong_and_leave_no_frame_out() -> None:
    found = _frames(_true())[FRAMES // 4:]
    figures = _figures(found)
    assert figures["within_10cm_percent"] == 75.0 and figures["visible_lost_percent"] == 25.0
    assert figures["visible_median_m"] == 0.0 and figures["visible_p95_m"] is None
    assert figures["angle_p95_deg"] is None
    assert figures["lost_frames_percent"] == 25.0 and figures["start_frames_median"] == FRAMES // 4
    assert figures["coverage90_percent"] == 100.0  # Of what was reported.


def test_nobody_found_is_no_good_figure() -> None:
    figures = _figures([])
    assert figures["visible_median_m"] is None and figures["within_10cm_percent"] == 0.0
    assert figures["lost_frames_percent"] == 100.0 and figures["restart_frames_median"] == FRAMES
    assert figures["coverage90_percent"] is None


def test_somebody_too_far_away_is_not_the_person() -> None:
    figures = _figures(_frames(_true(shift=(0.7, 0, 0))))
    assert figures["lost_frames_percent"] == 100.0
    assert figures["false_people_per_min"] == pytest.approx(60.0 / (FRAMES / FPS))


def test_two_people_are_told_apart_and_a_bystander_is_not_false() -> None:
    one, two = _true("one"), _true("two", (0.5, 0, 0))
    scene = _judge(_frames(two, one), one, two)
    assert scene.false_people == 0
    assert set(scene.people[0].ids) == {2} and set(scene.people[1].ids) == {1}
    assert np.nanmax(scene.people[0].errors_m) == 0.0


def test_one_body_does_not_stand_for_two_people() -> None:
    one, two = _true("one"), _true("two", (0.4, 0, 0))
    scene = _judge(_frames(one), one, two)
    assert (scene.people[0].ids == 1).all() and (scene.people[1].ids == -1).all()


def test_changes_of_the_number_are_counted_over_gaps() -> None:
    found = _frames(_true())
    found[20:40] = [FoundFrame(f.utime, [_found(_true(), 0, number=7)]) for f in found[20:40]]
    del found[25:30]
    assert _figures(found)["id_switches"] == 2


def test_a_body_that_is_said_to_be_lost_counts_as_lost() -> None:
    found = _frames(_true())
    found = [FoundFrame(f.utime, [FoundPerson(1, 2, *(getattr(f.people[0], name) for name in (
        "root_m", "joints_m", "covariances_m2", "states", "rotations")))] if k < 6 else f.people) for k, f in enumerate(found)]
    assert _figures(found)["lost_frames_percent"] == 10.0


def test_frames_until_each_start_are_counted() -> None:
    found = _frames(_true())
    del found[30:40], found[:4]
    figures = _figures(found)
    assert figures["start_frames_median"] == 4
    assert figures["restart_frames_median"] == 7 and figures["restart_frames_worst"] == 10


def test_a_limb_that_is_wrong_for_long_is_an_episode_and_a_short_slip_is_none() -> None:
    found = _frames(_true())
    for frame in found[10:25]:
        frame.people[0].joints_m[INDEX["l_elbow"]] += (0.0, 0.0, 0.2)
    for frame in found[40:45]:
        frame.people[0].joints_m[INDEX["l_knee"]] += (0.0, 0.0, 0.2)
    [episode] = pose_scores.lost_episodes(_judge(found).people[0])
    assert episode == {"joint": "l_elbow", "start_frame": 10, "end_frame": 24, "seconds": 0.5}


def test_hinge_angles_are_compared_as_angles_and_ball_angles_as_the_trunk_sees_them() -> None:
    true = _true()
    found = _frames(true)
    turn = np.array([[0.0, 0.0, 1.0], [0.0, 1.0, 0.0], [-1.0, 0.0, 0.0]])
    for frame in found:  # The whole body turned about its vertical axis: no joint's angle is wrong.
        frame.people[0].joints_m[:] = PELVIS_M + (frame.people[0].joints_m - PELVIS_M) @ turn.T
    assert _figures(found)["angle_p95_deg"] == pytest.approx(0.0, abs=0.01)
    judged = _judge(_frames(true)).people[0]
    elbow, wrist = judged.found_m[:, INDEX["r_elbow"]], judged.found_m[:, INDEX["r_wrist"]]
    upper = elbow - judged.found_m[:, INDEX["r_shoulder"]]
    straight = upper / np.linalg.norm(upper, axis=1, keepdims=True)
    true_angle = math.degrees(math.acos(float(np.dot((wrist - elbow)[0], straight[0])
                                              / np.linalg.norm((wrist - elbow)[0]))))
    judged.found_m[:, INDEX["r_wrist"]] = elbow + 0.25 * straight
    errors = pose_geometry.angle_errors_deg(judged, "elbow")
    assert sorted(set(np.round(errors, 3))) == [0.0, pytest.approx(true_angle, abs=1e-3)]


def test_a_raised_arm_is_wrong_by_the_angle_that_it_was_raised() -> None:
    judged = _judge(_frames(_true())).people[0]
    shoulder, elbow = INDEX["l_shoulder"], INDEX["l_elbow"]
    angle = math.radians(40)
    turn = np.array([[1, 0, 0], [0, math.cos(angle), -math.sin(angle)], [0, math.sin(angle), math.cos(angle)]])
    bone = np.array([0.0, 0.28, 0.0])
    judged.true_m[:, elbow] = judged.true_m[:, shoulder] + bone
    judged.found_m[:, elbow] = judged.found_m[:, shoulder] + turn @ bone
    assert max(pose_geometry.angle_errors_deg(judged, "shoulder")) == pytest.approx(40.0)


def test_lengths_are_wrong_by_what_the_bone_is_longer() -> None:
    judged = _judge(_frames(_true())).people[0]
    for side in ("r_", "l_"):
        hip, knee = INDEX[side + "hip"], INDEX[side + "knee"]
        judged.found_m[:, knee] += 0.1 * (judged.found_m[:, knee] - judged.found_m[:, hip])
    true = np.linalg.norm(judged.true_m[0, INDEX["r_knee"]] - judged.true_m[0, INDEX["r_hip"]])
    assert pose_geometry.length_errors_m(judged, "thigh") == pytest.approx(0.1 * true)


def test_coverage_is_the_share_inside_the_stated_ellipsoids() -> None:
    chance = np.random.default_rng(3)
    covariance = np.array([[4.0, 1.0, 0.0], [1.0, 2.0, 0.5], [0.0, 0.5, 9.0]]) * 1e-4
    judged = _judge(_frames(_true())).people[0]
    for _ in range(4):
        judged = _longer(judged)
    judged.found_m += chance.multivariate_normal(np.zeros(3), covariance, judged.found_m.shape[:2])
    judged.covariances_m2[:] = covariance
    judged.is_visible[::2] = False
    figures = pose_scores.of_people([judged])
    for prefix in ("", "hidden_"):
        assert figures[f"{prefix}coverage50_percent"] == pytest.approx(50, abs=2)
        assert figures[f"{prefix}coverage90_percent"] == pytest.approx(90, abs=2)
    judged.covariances_m2 /= 4.0
    assert pose_scores.of_people([judged])["coverage90_percent"] < 60


def _longer(person: JudgedPerson) -> JudgedPerson:
    twice = person.cut(slice(None))
    for name in ("true_m", "is_visible", "found_m", "covariances_m2", "states", "rotations", "ids", "is_said_lost"):
        setattr(twice, name, np.concatenate([getattr(person, name)] * 2))
    return twice


def test_an_ellipsoid_without_extent_covers_nothing() -> None:
    judged = _judge(_frames(_true())).people[0]
    judged.covariances_m2[:] = 0.0
    assert pose_scores.of_people([judged])["coverage90_percent"] == 0.0


def test_wrong_joints_that_are_called_measured_are_overclaimed_and_right_ones_can_be_underclaimed() -> None:
    found = _frames(_true())
    for frame in found:
        person = frame.people[0]
        for name, state in (("r_wrist", MEASURED), ("l_wrist", INFERRED), ("r_ankle", MEASURED), ("l_ankle", LOST)):
            person.joints_m[INDEX[name]] += (0.2, 0.0, 0.0)
            person.states[INDEX[name]] = state
        person.states[INDEX["neck"]] = HIDDEN
    figures = _figures(found)
    assert figures["overclaim_percent"] == 50.0
    assert figures["underclaim_percent"] == 10.0  # One of the ten joints that are right.


def test_hidden_joints_stand_apart() -> None:
    true = _true()
    true.is_visible[:, INDEX["l_wrist"]] = False
    found = _frames(true)
    for frame in found:
        frame.people[0].joints_m[INDEX["l_wrist"]] += (0.0, 0.0, 0.3)
    figures = _figures(found, true)
    assert figures["visible_p95_m"] == 0.0 and figures["hidden_median_m"] == pytest.approx(0.3)
    assert figures["hidden_count"] == FRAMES


def test_messages_between_frames_belong_to_the_nearest_one() -> None:
    found = [FoundFrame(f.utime + 9000, f.people) for f in _frames(_true())]
    assert _figures(found)["lost_frames_percent"] == 0.0
    assert _figures([FoundFrame(f.utime + 10_000_000, f.people) for f in found])["lost_frames_percent"] == 100.0


def _message(limbs: list[str], model_id: int = 5) -> tuple[tuple[str, Any], tuple[str, Any]]:
    def pose_of(index: int) -> Any:
        return SimpleNamespace(proximal_m=(index, 0.0, 2.0), distal_m=(index, 1.0, 2.0), state=INFERRED,
                               proximal_covariance_m2=(1, 2, 3, 4, 5, 6), distal_covariance_m2=(1, 0, 1, 0, 0, 1),
                               in_frame=SimpleNamespace(rotation_wxyz=(math.sqrt(0.5), 0.0, 0.0, math.sqrt(0.5))))

    model = SimpleNamespace(model_id=5, stature_m=2.0, limbs=[SimpleNamespace(name=name) for name in limbs])
    body = SimpleNamespace(person_id=3, state=1, model_id=model_id, limbs=[pose_of(i) for i in range(len(limbs))],
                           root_in_frame=SimpleNamespace(translation_m=(0.0, 0.0, 2.0)))
    return ("BODY_MODEL", model), ("BODY_POSES", SimpleNamespace(utime=40, bodies=[body]))


def test_joints_are_taken_from_the_limbs_by_name() -> None:
    [frame] = pose_results.read(_message(["head", "neck"]))
    [person] = frame.people
    assert (frame.utime, person.id) == (40, 3)
    assert person.joints_m[INDEX["neck"]] == pytest.approx((1.0, 0.0, 2.0))
    assert person.covariances_m2[INDEX["head"]].tolist() == [[1, 2, 4], [2, 3, 5], [4, 5, 6]]
    assert np.isnan(person.joints_m[INDEX["r_wrist"]]).all() and person.states[INDEX["r_wrist"]] == LOST


def test_an_offset_turns_with_the_limb_and_grows_with_the_stature() -> None:
    place = JointPlace("head", "head", "distal", (0.1, 0.0, 0.0))
    [frame] = pose_results.read(_message(["head"]), (place,))
    assert frame.people[0].joints_m[0] == pytest.approx((0.0, 1.2, 2.0))  # A quarter turn about z.


def test_a_pose_of_a_model_that_never_came_is_nobody() -> None:
    [frame] = pose_results.read(_message(["head"], model_id=6))
    assert frame.people == []


def test_the_outline_of_a_limb_is_what_its_ellipses_span() -> None:
    limb = SimpleNamespace(a0_m=0.1, b0_m=0.2, centre0_m=(0.0, 0.0), a1_m=0.05, b1_m=0.05, centre1_m=(0.3, 0.0),
                           length_m=0.0)
    pose_of_limb = SimpleNamespace(state=HIDDEN, in_frame=SimpleNamespace(
        rotation_wxyz=(1.0, 0.0, 0.0, 0.0), translation_m=(0.0, 0.0, 2.0)))
    camera = pose_outlines.Pinhole((100.0, 100.0), (50.0, 40.0))
    model, body = SimpleNamespace(limbs=[limb]), SimpleNamespace(limbs=[pose_of_limb])
    [(state, outline)] = pose_outlines.limb_outlines(body, model, camera)
    corners = np.array(outline)
    assert state == HIDDEN
    assert corners.min(axis=0) == pytest.approx((45.0, 30.0)) and corners.max(axis=0) == pytest.approx((67.5, 50.0))
    pose_of_limb.in_frame.translation_m = (0.0, 0.0, -1.0)
    assert pose_outlines.limb_outlines(body, model, camera) == []


def test_the_hull_leaves_out_what_is_inside() -> None:
    square = np.array([(0.0, 0.0), (2.0, 0.0), (2.0, 2.0), (0.0, 2.0), (1.0, 1.0), (1.0, 0.0)])
    assert set(pose_outlines.convex_hull(square)) == {(0.0, 0.0), (2.0, 0.0), (2.0, 2.0), (0.0, 2.0)}


def test_a_cropped_camera_sees_the_same_point_where_the_crop_shows_it() -> None:
    camera = pose_outlines.Pinhole((100.0, 100.0), (50.0, 40.0))
    point = np.array([[0.2, 0.1, 2.0]])
    [[u, v]] = camera.pixels(point)
    [[u2, v2]] = camera.cropped((20, 10, 60, 40), 80).pixels(point)
    assert (u2, v2) == pytest.approx((2 * (u + 0.5 - 20) - 0.5, 2 * (v + 0.5 - 10) - 0.5))


def test_the_worst_frames_come_first_and_lie_apart() -> None:
    found = _frames(_true())
    for k, metres in ((10, 0.5), (11, 0.4), (40, 0.3)):
        found[k].people[0].joints_m[INDEX["neck"]] += (metres, 0.0, 0.0)
    assert pose_plots.worst_frames(_judge(found).people[0])[:2] == [10, 40]


# The command, with the programs replaced by what they would say.


def _write_sequence(folder: Path, stature: bool = True) -> Path:
    folder.mkdir(parents=True)
    (folder / "sequence.csv").write_text(f"key,value\nkind,body\nfps,{FPS}\nframes,{FRAMES}\n")
    (folder / "person.csv").write_text("key,value\nid,A\n" + ("stature_mm,1800\n" if stature else ""))
    (folder / "segments.csv").write_text("start_frame,end_frame,label\n10,29,squat\n")
    rows = ["frame,time_s,joint,x,y,z,u,v,visible"]
    for k in range(FRAMES):
        for name, (x, y, z) in zip((*NAMES, "pelvis"), (*_standing(), PELVIS_M)):
            rows.append(f"{k},{k / FPS:.4f},{name},{x},{y},{z},100,100,1")
    (folder / "joints.csv").write_text("\n".join(rows) + "\n")
    identity = "rows: 3\n   cols: 3\n   dt: d\n   data: [ 0., 1., 0., -1., 0., 0., 0., 0., 1. ]\n"
    (folder / "extrinsics.yml").write_text(f"%YAML:1.0\n---\nR1: !!opencv-matrix\n   {identity}")
    for name in ("left.mp4", "right.mp4", "intrinsics.yml"):
        (folder / name).write_text("")
    return folder


@pytest.fixture(name="fitter")
def fitter_fixture(monkeypatch: pytest.MonkeyPatch) -> list[tuple[str, ...]]:
    """Stands for the programs: finds everybody, but for the first 6 frames. Returns the settings of each run."""
    asked: list[tuple[str, ...]] = []

    def fit(_: Any, log: Path, __: Any, settings: tuple[str, ...], *___: Any) -> pose_chain.Fitted:
        if log.name == "broken":
            raise UserError("deixis-offline failed: no room")
        asked.append(settings)
        return pose_chain.Fitted([], [5.0, 6.0, 7.0])

    turned = np.array([[0.0, 1.0, 0.0], [-1.0, 0.0, 0.0], [0.0, 0.0, 1.0]])
    true = _true()
    rectified = TruePerson("", true.joints_m @ turned.T, true.is_visible, true.pelvis_m @ turned.T)
    monkeypatch.setattr(pose_chain, "fit", fit)
    monkeypatch.setattr(pose_chain, "stereo_log", lambda _, folder, *__: folder)
    monkeypatch.setattr(pose_results, "read", lambda _: _frames(rectified)[6:])
    return asked


def _no_constants(name: str) -> None:
    raise AssertionError(f"{name} is no JSON")


def test_figures_are_printed_and_written_for_both_columns(
        tmp_path: Path, fitter: list[tuple[str, ...]], capsys: pytest.CaptureFixture[str]) -> None:
    _write_sequence(tmp_path / "data" / "walk")
    (tmp_path / "data" / "other").mkdir()
    assert main(["evaluate", "pose", "--data", str(tmp_path / "data"), "--json", str(tmp_path / "pose.json")]) == 0
    said = capsys.readouterr().out
    assert "not used: other (has no sequence.csv, " in said
    assert "stature given" in said and "nothing given" in said and "squat" in said
    assert fitter == [("fitter.stature_m=1.8",), ("fitter.stature_m=0",)]
    report = json.loads((tmp_path / "pose.json").read_text(), parse_constant=_no_constants)
    for column in ("stature_given", "nothing_given"):
        summary = report["summary"][column]
        assert summary["within_10cm_percent"] == 90.0 and summary["lost_frames_percent"] == 10.0
        assert summary["visible_p95_m"] is None and summary["visible_median_m"] == 0.0
        assert summary["fit_ms_median"] == 6.0 and summary["frames"] == FRAMES
        assert summary["segments"]["squat"]["within_10cm_percent"] == 100.0
        assert {"visible_median_m", "visible_p95_m", "hidden_median_m", "within_10cm_percent", "angle_median_deg",
                "angle_p95_deg", "coverage90_percent", "lost_frames_percent", "restart_frames_median",
                "fit_ms_median", "fit_ms_p99", "frames"} <= set(summary)
    assert [row["name"] for row in report["sequences"]] == ["walk", "walk"]
    assert report["skipped"][0]["name"] == "other"


def test_without_a_stature_only_nothing_is_given(tmp_path: Path, fitter: list[tuple[str, ...]]) -> None:
    _write_sequence(tmp_path / "walk", stature=False)
    assert main(["evaluate", "pose", "--data", str(tmp_path), "--json", str(tmp_path / "pose.json")]) == 0
    assert fitter == [("fitter.stature_m=0",)]
    assert set(json.loads((tmp_path / "pose.json").read_text())["summary"]) == {"nothing_given"}


def test_a_sequence_that_fails_is_named_and_the_exit_code_tells(
        tmp_path: Path, fitter: list[tuple[str, ...]], capsys: pytest.CaptureFixture[str]) -> None:
    _write_sequence(tmp_path / "walk")
    _write_sequence(tmp_path / "broken")
    assert main(["evaluate", "pose", "--data", str(tmp_path), "--json", str(tmp_path / "pose.json")]) == 1
    assert "not run: broken (deixis-offline failed: no room)" in capsys.readouterr().out
    report = json.loads((tmp_path / "pose.json").read_text())
    assert [failed["name"] for failed in report["failed"]] == ["broken"]
    assert report["summary"]["stature_given"]["frames"] == FRAMES and len(fitter) == 2


def test_no_data_is_not_measured(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["evaluate", "pose", "--data", str(tmp_path / "none")]) == 1
    assert "nothing was measured" in capsys.readouterr().err


@pytest.fixture(name="programs")
def programs_fixture(monkeypatch: pytest.MonkeyPatch) -> list[list[str]]:
    """What is asked of the programs, which write empty logs."""
    asked: list[list[str]] = []

    def run_program(_: Any, name: str, *arguments: str) -> str:
        asked.append([name, *arguments])
        if name == "deixis-offline":
            Path(arguments[1]).write_bytes(b"")
            Path(arguments[arguments.index("--times") + 1]).write_text(
                "service,channel,time_us,cpu_us\npose_fitter,STEREO,0,5000\npose_fitter,STEREO_CALIBRATION,0,3\n"
                "stereo_driver,STEREO_PAIR,0,20000\n")
        elif name == "deixis-stereo-driver":
            Path(arguments[-1].removeprefix("file://").removesuffix("?mode=w")).write_bytes(b"")
        return ""

    monkeypatch.setattr(pose_chain, "run_program", run_program)
    return asked


def test_depth_is_made_once_for_the_same_recording_and_settings(tmp_path: Path, programs: list[list[str]]) -> None:
    folder = _write_sequence(tmp_path / "walk")
    chain = pose_chain.Chain(stereo_settings=("matcher.match_size=full",), cache=tmp_path / "cache")
    first = pose_chain.stereo_log(layout.find(), folder, chain, tmp_path)
    assert pose_chain.stereo_log(layout.find(), folder, chain, tmp_path) == first and len(programs) == 1
    assert f"source.left.path={folder / 'left.mp4'}" in programs[0] and "matcher.match_size=full" in programs[0]
    other = pose_chain.Chain(stereo_settings=("matcher.match_size=half",), cache=tmp_path / "cache")
    assert pose_chain.stereo_log(layout.find(), folder, other, tmp_path) != first
    (folder / "left.mp4").write_text("another film")
    assert pose_chain.stereo_log(layout.find(), folder, chain, tmp_path) != first
    assert not list((tmp_path / "cache").glob("*.part"))


def test_the_fitter_runs_alone_unless_more_is_asked_for(tmp_path: Path, programs: list[list[str]]) -> None:
    log = tmp_path / "walk.lcmlog"
    alone = pose_chain.fit(layout.find(), log, pose_chain.Chain(("fit.a=1",)), ("fitter.stature_m=1.8",), tmp_path)
    assert alone.fit_ms == [5.0] and alone.messages == []
    chain = pose_chain.Chain(uses_hands=True, matches_with_fitter=True, stereo_settings=("matcher.b=2",))
    pose_chain.fit(layout.find(), log, chain, (), tmp_path)
    services = [said[said.index("--services") + 1] for said in programs]
    assert services == ["pose_fitter", "object_detector,hand_tracker,stereo_driver,pose_fitter"]
    assert [word for word in programs[0] if "=" in word] == ["pose_fitter.fitter.stature_m=1.8", "pose_fitter.fit.a=1"]
    assert {"stereo_driver.matcher.b=2", f"stereo_driver.calibration.intrinsics={tmp_path}/intrinsics.yml",
            "hand_tracker.image_channel=STEREO"} <= set(programs[1])
    pose_chain.fit(layout.find(), log, chain)  # Of a depth camera: there are no pairs.
    assert "object_detector,hand_tracker,pose_fitter" in programs[2]


def test_overlays_are_drawn_by_the_viewer_from_all_that_came_of_a_log(tmp_path: Path, programs: list[list[str]],
                                                                      monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(pose_overlays, "run_program", pose_chain.run_program)
    stale = tmp_path / "walk_told" / "picture_5.png"
    stale.parent.mkdir()
    stale.touch()
    overlay = pose_overlays.Overlay(tmp_path, "walk_told", 15.0)
    pose_chain.fit(layout.find(), tmp_path / "walk.lcmlog", pose_chain.Chain(), (), None, overlay)
    offline, viewer = programs
    assert "--results-only" not in offline, "the pictures are drawn on"
    assert viewer[:3] == ["deixis-viewer", "--lcm-url", f"file://{offline[2]}?mode=r&speed=0"]
    assert {"image_channel=STEREO", f"film={tmp_path}/walk_told.mp4", "film_rate_hz=15"} <= set(viewer)
    assert not stale.exists(), "of an earlier run"


def test_overlays_have_a_name_for_each_sequence_and_column(tmp_path: Path, monkeypatch: pytest.MonkeyPatch,
                                                           fitter: list[tuple[str, ...]]) -> None:
    _write_sequence(tmp_path / "walk")
    fit, overlays = pose_chain.fit, []
    monkeypatch.setattr(pose_chain, "fit", lambda *a: (overlays.append(a[5]), fit(*a))[1])
    assert main(["evaluate", "pose", "--data", str(tmp_path), "--overlays", str(tmp_path / "out")]) == 0
    assert overlays == [pose_overlays.Overlay(tmp_path / "out", f"walk_{column}", FPS) for column in pose.COLUMNS]
    assert len(fitter) == 2


def test_what_is_described_is_what_is_reported(tmp_path: Path, fitter: list[tuple[str, ...]],
                                              repository: Path) -> None:
    _write_sequence(tmp_path / "walk")
    assert main(["evaluate", "pose", "--data", str(tmp_path), "--json", str(tmp_path / "pose.json")]) == 0
    summary = json.loads((tmp_path / "pose.json").read_text())["summary"]["stature_given"]
    text = (repository / "test/evaluation/README.md").read_text(encoding="utf-8")
    described = {word for line in text.splitlines() if line.startswith("|") for word in re.findall(r"`(\w+)`", line)}
    kinds = {kind.NAME for kind in pose_real.KINDS}
    words_of_messages_and_files = {"null", "lost", "visible", "bystanders"}
    assert kinds <= described
    assert described - kinds - words_of_messages_and_files <= set(summary)
    assert fitter


def test_the_legend_explains_each_column_of_the_table() -> None:
    for word in ("lost", "start", "again", "hidden", "cover90", "hid. 90", "overclaim", "ids", "false/min", "ms"):
        assert f"{word}:" in pose_report.LEGEND or f"{word}," in pose_report.LEGEND, word
        assert word.split()[0] in pose_report.HEADING
    assert pose.COLUMNS == ("stature_given", "nothing_given")
