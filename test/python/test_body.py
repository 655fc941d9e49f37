"""`deixis body`: what it tells, and that its files are read by others as it means them."""

from __future__ import annotations

import json
import math
import os
import random
import struct
import subprocess
import sys
import xml.etree.ElementTree as xml
from collections import Counter, defaultdict
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from PIL import Image

from deixis_frontend.cli import main

PERSON = ["body", "--sex", "female", "--stature", "1.68"]


def report_of(capsys: pytest.CaptureFixture[str], *options: str) -> dict[str, Any]:
    assert main([*PERSON, "--json", *options]) == 0
    report: dict[str, Any] = json.loads(capsys.readouterr().out)
    return report


def test_sizes_limbs_and_limits_are_told_in_the_asked_language(capsys: pytest.CaptureFixture[str]) -> None:
    assert main([*PERSON, "--language", "de"]) == 0
    text = capsys.readouterr().out
    assert text.startswith("female, 1.680 m, whole_body_detailed\n")
    for line in (["kph", "Körperhöhe", "1680"], ["Kniegelenk", "stretched", "Beugen", "120-150", "155"]):
        assert line in [row.split() for row in text.splitlines()]
    assert "right_lower_arm" in text
    assert 'corrected: Kniegelenk, Beugen: the source prints "Flexion 5° - 10°"' in text


def test_one_joint_or_measure_is_found_by_its_name_in_any_language(
        capsys: pytest.CaptureFixture[str]) -> None:
    for name in ("knee", "knee joint", "Kniegelenk", "articulatio genus"):
        report = report_of(capsys, "--joint", name)
        assert {row["joint"] for row in report["joint_limits"]} == {"knee"}
        assert "measures" not in report
    for name in ("kph", "body height", "koerperhoehe", "statura"):
        [row] = report_of(capsys, "--measure", name)["measures"]
        assert (row["measure"], row["mm"]) == ("kph", 1680)


def test_a_pose_is_held_against_what_is_possible_in_it(capsys: pytest.CaptureFixture[str]) -> None:
    assert main([*PERSON, "--joint", "elbow", "--angle", "left_lower_arm.flexion=120"]) == 0
    rows = [line.split() for line in capsys.readouterr().out.splitlines()]
    assert ["left_elbow", "flexion", "30"] in rows
    assert ["right_elbow", "extension", "10"] in rows


def test_people_without_a_stature_are_of_their_percentile(capsys: pytest.CaptureFixture[str]) -> None:
    statures = []
    for options in (["--percentile", "5"], [], ["--percentile", "95"]):
        assert main(["body", "--sex", "male", "--json", *options]) == 0
        statures.append(json.loads(capsys.readouterr().out)["stature_m"])
    assert statures == pytest.approx([1.696, 1.802, 1.911], abs=0.012)


