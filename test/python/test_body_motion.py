"""`deixis body --motion` and `deixis evaluate motion`, on a made-up person."""

from __future__ import annotations

import json
import os
import re
import subprocess
from pathlib import Path

import numpy as np
import pytest
from recorded_person import Turns, positions_m, write_bvh

from deixis_frontend import layout
from deixis_frontend.cli import main

# Joints of the person and limbs of the model that begin there.
LIMBS = {"LeftArm": "left_upper_arm", "RightForeArm": "right_lower_arm", "LeftHand": "left_hand",
         "RightUpLeg": "right_thigh", "LeftLeg": "left_shank", "RightFoot": "right_foot",
         "Spine1": "chest", "Neck": "neck", "Head": "head"}


def bends(count: int = 12) -> list[Turns]:
    """The person bows, bends both elbows and a knee, and lets the arms down."""
    return [{"Hips": (4 * i, 2 * i, 10 * i), "Spine": (0, 4 * i, 2 * i), "Neck": (2 * i, -3 * i, 0),
             "LeftArm": (-7 * i, 3 * i, 0), "RightArm": (6 * i, 0, 3 * i), "LeftForeArm": (0, 0, -8 * i),
             "RightForeArm": (0, 0, 6 * i), "LeftUpLeg": (0, -6 * i, 0), "LeftLeg": (0, 7 * i, 0)}
            for i in range(count)]


def test_a_motion_comes_back_from_bvh_by_a_reader_of_others(tmp_path: Path,
                                                            capsys: pytest.CaptureFixture[str]) -> None:
    write_bvh(tmp_path / "in.bvh", bends())
    assert main(["body", "--motion", str(tmp_path / "in.bvh"), "--bvh", str(tmp_path / "out.bvh")]) == 0
    out = capsys.readouterr().out
    assert "12 frames, 0.40 s; whole_body_detailed" in out
    assert f"written: {tmp_path / 'out.bvh'}" in out
    for frame in range(12):
        given, written = (positions_m(tmp_path / name, frame) for name in ("in.bvh", "out.bvh"))
        for joint, limb in LIMBS.items():
            apart = np.linalg.norm(given[joint] - written[limb])
            assert apart < 1e-5, f"frame {frame}: {joint}"


