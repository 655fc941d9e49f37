"""What train-body refuses before the work, and how it sums up the program's figures."""

from __future__ import annotations

from pathlib import Path

import pytest

from deixis_frontend.cli import main
from deixis_frontend.training import body

FIGURES = """\
length,measure,share,spread,error_by_stature_mm,error_by_stature_and_sex_mm
thigh.length,kph,0.2369,0.0066,12.6,12.5
person,frames,points,joint_error_mm,hand_made_rms_mm,hand_made_explained,own_rms_mm,own_explained,others_rms_mm,others_explained
anna,254,287179,0.7,26.0,0.794,5.7,0.982,9.5,0.986
calibrated_person,frames,lengths,clavicle_error_mm,lower_arm_error_mm,surface_rms_mm
anna,51,expected,-8.0,-19.0,11.4
anna,51,calibrated,-2.0,3.0,7.4
"""


def sequence(data: Path, name: str, person: str) -> Path:
    folder = data / name
    for part in ("depth", "mask"):
        (folder / part).mkdir(parents=True)
    for part in ("joints.csv", "intrinsics.yml", "camera_world.yml"):
        (folder / part).touch()
    (folder / "person.csv").write_text(f"key,value\nid,{person}\n", encoding="ascii")
    return folder


@pytest.fixture
def data(tmp_path: Path) -> Path:
    """Sequences of two people; their files are empty."""
    for name, person in (("walk_1", "anna"), ("walk_2", "ben"), ("sit_1", "ben")):
        sequence(tmp_path / "data", name, person)
    return tmp_path / "data"


def train(data: Path, *more: str) -> int:
    return main(["train-body", "--data", str(data), "--output", str(data.parent / "body.yaml"), *more])


@pytest.mark.parametrize(("more", "words"), [
    (["--leave-out", "carl"], "nobody of that name is there: there are anna, ben"),
    (["--leave-out", "anna"], "fewer than two people"),
    (["--only", "sit_*"], "fewer than two people"),
])
def test_people_are_refused_who_are_too_few_or_nobody(data: Path, capsys: pytest.CaptureFixture[str],
                                                      more: list[str], words: str) -> None:
    assert train(data, *more) == 1
    assert words in capsys.readouterr().err
    assert not (data.parent / "body.yaml").exists()


def test_a_folder_that_lacks_something_is_named(data: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (data / "walk_1" / "camera_world.yml").unlink()
    assert train(data) == 1
    assert "not used: walk_1 (no camera_world.yml)" in capsys.readouterr().out


def test_a_folder_that_is_not_there_is_refused(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert train(tmp_path / "nowhere") == 1
    assert "no such folder" in capsys.readouterr().err


def test_the_program_names_the_file_that_it_cannot_understand(
        data: Path, build: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert build.exists()
    assert train(data) == 1
    assert "person.csv: has no stature_mm" in capsys.readouterr().err
    assert not (data.parent / "body.yaml").exists()


def test_figures_become_tables_of_people() -> None:
    lines = list(body._summary(FIGURES))
    assert lines[1].split() == ["anna", "254", "0.7", "26.0", "5.7", "9.5"]
    assert lines[4].split() == ["anna", "expected", "13.5", "11.4"]
    assert lines[5].split() == ["anna", "calibrated", "2.5", "7.4"]


def test_two_people_have_no_tables() -> None:
    assert not list(body._summary("length,measure\nthigh.length,kph\n"))