@pytest.mark.parametrize(("options", "hint"), [
    ("--stature 168", "metres: 1.68?"), ("--stature 0.5", "1.2..2.3 metres"),
    ("--stature nan", "finite"), ("--percentile 100", "0.1..99.9"), ("--percentile 0", "above 0"),
    ("--stature 1.7 --percentile 50", "not allowed with"),
])
def test_absurd_people_are_wrong_usage(options: str, hint: str,
                                       capsys: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(SystemExit) as end:
        main(["body", "--sex", "male", *options.split()])
    assert end.value.code == 2
    assert hint in capsys.readouterr().err


@pytest.mark.parametrize(("options", "hint"), [
    ("--joint tail", "there are cervical_spine (cervical spine)"),
    ("--measure tail", "there are kph (body height)"),
    ("--model tail", "body_models/tail.yaml"),
    ("--angle tail.flexion=3", "there are abdomen.lateral_flexion"),
    ("--angle left_shank.flexion=200", "200 is beyond -10..155 degrees"),
    ("--angle left_shank", "no LIMB.ANGLE=DEGREES"),
    ("--urdf /proc/none/body.urdf", "/proc/none/body.urdf cannot be written"),
    ("--png /proc/none/body.png", "/proc/none/body.png cannot be written"),
    ("--ply /", "--ply / is a folder"),
    ("--motion walk.bvh", "--sex does not go with --motion"),
])
def test_what_is_none_is_told_and_nothing_is_written(options: str, hint: str, tmp_path: Path,
                                                     capsys: pytest.CaptureFixture[str]) -> None:
    kept = [] if "--urdf" in options or "--png" in options else ["--urdf", str(tmp_path / "body.urdf")]
    assert main([*PERSON, *kept, *options.split()]) == 1
    assert hint in capsys.readouterr().err
    assert not list(tmp_path.iterdir())


def test_defaults_and_speeds_stand_beside_the_rows_with_their_reasons(capsys: pytest.CaptureFixture[str]) -> None:
    assert main([*PERSON, "--joint", "knee"]) == 0
    out = capsys.readouterr().out
    assert "by default 155: knee joint, flexion: HDM05" in out
    assert "limits of speed: motion capture of one person" in out and "Certainty: low" in out


def test_urdf_brings_every_joint_where_the_model_has_it(tmp_path: Path,
                                                        capsys: pytest.CaptureFixture[str]) -> None:
    chance = random.Random(1)
    urdf = tmp_path / "body.urdf"
    limbs = report_of(capsys, "--urdf", str(urdf), "--body-id", "x")["limbs"]
    robot = xml.parse(urdf).getroot()
    ends = links_of_limbs(robot)
    assert len(ends) == len(limbs)
    for _ in range(20):
        angles = [f"--angle={limb['limb']}.{angle['angle']}="
                  f"{chance.uniform(angle['min_deg'], angle['max_deg'])!r}"
                  for limb in limbs for angle in limb["angles"]]
        posed = report_of(capsys, *angles, "--body-id", "x")
        places = forward(robot, posed["urdf_joints_rad"])
        for limb, link in zip(posed["limbs"], ends, strict=True):
            at = places[link]
            assert at[:3, 3] == pytest.approx(limb["proximal_joint_m"], abs=1e-6)
            end = (at @ [0.0, 0.0, limb["length_m"], 1.0])[:3]
            assert end == pytest.approx(limb["distal_end_m"], abs=1e-6)
        for joint in robot.iter("joint"):
            if joint.get("type") == "revolute":
                limit = attributes(joint, "limit")
                value = posed["urdf_joints_rad"][joint.get("name")]
                assert float(limit["lower"]) - 1e-8 <= value <= float(limit["upper"]) + 1e-8


def test_urdf_loads_in_a_parser_of_others(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    parser = pytest.importorskip("urdf_parser_py.urdf")
    for model in ("whole_body_detailed", "clothed_body", "whole_body", "upper_body", "right_arm"):
        report = report_of(capsys, "--urdf", str(tmp_path / f"{model}.urdf"), "--model", model)
        robot = parser.URDF.from_xml_file(str(tmp_path / f"{model}.urdf"))
        assert robot.get_root() == "body_default"
        assert len(robot.links) == len(robot.joints) + 1
        children = [joint.child for joint in robot.joints]
        assert len(set(children)) == len(children)
        turning = [joint for joint in robot.joints if joint.type == "revolute"]
        assert {joint.name for joint in turning} == set(report["urdf_joints_rad"])
        assert all(-math.pi <= joint.limit.lower < joint.limit.upper <= math.pi + 1e-6
                   for joint in turning)
        masses = [link.inertial.mass for link in robot.links if link.inertial]
        assert sum(masses) == pytest.approx(1000 * sum(limb["volume_m3"] for limb in report["limbs"]))
        if model.startswith("whole_body"):
            assert 45.0 < sum(masses) < 80.0


def test_ply_has_closed_limbs_of_the_right_size_that_stand_on_the_floor(
        tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    file = tmp_path / "body.ply"
    limbs = report_of(capsys, "--ply", str(file))["limbs"]
    points, normals, owners, triangles = read_ply(file)
    assert np.linalg.norm(normals, axis=1) == pytest.approx(1.0, abs=1e-5)
    assert points[:, 2].min() == pytest.approx(0.0, abs=1e-6)
    assert points[:, 2].max() == pytest.approx(1.68, abs=0.02)
    by_limb = defaultdict(list)
    for triangle in triangles:
        [owner] = {int(owners[corner]) for corner in triangle}
        by_limb[owner].append(triangle)
    assert sorted(by_limb) == list(range(len(limbs)))
    for number, limb in enumerate(limbs):
        faces = by_limb[number]
        edges = Counter(edge for a, b, c in faces for edge in ((a, b), (b, c), (c, a)))
        assert set(edges.values()) == {1}
        assert all((b, a) in edges for a, b in edges), limb["limb"]
        corners = points[np.array(faces)]
        volume = np.einsum("ij,ij->i", corners[:, 0], np.cross(corners[:, 1], corners[:, 2])).sum() / 6
        assert volume == pytest.approx(limb["volume_m3"], rel=0.005)


def test_png_is_a_picture_whose_words_are_of_the_language(tmp_path: Path,
                                                          capsys: pytest.CaptureFixture[str]) -> None:
    for language in ("en", "de"):
        report_of(capsys, "--png", str(tmp_path / language), "--language", language)
    english, german = (np.asarray(Image.open(tmp_path / each).convert("RGB")).astype(int)
                       for each in ("en", "de"))
    assert english.shape == german.shape == (1200, 2400, 3)
    changed = np.abs(english - german).sum(axis=2) > 0
    assert changed[:, :400].any() and changed[:, 800:1200].any()
    assert not changed[:, 560:590].any()  # The body itself.


def test_the_pose_of_the_mesh_can_be_chosen(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    widths = {}
    for pose in ("standing", "rest"):
        report_of(capsys, "--ply", str(tmp_path / pose), "--pose", pose)
        widths[pose] = np.ptp(read_ply(tmp_path / pose)[0][:, 1])
    assert widths["standing"] < 0.7 < 1.4 < widths["rest"] < 1.75


def attributes(element: xml.Element, name: str) -> dict[str, str]:
    child = element.find(name)
    assert child is not None
    return child.attrib


def links_of_limbs(robot: xml.Element) -> list[str]:
    """Links with a shape, in the file's order, which is that of the limbs."""
    return [str(link.get("name")) for link in robot.iter("link") if link.find("visual") is not None]


def forward(robot: xml.Element, values: dict[str, float]) -> dict[str, np.ndarray]:
    """Forward kinematics of a URDF, from the file's words alone: root_from_link by link."""
    places = {"body_x": np.eye(4)}
    waiting = list(robot.iter("joint"))
    while waiting:
        joint = next(each for each in waiting if attributes(each, "parent")["link"] in places)
        waiting.remove(joint)
        origin = attributes(joint, "origin")
        roll, pitch, yaw = map(float, origin["rpy"].split())
        step = np.eye(4)
        step[:3, :3] = turn([0, 0, 1], yaw) @ turn([0, 1, 0], pitch) @ turn([1, 0, 0], roll)
        step[:3, 3] = [float(part) for part in origin["xyz"].split()]
        if joint.get("type") == "revolute":
            axis = [float(part) for part in attributes(joint, "axis")["xyz"].split()]
            step[:3, :3] = step[:3, :3] @ turn(axis, values[str(joint.get("name"))])
        places[attributes(joint, "child")["link"]] = places[attributes(joint, "parent")["link"]] @ step
    return places


def turn(axis: list[float], angle: float) -> np.ndarray:
    x, y, z = np.asarray(axis, dtype=float) / np.linalg.norm(axis)
    skew = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    rotation: np.ndarray = np.eye(3) + math.sin(angle) * skew + (1 - math.cos(angle)) * skew @ skew
    return rotation


def read_ply(file: Path) -> tuple[np.ndarray, np.ndarray, np.ndarray, list[tuple[int, int, int]]]:
    """Points, normals, the number of each point's limb, triangles."""
    header, _, data = file.read_bytes().partition(b"end_header\n")
    lines = header.decode("ascii").splitlines()
    assert lines[:2] == ["ply", "format binary_little_endian 1.0"]
    counts = {line.split()[1]: int(line.split()[2]) for line in lines if line.startswith("element ")}
    names = [line.split()[2] for line in lines if line.startswith("property ") and "list" not in line]
    assert names == ["x", "y", "z", "nx", "ny", "nz", "red", "green", "blue", "limb"]
    row = struct.Struct("<6f3BH")
    size = counts["vertex"] * row.size
    rows = list(row.iter_unpack(data[:size]))
    numbers = np.array([each[:6] for each in rows])
    triangles = list(faces_of(data[size:]))
    assert len(triangles) == counts["face"]
    return numbers[:, :3], numbers[:, 3:], np.array([each[9] for each in rows]), triangles


def faces_of(data: bytes) -> Iterator[tuple[int, int, int]]:
    for corners, a, b, c in struct.iter_unpack("<B3i", data):
        assert corners == 3
        yield a, b, c


def test_files_that_are_there_are_replaced_by_force_only(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    urdf = tmp_path / "body.urdf"
    urdf.write_text("old")
    assert main([*PERSON, "--urdf", str(urdf)]) == 1
    assert "is there already: name another --urdf, or give --force" in capsys.readouterr().err
    assert urdf.read_text() == "old"
    assert main([*PERSON, "--urdf", str(urdf), "--force"]) == 0
    assert urdf.read_text() != "old"


def test_two_outputs_are_never_one_file(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (tmp_path / "link").symlink_to("body")
    assert main([*PERSON, "--urdf", str(tmp_path / "body"), "--ply", str(tmp_path / "link"), "--force"]) == 1
    assert "--ply and --urdf are the same file" in capsys.readouterr().err
    assert not (tmp_path / "body").exists()


def test_names_that_the_output_cannot_encode_are_escaped() -> None:
    environment = {**os.environ, "PYTHONIOENCODING": "ascii", "PYTHONPATH": os.pathsep.join(sys.path)}
    ended = subprocess.run([sys.executable, "-m", "deixis_frontend", *PERSON, "--language", "de"],
                           capture_output=True, text=True, env=environment, check=False)
    assert ended.returncode == 0, ended.stderr
    assert "K\\xf6rperh\\xf6he" in ended.stdout


@pytest.mark.parametrize("command", [
    "body --sex male --OPTION joint measure model body-id png urdf ply motion asf bvh",
    "evaluate motion --data . --OPTION actor model allowances-of write-speeds data",
])
def test_empty_texts_are_wrong_usage(command: str, capsys: pytest.CaptureFixture[str]) -> None:
    words, options = command.split(" --OPTION ")
    for option in options.split():
        with pytest.raises(SystemExit) as end:
            main([*words.split(), f"--{option}", ""])
        assert end.value.code == 2
        assert f"argument --{option}: is empty" in capsys.readouterr().err


def test_one_angle_takes_one_value(capsys: pytest.CaptureFixture[str]) -> None:
    twice = ["--angle", "left_lower_arm.flexion=10", "--angle", "left_lower_arm.flexion=20"]
    assert main([*PERSON, *twice]) != 0
    assert "left_lower_arm.flexion is given twice" in capsys.readouterr().err


def test_help_tells_that_a_model_may_be_a_path(capsys: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(SystemExit):
        main(["body", "--help"])
    assert "or a path that ends in .yaml" in " ".join(capsys.readouterr().out.split())