def test_what_is_beyond_the_limits_is_told(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    write_bvh(tmp_path / "in.bvh", [{}, {"LeftUpLeg": (0, -90, 0), "LeftLeg": (0, 160, 0)},
                                    {"RightFoot": (0, 40, 0)}])
    assert main(["body", "--motion", str(tmp_path / "in.bvh"), "--json"]) == 0
    report = json.loads(capsys.readouterr().out)
    [knee] = report["beyond_limits"]
    assert (knee["joint"], knee["motion"], knee["frames"]) == ("left_knee", "flexion", 1)
    assert knee["worst_deg"] == pytest.approx(5.0, abs=1e-4)
    assert report["at_rest"] == []
    lengths = {limb["limb"]: limb["length_m"] for limb in report["limbs"]}
    assert lengths["right_upper_arm"] == pytest.approx(0.29)


def test_the_unit_and_the_model_can_be_chosen(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    write_bvh(tmp_path / "in.bvh", bends(3))
    assert main(["body", "--motion", str(tmp_path / "in.bvh"), "--unit", "0.012", "--model", "whole_body",
                 "--json"]) == 0
    report = json.loads(capsys.readouterr().out)
    lengths = {limb["limb"]: limb["length_m"] for limb in report["limbs"]}
    assert lengths["left_shank"] == pytest.approx(0.504)
    assert "left_hand" not in lengths


def test_a_map_of_ones_own_is_taken_beside_the_shipped_ones(tmp_path: Path, capsys: pytest.CaptureFixture[str],
                                                            monkeypatch: pytest.MonkeyPatch) -> None:
    write_bvh(tmp_path / "in.bvh", bends(3))
    renamed = (tmp_path / "in.bvh").read_text(encoding="ascii")
    for name, french in (("Hips", "Bassin"), ("LeftUpLeg", "CuisseG"), ("RightUpLeg", "CuisseD"),
                         ("LeftLeg", "JambeG"), ("RightLeg", "JambeD"), ("Head", "Tete"), ("LeftArm", "BrasG"),
                         ("RightArm", "BrasD")):
        renamed = renamed.replace(f" {name}\n", f" {french}\n")
    (tmp_path / "fr.bvh").write_text(renamed, encoding="ascii")
    own = tmp_path / "own"
    (own / "skeletons").mkdir(parents=True)
    (own / "skeletons" / "french.yaml").write_text(
        'name: french\nright: D\nleft: G\nlimbs:\n'
        '  - {limb: pelvis, joint: Bassin, stance: neutral}\n'
        '  - {limb: head, joint: Tete, stance: neutral}\n'
        '  - {limb: upper_arm, side: both, joint: "Bras{side}"}\n'
        '  - {limb: thigh, side: both, joint: "Cuisse{side}", ends_at: "Jambe{side}"}\n', encoding="ascii")
    assert main(["body", "--motion", str(tmp_path / "fr.bvh"), "--json"]) == 1
    assert "config/skeletons" in capsys.readouterr().err
    monkeypatch.setenv("DEIXIS_CONFIG_DIR", str(own))
    assert main(["body", "--motion", str(tmp_path / "fr.bvh"), "--json"]) == 0
    lengths = {limb["limb"]: limb["length_m"] for limb in json.loads(capsys.readouterr().out)["limbs"]}
    assert lengths["right_thigh"] == pytest.approx(0.42)
    assert main(["body", "--motion", str(tmp_path / "in.bvh"), "--json"]) == 0


@pytest.mark.parametrize(("text", "hint"), [
    ("", "in.bvh: is empty"), ("HIERARCHY\nROOT Hips\n{\n  OFFSET 0 zero 0\n", "in.bvh:4"),
    ("HIERARCHY\nROOT Bone\n{\n  OFFSET 0 0 0\n  CHANNELS 0\n}\nMOTION\nFrames: 1\nFrame Time: 0.1\n\n",
     "in.bvh")])
def test_a_broken_motion_is_told_by_file_and_line(text: str, hint: str, tmp_path: Path,
                                                  capsys: pytest.CaptureFixture[str]) -> None:
    (tmp_path / "in.bvh").write_text(text, encoding="ascii")
    assert main(["body", "--motion", str(tmp_path / "in.bvh"), "--bvh", str(tmp_path / "out.bvh")]) == 1
    assert hint in capsys.readouterr().err
    assert not (tmp_path / "out.bvh").exists()


@pytest.mark.parametrize(("options", "hint"), [
    (["--bvh", "x.bvh"], "--bvh needs --motion"), (["--amc-rate", "60"], "--amc-rate needs --motion"),
    ([], "--sex female or --sex male"), (["--motion", "none.bvh"], "none.bvh"),
    (["--motion", "walk.c3d"], ".bvh and .amc"),
    (["--motion", "walk.bvh", "--language", "en"], "--language does not go with --motion"),
    (["--motion", "walk.bvh", "--pose", "standing"], "--pose does not go with --motion"),
    (["--motion", "walk.bvh", "--body-id", "x"], "--body-id does not go with --motion"),
    (["--motion", "walk.bvh", "--asf", "x.asf"], "--asf is for .amc files"),
    (["--motion", "walk.BVH", "--amc-rate", "60"], "--amc-rate is for .amc files"),
    (["--motion", "walk.amc", "--unit", "1"], "--unit is for .bvh files")])
def test_wrong_options_are_told(options: list[str], hint: str, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["body", *options]) == 1
    assert hint in capsys.readouterr().err


def test_recordings_are_judged_by_the_limits(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    write_bvh(tmp_path / "anna_bends.bvh", bends())
    write_bvh(tmp_path / "anna_kneels.bvh", [{}, *[{"LeftUpLeg": (0, -60, 0), "LeftLeg": (0, 154, 0)}] * 4])
    json_file = tmp_path / "motion.json"
    assert main(["evaluate", "motion", "--data", str(tmp_path), "--limits", "source", "--json",
                 str(json_file)]) == 0
    out = capsys.readouterr().out
    assert "flexion 4 (4.0 deg)" in out
    report = json.loads(json_file.read_text(encoding="utf-8"))
    joints = {row["joint"]: row for row in report["joints"]}
    assert (joints["knee"]["joint_frames"], joints["knee"]["rejected"]) == (34, 4)
    assert report["rejected_percent"] == pytest.approx(100 * 4 / (17 * 14))
    assert {row["recording"] for row in report["recordings"]} == {"anna_bends.bvh", "anna_kneels.bvh"}
    assert all(row["largest_error_mm"] < 0.1 for row in report["recordings"])
    assert main(["evaluate", "motion", "--data", str(tmp_path)]) == 0
    assert "rejected: 0.000 %" in capsys.readouterr().out


def test_limits_of_speed_are_written_and_read_again(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    write_bvh(tmp_path / "anna_bends.bvh", bends())
    speeds = tmp_path / "speeds.yaml"
    assert main(["evaluate", "motion", "--data", str(tmp_path), "--actor", "anna", "--write-speeds",
                 str(speeds)]) == 0
    text = speeds.read_text(encoding="utf-8")
    assert "one person (anna), 1 takes" in text and "certainty: low" in text
    knee = re.search(r"joint: knee, speed_deg_per_s: (\d+)", text)
    assert knee is not None and int(knee[1]) in (420, 430)  # 7 degrees in 1/30 s, twice, rounded up.


def test_unknown_people_and_empty_folders_are_told(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["evaluate", "motion", "--data", str(tmp_path)]) == 1
    assert "holds no .bvh or .amc file" in capsys.readouterr().err
    write_bvh(tmp_path / "anna_bends.bvh", bends(2))
    assert main(["evaluate", "motion", "--data", str(tmp_path), "--actor", "otto"]) == 1
    assert "'otto' is none of those recorded: anna" in capsys.readouterr().err


def test_a_comma_in_a_recordings_name_moves_no_column(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    write_bvh(tmp_path / 'anna_bends, "slowly".bvh', bends())
    json_file = tmp_path / "motion.json"
    assert main(["evaluate", "motion", "--data", str(tmp_path), "--json", str(json_file)]) == 0
    recording, = json.loads(json_file.read_text(encoding="utf-8"))["recordings"]
    assert (recording["recording"], recording["frames"]) == ('anna_bends, "slowly".bvh', 12)
    assert "anna_bends" in capsys.readouterr().out


def test_a_recording_too_slow_for_speeds_is_named(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    write_bvh(tmp_path / "anna_creeps.bvh", bends(), rate_hz=5.0)
    assert main(["evaluate", "motion", "--data", str(tmp_path)]) == 1
    assert "anna_creeps.bvh: frames lie too far apart" in capsys.readouterr().err


def test_limits_of_speed_say_whose_they_are(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    write_bvh(tmp_path / "anna_bends.bvh", bends())
    assert main(["evaluate", "motion", "--data", str(tmp_path), "--write-speeds", str(tmp_path / "speeds.yaml")]) == 1
    assert "--actor" in capsys.readouterr().err
    assert not (tmp_path / "speeds.yaml").exists()


def test_a_motion_is_never_written_over_itself_nor_over_a_file_unforced(
        tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    motion, other = tmp_path / "in.bvh", tmp_path / "other.bvh"
    write_bvh(motion, bends(3))
    before = motion.read_bytes()
    (tmp_path / "hard.bvh").hardlink_to(motion)
    for output in (motion, tmp_path / "hard.bvh"):
        assert main(["body", "--motion", str(motion), "--bvh", str(output), "--force"]) == 1
        assert "--bvh and --motion are the same file" in capsys.readouterr().err
    assert motion.read_bytes() == before
    other.write_text("old")
    assert main(["body", "--motion", str(motion), "--bvh", str(other)]) == 1
    assert "give --force" in capsys.readouterr().err and other.read_text() == "old"
    assert main(["body", "--motion", str(motion), "--bvh", str(other), "--force"]) == 0


def test_a_pipe_as_bvh_stays_a_pipe(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    write_bvh(tmp_path / "in.bvh", bends(3))
    os.mkfifo(tmp_path / "pipe")
    assert main(["body", "--motion", str(tmp_path / "in.bvh"), "--bvh", str(tmp_path / "pipe"), "--force"]) == 1
    assert "is a pipe: name a file" in capsys.readouterr().err
    assert (tmp_path / "pipe").is_fifo()


@pytest.mark.parametrize("command", ["motion --json", "motion --write-speeds", "body --json"])
def test_evaluations_refuse_pipes_before_the_work(command: str, tmp_path: Path,
                                                  capsys: pytest.CaptureFixture[str]) -> None:
    os.mkfifo(tmp_path / "pipe")
    what, option = command.split()
    assert main(["evaluate", what, "--data", str(tmp_path), option, str(tmp_path / "pipe")]) == 1
    assert f"{option} {tmp_path / 'pipe'} is a pipe" in capsys.readouterr().err


def test_a_report_that_finds_no_room_is_an_error(tmp_path: Path) -> None:
    write_bvh(tmp_path / "in.bvh", bends(3))
    for program, options in (("deixis-body", ["--sex=male"]), ("deixis-retarget", [f"--motion={tmp_path / 'in.bvh'}"])):
        with Path("/dev/full").open("w") as full:
            ended = subprocess.run([str(layout.find().program(program)), *options], stdout=full,
                                   stderr=subprocess.PIPE, text=True, env=layout.find().environment(), check=False)
        assert ended.returncode == 1
        assert "cannot write the output" in ended.stderr
