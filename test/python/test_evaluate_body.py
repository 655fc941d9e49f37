"""`deixis evaluate body`, on a survey of made-up people."""

from __future__ import annotations

import json
import random
from pathlib import Path

import pytest

from deixis_frontend.cli import main

COLUMNS = """abdominal stature sittingheight eyeheightsitting acromialheight shoulderelbowlength tibialheight
 lateralmalleolusheight span interpupillarybreadth acromionradialelength radialestylionlength handlength palmlength
 footlength headbreadth bideltoidbreadth handbreadth hipbreadth elbowrestheight buttockkneelength kneeheightsitting
 poplitealheight neckcircumference headlength biacromialbreadth chestbreadth chestdepth waistbreadth waistdepth
 waistheightomphalion buttockdepth iliocristaleheight trochanterionheight lateralfemoralepicondyleheight cervicaleheight
 suprasternaleheight tragiontopofhead bicepscircumferenceflexed forearmcircumferenceflexed wristcircumference
 thighcircumference lowerthighcircumference calfcircumference anklecircumference footbreadthhorizontal
 heelbreadth""".split()
SHARES = {"stature": 1.0, "tibialheight": 0.27, "lateralmalleolusheight": 0.04, "buttockkneelength": 0.35,
          "sittingheight": 0.52}


@pytest.fixture
def survey(tmp_path: Path) -> Path:
    chance = random.Random(1)
    for sex, mean in (("FEMALE", 1680.0), ("MALE", 1802.0)):
        rows = [",".join(["SubjectId", *COLUMNS])]
        for person in range(40):
            stature = chance.gauss(mean, 60.0)
            rows.append(",".join([str(person), *(str(SHARES.get(name, 0.19) * stature) for name in COLUMNS)]))
        (tmp_path / f"ANSUR_II_{sex}_Public.csv").write_text("\n".join(rows) + "\n", encoding="ascii")
    return tmp_path


def test_figures_are_printed_and_written(survey: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["evaluate", "body", "--data", str(survey), "--given", "kph", "--error", "1",
                 "--json", str(survey / "body.json")]) == 0
    lines = capsys.readouterr().out.splitlines()
    assert lines[0] == "40 people, known: kph +- 1 mm"
    assert lines[-1].startswith("sex: ")
    report = json.loads((survey / "body.json").read_text(encoding="utf-8"))
    [only] = report["sets"]
    assert only["given"] == ["kph"] and report["error_mm"] == 1.0
    rows = {row["measure"]: row for row in only["measures"]}
    assert rows["kph"]["median_mm"] < 2.0
    assert len(rows) == 52 and len(lines) == 2 + 52 + 2
    assert rows["kph"]["median_mm"] < rows["kph"]["p90_mm"] < rows["kph"]["p95_mm"]
    assert all(row["within_50"] <= row["within_90"] <= 1.0 for row in rows.values())
    inferred = [row["within_90"] for row in only["measures"] if row["measure"] != "kph"]
    assert only["inferred"]["within_90"] == pytest.approx(sum(inferred) / 51)
    assert only["sex"]["accuracy"] > 0.6
    assert 0.0 < only["sex"]["brier"] < 0.25


def test_several_sets_are_measured_when_none_is_named(survey: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["evaluate", "body", "--data", str(survey), "--json", str(survey / "body.json")]) == 0
    assert "40 people, known: nothing\n" in capsys.readouterr().out
    sets = json.loads((survey / "body.json").read_text(encoding="utf-8"))["sets"]
    assert [one["given"] for one in sets] == [[], ["kph"], ["kph", "oal", "ual"],
                                              ["oal", "ual", "oslp", "usl", "biacromial_breadth"]]
    assert sets[0]["sex"]["brier"] == 0.25  # One half of everybody.
    assert sets[1]["sex"]["brier"] < 0.25


def test_what_is_no_measure_or_no_survey_is_told(survey: Path, tmp_path: Path,
                                                 capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["evaluate", "body", "--data", str(survey), "--given", "tail"]) == 1
    assert "--given tail is no measure of kinematics/population.yaml: there are " in capsys.readouterr().err
    assert main(["evaluate", "body", "--data", str(survey), "--given", "kph,body height"]) == 1
    assert "--given body height: kph is given already" in capsys.readouterr().err
    assert main(["evaluate", "body", "--data", str(tmp_path / "none")]) == 1
    assert "ANSUR_II_FEMALE_Public.csv:1: cannot be read" in capsys.readouterr().err


def test_known_measures_are_named_in_any_language(survey: Path, capsys: pytest.CaptureFixture[str]) -> None:
    figures = []
    for name in ("kph", "Körperhöhe"):
        assert main(["evaluate", "body", "--data", str(survey), "--given", name, "--error", "1"]) == 0
        figures.append(capsys.readouterr().out.splitlines())
    assert figures[1][0] == "40 people, known: kph +- 1 mm"
    assert figures[0] == figures[1]
